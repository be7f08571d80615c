"""Designs of samples, and the share of each input in a figure's variance.

First-order and total shares, S_i and T_i, by the estimators of Saltelli et al. (2010), Comput.
Phys. Commun. 181, 259-270, table 2 (b) and (f; Jansen's): f is solved on two independent designs A
and B (n, d), and on the d designs A_i, which are A with column i of B,

    S_i = mean(f(B) (f(A_i) - f(A))) / V,    T_i = mean((f(A) - f(A_i))^2) / (2 V),

V the variance over A and B. Where inputs do not interact, S_i and T_i are equal and sum to 1.
Few samples suffice where f is nearly linear: the line of regression on the inputs is taken out of f
before, and its shares, which are known, are added."""

from collections.abc import Iterable
from dataclasses import asdict, dataclass

import numpy as np

RESAMPLED = 400  # bootstrap repetitions
INTERVAL = 0.95
ROUNDING = 1e-9  # of a figure: what varies less does not vary


@dataclass(frozen=True)
class Shares:
    """Shares of the variance, by input (d,): first-order, total, and half the width of either's
    95 % interval, by bootstrap."""

    first: np.ndarray
    total: np.ndarray
    first_uncertainty: np.ndarray
    total_uncertainty: np.ndarray

    def by_input(self, names: Iterable[str]) -> dict[str, dict[str, float]]:
        """The four by the inputs' names."""
        columns = {kind: values.tolist() for kind, values in asdict(self).items()}
        return {n: {kind: c[i] for kind, c in columns.items()} for i, n in enumerate(names)}


def designs(samples: int, inputs: int, seed: int) -> np.ndarray:
    """Points (2 + d, n, d) of the open unit cube: A, B, and A_i for every input. Sobol's sequence
    in 2 d dimensions, scrambled by `seed`; `samples` n is a power of two."""
    from scipy.stats.qmc import Sobol

    points = Sobol(2 * inputs, scramble=True, seed=seed).random_base2(samples.bit_length() - 1)
    points = np.clip(points, 2.0**-33, 1.0 - 2.0**-33)
    one, other = points[:, :inputs], points[:, inputs:]
    mixed = np.repeat(one[None], inputs, axis=0)
    for i in range(inputs):
        mixed[i, :, i] = other[:, i]
    return np.concatenate([one[None], other[None], mixed])


def shares(values: np.ndarray, scores: np.ndarray, seed: int = 0) -> Shares | None:
    """Shares from a figure's values (2 + d, n) on the designs, whose inputs have `scores` (2 + d,
    n, d), of any mean and size. Samples with a nan on any design are left out. None where nothing
    varies, or hardly a sample is left."""
    known = np.all(np.isfinite(values), axis=0)
    values, scores = values[:, known], scores[:, known]
    count, inputs = values.shape[1], scores.shape[-1]
    if count <= inputs or np.ptp(values[:2]) <= ROUNDING * np.abs(values[:2]).max():
        return None
    estimates = _estimates(values, scores)
    draws = np.random.default_rng(seed).integers(count, size=(RESAMPLED, count))
    drawn = np.array([_estimates(values[:, draw], scores[:, draw]) for draw in draws])
    low, high = central(drawn)
    return Shares(*estimates, *(0.5 * (high - low)))


def central(values: np.ndarray) -> np.ndarray:
    """Ends (2, …) of the central 95 % of values along the first axis, nan left out."""
    return np.nanpercentile(values, (50.0 * (1.0 - INTERVAL), 50.0 * (1.0 + INTERVAL)), axis=0)


def _estimates(values: np.ndarray, scores: np.ndarray) -> np.ndarray:
    """First-order and total shares (2, d): of the regression line exactly, of the rest as above."""
    inputs = scores.shape[-1]
    plain = scores[:2].reshape(-1, inputs)
    centre, size = plain.mean(axis=0), plain.std(axis=0)
    scores = (scores - centre) / np.where(size > 0.0, size, 1.0)
    slope = np.linalg.lstsq(
        scores[:2].reshape(-1, inputs), (values[:2] - values[:2].mean()).ravel(), rcond=None
    )[0]
    rest = values - values[:2].mean() - scores @ slope
    variance = np.sum(slope**2) + rest[:2].var()
    if variance == 0.0:  # the same sample drawn again and again
        return np.full((2, inputs), np.nan)
    one, other, mixed = rest[0], rest[1], rest[2:]
    first = slope**2 + np.mean(other * (mixed - one), axis=1)
    total = slope**2 + 0.5 * np.mean((one - mixed) ** 2, axis=1)
    return np.array([first, total]) / variance
