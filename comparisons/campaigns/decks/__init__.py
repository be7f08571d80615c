"""Scenes as complete inputs of other codes."""

from pathlib import Path

TEMPLATES = Path(__file__).parent / "templates"
