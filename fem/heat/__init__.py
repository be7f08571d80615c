"""Heat conduction on a mesh: moving sources, partition between two bodies."""
