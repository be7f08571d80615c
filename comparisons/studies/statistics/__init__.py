"""Theories of rough contact beside the solved one, and every asperity's penetration."""
