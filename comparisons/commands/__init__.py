"""The commands of `crosscheck`, one module each; `comparisons.cli` puts them together."""
