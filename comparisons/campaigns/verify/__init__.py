"""Both models against everything whose exact solution is known."""
