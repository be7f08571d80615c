"""What is asked: a checked scene, and its surface; `library/` holds the scenes that come along."""
