"""Studies of many solutions: cost, maps, verification, robustness, the paper, a first look."""
