"""Fields of a scene in words and as data: JSON Schema, messages, tables of the reference."""
