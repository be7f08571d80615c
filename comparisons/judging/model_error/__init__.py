"""The error budget of a run: what separates the half-plane from the truth, cause by cause."""
