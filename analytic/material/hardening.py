"""Hardening of a metal: its flow stress in tension over the equivalent plastic strain.

    perfect    Y
    linear     Y + H k
    Voce       S - (S - Y) exp(-b k)
    Ludwik     Y + K k^n
    a table    linear between its points, constant beyond the last one

These are isotropic: the yield surface grows. Beside them it may move along the plastic strain, by
the back stress (2/3) H' ep (linear kinematic hardening of Prager). A bar in tension hardens by the
sum of both slopes; reversed, a moved surface yields earlier. Sources: Voce, J. Inst. Metals 74
(1948) 537; Ludwik, Elemente der technologischen Mechanik (1909); Prager, Proc. Instn Mech. Engrs
169 (1955) 41.

Nomenclature: k equivalent plastic strain, ep plastic strain, Y yield stress [Pa], H, K moduli [Pa],
S saturated flow stress [Pa], b rate, n exponent, q equivalent stress [Pa]."""

from dataclasses import dataclass

import numpy as np

MOST_STEPS = 60  # of Newton's method for the plastic strain; Voce takes 5, Ludwik at most 20
ROUNDING = 4.0 * np.finfo(float).eps


@dataclass(frozen=True)
class Hardening:
    """Flow stress of a metal that yields at `yield_stress` Y [Pa] > 0.

    modulus    H [Pa] >= 0, linear
    voce       S [Pa] >= Y and b > 0
    ludwik     K [Pa] >= 0 and 0 < n <= 1
    table      pairs of plastic strain and stress [Pa], from (0, Y), strains rising and stresses not
               falling, of true stress and logarithmic strain
    kinematic  H' [Pa] >= 0, beside any of them

    At most one of the isotropic laws. Raises ValueError, in one line, for others."""

    yield_stress: float
    modulus: float = 0.0
    voce: tuple[float, float] | None = None
    ludwik: tuple[float, float] | None = None
    table: tuple[tuple[float, float], ...] | None = None
    kinematic: float = 0.0

    def __post_init__(self) -> None:
        start = self.yield_stress
        if not 0.0 < start < np.inf:
            raise ValueError(f"the yield stress must be positive, not {start:g} Pa")
        for name, value in (("hardening", self.modulus), ("kinematic", self.kinematic)):
            if not 0.0 <= value < np.inf:
                raise ValueError(f"the {name} modulus must not be negative, not {value:g} Pa")
        laws = [self.modulus > 0.0, *(law is not None for law in (self.voce, self.ludwik))]
        if sum(laws) + (self.table is not None) > 1:
            raise ValueError("a metal hardens by one of modulus, voce, ludwik and table")
        if self.voce is not None:
            saturated, rate = self.voce
            if not (start <= saturated < np.inf and 0.0 < rate < np.inf):
                raise ValueError(
                    f"Voce's law wants a saturated stress of at least the yield stress {start:g} "
                    f"Pa and a positive rate, not {saturated:g} Pa and {rate:g}"
                )
        if self.ludwik is not None:
            strength, exponent = self.ludwik
            if not (0.0 <= strength < np.inf and 0.0 < exponent <= 1.0):
                raise ValueError(
                    "Ludwik's law wants a strength that is not negative and an exponent above 0, "
                    f"at most 1, not {strength:g} Pa and {exponent:g}"
                )
        if self.table is not None:
            self._check_table()

    def _check_table(self) -> None:
        points = np.array(self.table, dtype=float)
        if points.ndim != 2 or points.shape[1] != 2 or not np.isfinite(points).all():
            raise ValueError("a hardening table wants pairs of plastic strain and stress")
        strain, stress = points.T
        if strain[0] != 0.0 or stress[0] != self.yield_stress:
            raise ValueError(
                "a hardening table begins at plastic strain 0 with the yield stress "
                f"{self.yield_stress:g} Pa, not at {strain[0]:g} with {stress[0]:g} Pa"
            )
        for k in range(1, len(points)):
            if strain[k] <= strain[k - 1]:
                raise ValueError(
                    "plastic strains of a hardening table must rise: "
                    f"{strain[k]:g} follows {strain[k - 1]:g}"
                )
            if stress[k] < stress[k - 1]:
                raise ValueError(
                    f"a hardening table must not soften: {stress[k]:g} Pa at the plastic strain "
                    f"{strain[k]:g} follows {stress[k - 1]:g} Pa"
                )

    def stress(self, strain: np.ndarray) -> np.ndarray:
        """Flow stress [Pa] at equivalent plastic strains k >= 0, of any shape."""
        start = self.yield_stress
        if self.voce is not None:
            return start - (self.voce[0] - start) * np.expm1(-self.voce[1] * strain)
        if self.ludwik is not None:
            return start + self.ludwik[0] * strain ** self.ludwik[1]
        if self.table is not None:
            return np.interp(strain, *np.array(self.table).T)
        return start + self.modulus * strain

    def slope(self, strain: np.ndarray) -> np.ndarray:
        """Derivative by k [Pa]; at the points of a table that to the right, of Ludwik's law
        with n < 1 infinite at k = 0."""
        if self.voce is not None:
            saturated, rate = self.voce
            return (saturated - self.yield_stress) * rate * np.exp(-rate * strain)
        if self.ludwik is not None:
            strength, exponent = self.ludwik
            with np.errstate(divide="ignore"):
                return strength * exponent * np.asarray(strain) ** (exponent - 1.0)
        if self.table is not None:
            at, stress = np.array(self.table).T
            slopes = np.append(np.diff(stress) / np.diff(at), 0.0)
            return slopes[np.searchsorted(at, strain, side="right") - 1]
        return np.full(np.shape(strain), self.modulus)

    def increment(self, trial: np.ndarray, before: np.ndarray, stiffness: float) -> np.ndarray:
        """dk > 0 (m,) with  trial - stiffness dk = stress(before + dk)  for trial equivalent
        stresses (m,) [Pa] above the flow stress at k = `before` (m,), and a stiffness [Pa] > 0."""
        if self.table is not None:
            strain, stress = np.array(self.table).T
            reach, goal = stress + stiffness * strain, trial + stiffness * before
            beyond = np.maximum(goal - reach[-1], 0.0) / stiffness
            return np.maximum(np.interp(goal, reach, strain) + beyond - before, 0.0)
        if self.voce is None and self.ludwik is None:
            excess = trial - self.yield_stress - self.modulus * before
            return excess / (stiffness + self.modulus)
        excess = trial - self.stress(before)
        # the flow stress is concave: Newton's method rises to the solution from below
        rise = np.zeros_like(excess)
        if self.ludwik is not None and self.ludwik[0] > 0.0:
            strength, exponent = self.ludwik
            rise = 0.5 * np.minimum(excess / stiffness, (excess / strength) ** (1.0 / exponent))
            rise *= 0.5 ** (1.0 / exponent - 1.0)
        for _ in range(MOST_STEPS):
            left = trial - stiffness * rise - self.stress(before + rise)
            step = left / (stiffness + self.slope(before + rise))
            rise = rise + step
            if np.all(np.abs(step) <= ROUNDING * (before + rise + trial / stiffness)):
                break
        return rise
