"""The sections of single studies: each is all that a scene knows of its study."""
