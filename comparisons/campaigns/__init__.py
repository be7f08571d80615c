"""Many scenes, one table each: maps, sweeps, costs, checks."""
