"""Questions to one solved scene, each with its figures."""
