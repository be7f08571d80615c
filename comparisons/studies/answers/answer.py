"""An answer from outside as data: in the project's axes and signs, in SI units."""

from collections.abc import Iterator
from dataclasses import asdict, dataclass, field

import numpy as np

from analytic.numerics import runs_of
from analytic.stress_state import Extremum, StressState
from comparisons.figures.figure import Column, Figure, Findings, Series, figures_of
from comparisons.figures.quantity import QUANTITIES as COMPARED
from comparisons.figures.quantity import Quantity
from comparisons.figures.uncertainty import Uncertainty

NAME = "answers"
CONDITIONS = "contact conditions"
QUANTITIES = COMPARED | {
    "load_balance": Quantity("load off the scene's"),
    "spacing": Quantity("distance from point to point in contact", "m"),
}
TOUCHING = 0.02  # of the largest pressure: what stresses of a mesh leave beside a contact is less


@dataclass(frozen=True)
class OutsideStress:
    """Stresses of an answer, as those of a model."""

    friction: float  # coefficient that they are of
    # largest tau1, |txz| and von Mises stress at the nodes in the window [Pa], [m]
    extremes: dict[str, Extremum]
    depth: float  # [m] of the largest tau1 below the answer's own surface
    spacing: float  # [m] in depth, of the nodes next to that
    field: StressState  # (m, k) on the window, not a number outside the answer's mesh


@dataclass(frozen=True)
class Answer:
    """One solution from outside, of one file."""

    file: str  # that it was read from
    sha256: str
    x: np.ndarray  # (n,) [m] along the surface, ascending
    pressure: np.ndarray  # (n,) [Pa] as given: also where it is negative
    stress: OutsideStress | None = None  # None: pressures alone
    of_mesh: bool = False  # the pressures are stresses on the surface of a mesh

    @property
    def load(self) -> float:
        """[N/m] that the pressures carry; of a mesh those in contact, for far from it the stresses
        on coarse elements are small but add up."""
        carried = np.where(self.touching, self.pressure, 0.0) if self.of_mesh else self.pressure
        return float(0.5 * (carried[1:] + carried[:-1]) @ np.diff(self.x))

    @property
    def touching(self) -> np.ndarray:
        """(n,) whether a point is in contact."""
        least = TOUCHING if self.of_mesh or self.stress is not None else 0.0
        return self.pressure > least * max(0.0, float(self.pressure.max()))

    @property
    def spacing(self) -> float:
        """[m] from point to point in contact, median."""
        steps = np.diff(self.x)
        inside = self.touching[1:] & self.touching[:-1]
        return float(np.median(steps[inside] if inside.any() else steps))

    def on(self, x: np.ndarray) -> np.ndarray:
        """Pressures [Pa] at places x [m], zero where nothing touches."""
        pressure = np.where(self.touching, self.pressure, 0.0)
        return np.interp(x, self.x, pressure, left=0.0, right=0.0)

    @property
    def patches(self) -> np.ndarray:
        """Contact patches (k, 2) [m]: an edge where the line through the squares of the last two
        pressures vanishes, as at a smooth edge the square root does, and before the next point."""
        first, after = runs_of(self.touching)
        edges = [
            (self._edge(i, -1), self._edge(j - 1, 1)) for i, j in zip(first, after, strict=True)
        ]
        return np.array(edges).reshape(-1, 2)

    def _edge(self, last: int, way: int) -> float:
        x, squares, beyond = self.x, self.pressure**2, last + way
        if not 0 <= beyond < len(x):
            return float(x[last])
        inner = last - way
        edge = 0.5 * (x[last] + x[beyond])
        if 0 <= inner < len(x) and squares[inner] > squares[last]:
            step = (x[last] - x[inner]) / (squares[inner] - squares[last])
            edge = x[last] + squares[last] * step
        return float(np.clip(edge, *sorted((x[last], x[beyond]))))


@dataclass(frozen=True)
class AnswerRow:
    """A quantity of an answer at one friction coefficient; figures in SI, the others relative."""

    quantity: str
    friction: float
    answer: float | None  # None for a norm of the difference, as the reference
    reference: float | None
    difference: float  # (answer - reference) / reference, or the norm
    # of the difference: the model's, and how finely the answer's points are read
    model: float
    reading: float
    own_uncertainty: float | None  # the answer's, in place of its reading; None: it states none
    tolerance: float | None  # None: not judged

    @property
    def stated(self) -> Uncertainty:
        """Of the difference: the model's, and the answer's own, or else how it is read."""
        if self.own_uncertainty is None:
            return Uncertainty({"model": self.model, "reading": self.reading})
        return Uncertainty({"model": self.model, "own": self.own_uncertainty})

    def figures(self, source: str, against: str) -> Iterator[Figure]:
        """The answer's figure, where it has one, and its difference from a model."""
        at, own = {"friction": self.friction}, self.own_uncertainty
        common = {"study": NAME, "quantity": self.quantity, "source": source, "at": at}
        if self.answer is not None:
            stated = None if own is None else Uncertainty({"own": own})
            scale = abs(self.answer) or 1.0
            yield Figure(value=self.answer, scale=scale, uncertainty=stated, **common)
        yield Figure(
            value=self.difference,
            against=against,
            scale=abs(self.reference or 0.0) or 1.0,
            uncertainty=self.stated,
            bounds=(-self.tolerance, self.tolerance) if self.tolerance else None,
            **common,
        )


@dataclass(frozen=True)
class Hint:
    """What explains a difference in the pressures: its kind, by how much [SI], in words, and the
    relative L2 norm of the difference that it leaves."""

    kind: str
    value: float
    text: str
    left: float


@dataclass(frozen=True)
class ComparedAnswer:
    """An answer beside a model."""

    name: str
    reference: str  # name of the model
    answers: tuple[Answer, ...]  # one a resolution, coarse to fine
    measured: bool  # its scatter is stated
    rows: tuple[AnswerRow, ...]
    balance: float  # (load that its pressures carry - the scene's) / the scene's
    # by model, how far its pressures are from the contact conditions (`Residuals`)
    conditions: dict[str, dict]
    hints: tuple[Hint, ...] = ()
    # by quantity, rows as ASME V&V 20 has them; empty of what was not measured
    validation: dict[str, list] = field(default_factory=dict)

    @property
    def finest(self) -> Answer:
        return self.answers[-1]

    def findings(self) -> Findings:
        """Figures and differences; load, contact conditions, files, hints and validation."""
        figures = [f for row in self.rows for f in row.figures(self.name, self.reference)]
        itself = Uncertainty({"itself": 1.0})  # an error is as sure as its order of size
        figures += figures_of(NAME, self.name, {"load_balance": self.balance}, itself)
        figures += figures_of(NAME, self.name, {"spacing": self.finest.spacing})
        of_models = [{"model": name} | found for name, found in self.conditions.items()]
        measured = [
            {"quantity": name} | row for name, rows in self.validation.items() for row in rows
        ]
        tables = {
            CONDITIONS: of_models,
            "hints": [asdict(hint) for hint in self.hints],
            "validation": measured,
        }
        series = [_table(name, rows, self.name) for name, rows in tables.items() if rows]
        files = {
            "file": Column(tuple(each.file for each in self.answers)),
            "sha256": Column(tuple(each.sha256 for each in self.answers)),
        }
        series.append(Series("files", files, self.name, is_account=True))
        return Findings(tuple(figures), tuple(series))


def _table(name: str, rows: list[dict], source: str) -> Series:
    """Columns of rows; numbers are errors, as sure as their order of size."""
    columns = {}
    for key in rows[0]:
        values = tuple(row[key] for row in rows)
        is_error = all(isinstance(value, float) for value in values) and key != "friction"
        columns[key] = Column(values, "", tuple(map(abs, values)) if is_error else None)
    return Series(name, columns, source)
