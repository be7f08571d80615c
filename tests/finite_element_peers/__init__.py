"""Contact on finite elements beside CalculiX and scikit-fem."""
