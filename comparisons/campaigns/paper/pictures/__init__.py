"""The paper's pictures, drawn anew."""
