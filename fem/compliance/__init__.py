"""Surface compliance of a finite-element body as an operator."""
