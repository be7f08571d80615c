"""What uncertain inputs do to the half-plane: as figures, and what pictures show of it."""

from dataclasses import dataclass, field

import numpy as np

from comparisons.figures.figure import Column, Figure, Findings, SampleSpread, Series, Statement
from comparisons.figures.uncertainty import Uncertainty

NAME = "scatter"
DESIGN, SHARES = "Sobol, scrambled", "Saltelli et al. 2010"


def scattered(
    quantity: str, friction: float, nominal: float, spread: SampleSpread, samples: int
) -> Figure:
    """A figure of the half-plane [SI] with every input as the scene has it, on the finest pressure
    elements, and its spread over so many samples; these, solved on the coarsest, are scaled to it:
    that error is in all of them alike. Their mean is as sure as their deviation over the root of
    their number."""
    scale = abs(nominal) or 1.0
    error = spread.deviation / max(1, samples) ** 0.5
    return Figure(
        study=NAME,
        quantity=quantity,
        source="half_plane",
        value=nominal,
        at={"friction": friction},
        scale=scale,
        uncertainty=Uncertainty({"sampling": error / scale}),
        spread=spread,
    )


def by_inputs(figure: Figure) -> float:
    """Half the interval of a figure's spread, relative."""
    low, high = figure.spread.interval
    return 0.5 * (high - low) / figure.scale


@dataclass(frozen=True)
class InputScatter:
    """The samples that the figures are of, and their pressures."""

    samples: int
    solutions: int  # of the half-plane
    failed: int  # of these, without an answer
    why: str | None  # the first of those failed
    pitch: float  # [m] of the pressure elements
    x: np.ndarray = field(repr=False)  # (k,) [m]
    band: np.ndarray = field(repr=False)  # (2, k) [Pa], 2.5th and 97.5th percentile at each x

    def findings(self, figures: tuple[Figure, ...]) -> Findings:
        """With the samples that the figures are of."""
        names = ("samples", "solutions", "failed", "pitch")
        columns = {n: Column((getattr(self, n),), "m" if n == "pitch" else "") for n in names}
        said = [Statement("design", DESIGN), Statement("shares", SHARES)]
        said += [Statement("first failure", self.why)] if self.why else []
        return Findings(figures, (Series("samples", columns),), tuple(said), self)
