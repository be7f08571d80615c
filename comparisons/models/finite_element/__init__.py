"""The finite-element model of a scene on one level of refinement."""
