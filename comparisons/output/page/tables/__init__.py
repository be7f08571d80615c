"""The tables of the report, as rows of text."""
