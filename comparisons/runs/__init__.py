"""One scene from start to end, and the same again."""
