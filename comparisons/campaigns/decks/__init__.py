"""Scenes as complete inputs of other codes."""
