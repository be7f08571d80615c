"""Half-plane contact: profiles, exact solutions, operators, the contact solver, subsurface stresses."""
