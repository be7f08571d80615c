"""Below the surface: where a body begins to flow, and zones of little shear."""
