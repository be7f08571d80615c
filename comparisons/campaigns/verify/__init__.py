"""Both models against everything whose exact answer is known."""
