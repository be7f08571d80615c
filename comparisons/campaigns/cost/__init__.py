"""Error against time of every method that applies to a scene."""
