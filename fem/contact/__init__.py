"""Contact of nonlinear bodies, and the independent solver of linear contact."""
