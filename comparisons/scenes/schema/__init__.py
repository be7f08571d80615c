"""The sections and fields of a scene file, and how each is checked."""
