"""What the fields of a scene say of themselves: JSON Schema, messages, tables of the reference."""
