"""Half-plane contact: profiles, exact solutions, operators, contact solver, subsurface stresses."""
