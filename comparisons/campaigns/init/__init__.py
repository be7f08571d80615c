"""A first scene for a measured profile: read with guessed units, shown, written with comments."""
