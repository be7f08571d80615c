"""What uncertain inputs do to the half-plane's figures, as a run keeps it."""

from dataclasses import dataclass, field

import numpy as np

from comparisons.figures.figure import Column, Figure, Findings, SampleSpread, Series, Statement
from comparisons.figures.uncertainty import Uncertainty

NAME = "scatter"
DESIGN, SHARES = "Sobol, scrambled", "Saltelli et al. 2010"


@dataclass(frozen=True)
class ScatteredFigure:
    """A figure of the half-plane over all samples, in SI."""

    quantity: str
    friction: float
    # with every input as the scene has it, on the finest pressure elements. The samples, solved on
    # the coarsest, are scaled to it: that error is in all of them alike
    nominal: float
    mean: float
    standard_deviation: float
    interval: tuple[float, float]  # from the 2.5th to the 97.5th percentile
    # of its variance, by input; None where it does not vary
    shares: dict[str, dict[str, float]] | None

    @property
    def relative(self) -> float:
        """Half the interval over the nominal value."""
        return 0.5 * (self.interval[1] - self.interval[0]) / abs(self.nominal or 1.0)


@dataclass(frozen=True)
class InputScatter:
    """All figures, and the samples that they are of."""

    figures: tuple[ScatteredFigure, ...]
    samples: int
    solutions: int  # of the half-plane
    failed: int  # of these, without an answer
    why: str | None  # the first of those failed
    pitch: float  # [m] of the pressure elements
    x: np.ndarray = field(repr=False)  # (k,) [m]
    band: np.ndarray = field(repr=False)  # (2, k) [Pa], 2.5th and 97.5th percentile at each x

    def of(self, quantity: str, friction: float) -> ScatteredFigure | None:
        """The figure of a quantity at a friction coefficient, if it has one."""
        wanted = quantity, friction
        return next((f for f in self.figures if (f.quantity, f.friction) == wanted), None)

    def findings(self) -> Findings:
        """The half-plane's figures with their spread, and the samples that these are of. A mean
        of n samples is as sure as their deviation over the root of n."""
        figures = []
        for each in self.figures:
            spread = SampleSpread(each.mean, each.standard_deviation, each.interval, each.shares)
            scale = abs(each.nominal) or 1.0
            error = each.standard_deviation / max(1, self.solutions - self.failed) ** 0.5
            figures.append(
                Figure(
                    study=NAME,
                    quantity=each.quantity,
                    source="half_plane",
                    value=each.nominal,
                    at={"friction": each.friction},
                    scale=scale,
                    uncertainty=Uncertainty({"sampling": error / scale}),
                    spread=spread,
                )
            )
        names = ("samples", "solutions", "failed", "pitch")
        columns = {n: Column((getattr(self, n),), "m" if n == "pitch" else "") for n in names}
        said = [Statement("design", DESIGN), Statement("shares", SHARES)]
        said += [Statement("first failure", self.why)] if self.why else []
        return Findings(tuple(figures), (Series("samples", columns),), tuple(said))
