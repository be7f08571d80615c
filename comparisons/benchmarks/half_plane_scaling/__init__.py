"""How the half-plane solver's time and memory grow."""
