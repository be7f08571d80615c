"""A first scene for a measured profile: what the file is, a look at it, a commented scene file."""
