"""From levels to figures with uncertainties and verdicts."""
