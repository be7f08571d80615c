"""Both models against everything whose exact solution is known: carried out, and shown.

Figures and model errors with their stated uncertainties, of scenes solved as `run` does (`scenes`)
and of contacts on the library's operators (`operators`), smooth and rough (`rough`); observed
orders (`coverage`); manufactured solutions (`manufactured`); the contact by PETSc's own solver
(`independent_solver`). Out: JSON, JUnit, the terminal's tables."""

from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from functools import cached_property
from itertools import product
from operator import attrgetter
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from comparisons.campaigns.cases import (
    MODEL_LABELS,
    Campaign,
    Row,
    Trial,
    carry_out,
    rows_table,
)
from comparisons.campaigns.verify.coverage import (
    FEWEST,
    FEWEST_ROUGH,
    GROUPS,
    Coverage,
    Pair,
    coverage,
    coverage_rows,
    order_rows,
    pairs_of,
)
from comparisons.campaigns.verify.operators import operator_cases, operator_contacts
from comparisons.campaigns.verify.rough import ELEMENTS, rough_operator_contacts, rough_scenes
from comparisons.campaigns.verify.scenes import exact_scenes, scene_cases
from comparisons.common.errors import check_finite_elements
from comparisons.common.progress import ProgressCallback, no_progress
from comparisons.figures.figure import grouped
from comparisons.figures.quantity import label
from comparisons.output.terminal import plain_table

if TYPE_CHECKING:
    from rich.console import RenderableType

DEGREES = (1, 2, 3)
COLUMNS = ("figures", "informative", "covered", "median ratio", "90 %")


@dataclass(frozen=True, repr=False)
class Verification(Campaign):
    """The rows of `verify`, with the pairs of stated uncertainty and true error among them."""

    @cached_property
    def pairs(self) -> tuple[Pair, ...]:
        return tuple(pair for row in self.rows for pair in pairs_of(row))

    @cached_property
    def coverage(self) -> Coverage:
        return coverage(self.pairs)

    @property
    def coverage_line(self) -> str:
        """The line that scripts look for; rounded down, so that 95 means at least 95."""
        share = self.coverage.covered
        return f"coverage {np.floor(100.0 * share + 1e-9) if np.isfinite(share) else 0.0:.0f} %"

    def groups(self, *names: str) -> dict[tuple[str, ...], Coverage]:
        """Coverage by two or more fields of the pairs, in order of appearance."""
        key = attrgetter(*names)
        return {key(pairs[0]): coverage(pairs) for pairs in grouped(self.pairs, key)}

    def as_dict(self) -> dict:
        return super().as_dict() | {
            "coverage": asdict(self.coverage),
            "groups": [
                {**dict(zip(names, group, strict=True)), **asdict(covered)}
                for names in GROUPS
                for group, covered in self.groups(*names).items()
            ],
            "pairs": [pair.as_dict() for pair in self.pairs],
        }

    def tables(self) -> "RenderableType":
        """Coverage by model, quantity and kind; rows without pairs or that do not hold; verdict."""
        from rich.console import Group

        tables = []
        for names in GROUPS:
            rows = self._coverage_cells(names)
            tables += [plain_table(*names, numbers=COLUMNS, rows=rows), ""]
        shown = [row for row in self.rows if not (row.holds and pairs_of(row))]
        return Group(*tables, rows_table(shown), *self.verdict_lines(), self.coverage_line)

    def _coverage_cells(self, names: tuple[str, ...]) -> list[tuple[str, ...]]:
        rows, said = [], {"model": MODEL_LABELS.get, "quantity": label}
        for group, covered in self.groups(*names).items():
            named = zip(names, group, strict=True)
            words = (said.get(name, str)(word) for name, word in named)
            rows.append((*words, *_cells(covered)))
        return [*rows, ("all", *[""] * (len(names) - 1), *_cells(self.coverage))]


def _cells(group: Coverage) -> tuple[str, ...]:
    if not group.informative:
        return (str(group.count), "0", "", "", "")
    ratios = group.median_overestimation, group.overestimation_quantile
    covered = f"{100.0 * group.covered:.1f} %"
    return (str(group.count), str(group.informative), covered, *(f"{r:.1f}" for r in ratios))


def everything() -> Iterator[Trial]:
    check_finite_elements()
    from comparisons.campaigns.verify.independent_solver import independent_cases
    from comparisons.campaigns.verify.manufactured import BODIES, manufactured_cases

    yield from scene_cases(exact_scenes())
    yield from operator_cases(operator_contacts())
    yield from scene_cases(rough_scenes())
    yield from operator_cases(rough_operator_contacts(), ELEMENTS)
    yield from manufactured_cases(product(BODIES, DEGREES))
    yield from independent_cases()


def verify(
    out: Path,
    junit: Path | None = None,
    callback: ProgressCallback = no_progress,
    cases: Sequence[Trial] | None = None,
    fewest: tuple[int, int] = (FEWEST, FEWEST_ROUGH),
) -> Verification:
    """Verify; leave verify.json in `out`, JUnit XML in the file `junit`. Raises InputError where
    those cannot be written.

    cases   None is everything
    fewest  informative figures that there must be, in all and of rough contacts"""

    def concluded(command: str, rows: tuple[Row, ...], seconds: float) -> Verification:
        return verification((*rows, *order_rows(rows)), seconds, fewest)

    return carry_out("verify", cases or everything(), out, junit, callback, concluded)


def verification(rows: Sequence[Row], seconds: float, fewest: tuple[int, int]) -> Verification:
    """All rows, with those of the coverage by the stated uncertainties."""
    pairs = [pair for row in rows for pair in pairs_of(row)]
    return Verification("verify", (*rows, *coverage_rows(pairs, *fewest)), seconds)
