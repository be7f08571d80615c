"""What `verify` demands beside coverage: a number between two bounds."""

from dataclasses import asdict, dataclass


@dataclass(frozen=True)
class Check:
    """A measured number and where it must lie, both ends included.

    group      order | manufactured | second road
    name       what was measured
    reference  of the expectation: what it is held to
    """

    group: str
    name: str
    reference: str
    value: float
    low: float
    high: float

    @property
    def holds(self) -> bool:
        return bool(self.low <= self.value <= self.high)

    def as_dict(self) -> dict:
        """For verify.json."""
        return asdict(self) | {"holds": self.holds}


def order_check(
    group: str, name: str, reference: str, order: float, expected: float, margin: float
) -> Check:
    """An observed order, which must be the expected one: a surplus is a mistake too."""
    return Check(group, name, reference, float(order), expected - margin, expected + margin)
