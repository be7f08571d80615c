"""The stiff and extreme cases: each a row that passes on figures, never by surviving."""
