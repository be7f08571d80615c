"""Heat conduction on a mesh: moving and transient sources, partition between two bodies."""
