"""How the finite elements' error of Hertz's contact falls."""
