"""Scripts that take the public face alone: `import comparisons as crosscheck`."""
