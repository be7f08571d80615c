"""Below the surface: where a body begins to flow, zones of little shear, and bulges."""
