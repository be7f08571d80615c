"""What a factorisation will cost, before it is tried.

Measured on one core (Debian 12, MUMPS 5.5 on the reference BLAS, minimum-fill ordering) for
meshes of 10 000 to 500 000 unknowns. Elements that grow from a refined surface cost 3 to 4 us and
0.8 kB an unknown at any size. A large stretch of equal elements, as in a stress window, costs
more the larger it is: 4.8 us and 0.96 kB at 34 000 unknowns, 8.3 us and 1.08 kB at 100 000, 15 us
and 1.24 kB at 350 000. The laws below follow these dearer meshes.
"""

import numpy as np

SECONDS_LINEAR = 2.4e-6  # an unknown: reading, ordering, small fronts
SECONDS_FRONTS = 2.1e-8  # an unknown to the power 1.5: large fronts in two dimensions
BYTES_LINEAR = 800.0  # an unknown, at least
BYTES_DECADE = 280.0  # an unknown and decade of unknowns: fill of nested fronts
BYTES_OFFSET = -313.0


def estimate(unknowns: int) -> tuple[float, float]:
    """Seconds and bytes that `SymmetricFactor` needs for a number of displacements, at most."""
    seconds = unknowns * (SECONDS_LINEAR + SECONDS_FRONTS * np.sqrt(unknowns))
    fill = BYTES_DECADE * np.log10(max(unknowns, 1)) + BYTES_OFFSET
    return float(seconds), float(unknowns * max(BYTES_LINEAR, fill))
