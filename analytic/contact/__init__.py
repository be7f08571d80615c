"""Contact on any compliance operator: active set, equilibrium, friction, defect correction."""
