"""The half-plane solver beside Tamaas and ContactMechanics."""
