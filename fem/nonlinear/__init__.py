"""Bodies that are not linear: finite deformation, plastic flow."""
