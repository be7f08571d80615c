"""All that a verification found, and whether it holds."""

from dataclasses import asdict, dataclass
from functools import cached_property

from comparisons.common.errors import ExitStatus
from comparisons.common.provenance import machine, versions
from comparisons.studies.verify.checks import Check
from comparisons.studies.verify.pairs import (
    FEWEST,
    LEAST_COVERAGE,
    WIDEST,
    Coverage,
    Pair,
    coverage,
)

SCHEMA = 1


@dataclass(frozen=True)
class Failure:
    """A case that gave no figures: what the program said instead."""

    case: str
    model: str
    message: str


@dataclass(frozen=True)
class Verification:
    """`pairs` of stated and true errors, `checks` of orders and of the second road, cases that
    `failed`, and `seconds` by stage.

    fewest  pairs that must tell more than rounding
    """

    pairs: tuple[Pair, ...]
    checks: tuple[Check, ...]
    failed: tuple[Failure, ...]
    seconds: dict[str, float]
    fewest: int = FEWEST

    @cached_property
    def coverage(self) -> Coverage:
        """Of all pairs together."""
        return coverage(self.pairs)

    @cached_property
    def groups(self) -> dict[tuple[str, str], Coverage]:
        """Coverage by model and quantity, in order of appearance."""
        named: dict[tuple[str, str], list[Pair]] = {}
        for pair in self.pairs:
            named.setdefault((pair.model, pair.quantity), []).append(pair)
        return {name: coverage(pairs) for name, pairs in named.items()}

    @property
    def faults(self) -> list[str]:
        """What does not hold, a line each; empty if all does."""
        whole = self.coverage
        found = [f"{f.model}, {f.case}: {f.message}" for f in self.failed]
        found += [
            f"{p.model}, {p.case}, {p.quantity}: "
            + (f"error {p.error:.2e} above {p.ceiling:g}" if p.converged else "not converged")
            for p in self.pairs
            if not p.close
        ]
        found += [
            f"{c.group}, {c.name}: {c.value:.4g}, expected {c.low:.4g} to {c.high:.4g}"
            for c in self.checks
            if not c.holds
        ]
        if whole.tell < self.fewest:
            found.append(f"coverage: {whole.tell} figures with exact answers, not {self.fewest}")
        if not whole.covered >= LEAST_COVERAGE:
            found.append(f"coverage: {whole.covered:.4f}, not {LEAST_COVERAGE:g}")
        if not whole.median_width <= WIDEST:
            found.append(f"coverage: median width {whole.median_width:.2f}, not {WIDEST:g}")
        return found

    @property
    def holds(self) -> bool:
        return not self.faults

    @property
    def exit_status(self) -> ExitStatus:
        return ExitStatus.DONE if self.holds else ExitStatus.OUTSIDE_TOLERANCE

    def as_dict(self) -> dict:
        """For verify.json."""
        return {
            "schema": SCHEMA,
            "holds": self.holds,
            "faults": self.faults,
            "coverage": asdict(self.coverage)
            | {"least": LEAST_COVERAGE, "widest": WIDEST, "fewest": self.fewest},
            "groups": [
                {"model": model, "quantity": quantity, **asdict(found)}
                for (model, quantity), found in self.groups.items()
            ],
            "checks": [check.as_dict() for check in self.checks],
            "failed": [asdict(failure) for failure in self.failed],
            "pairs": [pair.as_dict() for pair in self.pairs],
            "seconds": self.seconds,
            "versions": versions(),
            "machine": machine(),
        }
