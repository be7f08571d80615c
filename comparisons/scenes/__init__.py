"""A scene file becomes a resolved scene; `library/` holds the scenes that come along."""
