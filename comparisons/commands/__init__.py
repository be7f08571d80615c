"""The commands of `crosscheck`, by what they are about; `comparisons.cli` puts them together."""
