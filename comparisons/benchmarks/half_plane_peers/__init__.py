"""The half-plane solver beside other codes."""
