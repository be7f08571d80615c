"""Where the half-plane's assumption holds: its own error over two dimensionless groups."""
