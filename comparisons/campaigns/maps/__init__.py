"""Where the half-plane holds: its model error over two dimensionless groups."""
