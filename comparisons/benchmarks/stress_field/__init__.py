"""Time of subsurface stresses against direct summation."""
