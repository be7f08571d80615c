"""What a level is expected to take, before it is begun."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Expected:
    """`unknowns`, `memory` [bytes] at the peak and `seconds` of a level, from measured laws."""

    unknowns: int
    memory: float
    seconds: float
