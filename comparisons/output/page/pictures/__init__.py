"""The pictures of the report, one module each."""
