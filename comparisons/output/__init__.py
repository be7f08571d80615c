"""What a finished run is, on disk and as numbers."""
