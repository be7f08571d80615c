"""The models and the figures that are compared: their names in result.json, and in words.

Figures of one model are numbers per level; norms are relative L2 norms of the difference of two
models' fields on the same points, with the finite elements as the reference."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from operator import attrgetter
from typing import TYPE_CHECKING

from comparisons.common.errors import InputError, nearest
from comparisons.common.numbers import percent

if TYPE_CHECKING:
    from analytic.exact.hertz import HertzContact

MODELS = ("half_plane", "finite_element")
HYPHENATED = {"half_plane": "half-plane", "finite_element": "finite-element"}  # the … model
WHOLE = "whole"  # model: the finite elements with every effect that matters
USUAL = 0.02  # relative tolerance of a scene that gives none
LABELS = {
    "half_plane": "half-plane",
    "operators": "layered half-plane",  # of scenes with a layer or a coating
    "finite_element": "finite elements",
    WHOLE: "whole model",
}


_pressure, _half_width = attrgetter("peak_pressure"), attrgetter("half_width")


@dataclass(frozen=True)
class Quantity:
    """Quantity that a figure is the value of."""

    label: str  # in words, for tables
    unit: str = ""  # of the figure in SI; "" for ratios
    # of the smooth contact: what a figure that vanishes is measured by
    scale: Callable[["HertzContact"], float] = lambda hertz: 1.0
    # of convergence under refinement: 2 for the quadratic elements' smooth figures, 1 where the
    # square-root edge of a contact governs, or how well it is found, and of the x of a maximum:
    # there the slope of the stress, of order 1, is zero
    formal_order: float = 1.0
    needs_stress: bool = False  # only with a [stress] table
    short: str = ""  # enough for 80 columns of a terminal
    # what tables show it over beside its unit: so many times `scale`, and the symbol of that
    over: tuple[float, str] | None = None

    def size(self, value: float, hertz: "HertzContact") -> float:
        """What a figure of that value is measured by [SI]."""
        return abs(value) or self.scale(hertz)


def _stress(label: str, short: str) -> Quantity:
    over = 1.0, "p₀"
    return Quantity(label, "Pa", _pressure, 2.0, needs_stress=True, short=short, over=over)


# Of every run, compared and judged.
QUANTITIES: dict[str, Quantity] = {
    "peak_pressure": Quantity(
        "peak pressure", "Pa", _pressure, 2.0, short="peak pressure", over=(1.0, "p₀")
    ),
    "contact_length": Quantity(
        "contact length", "m", _half_width, short="contact length", over=(2.0, "× 2a")
    ),
    "tau1_max": _stress("largest principal shear stress τ₁", "τ₁ max"),
    "tau1_max_depth": Quantity(
        *("depth of the largest τ₁", "m", _half_width),
        needs_stress=True,
        short="τ₁ max depth",
        over=(1.0, "a"),
    ),
    "txz_max_abs": _stress("largest orthogonal shear stress |τxz|", "|txz| max"),
}
MAIN = ("peak_pressure", "contact_length", "tau1_max")  # of these, where there is little room
# Of every comparison, shown and not judged; that of tau1 over the common window of the fields.
NORMS = {
    "pressure_l2": Quantity("pressures, relative L2 difference", short="pressure, L2"),
    "tau1_l2": Quantity("field of τ₁, relative L2 difference", needs_stress=True, short="τ₁, L2"),
}
COMPARED = QUANTITIES | NORMS


def label(quantity: str) -> str:
    """A quantity of result.json in words; a name that is none stays as it is."""
    return COMPARED[quantity].label if quantity in COMPARED else quantity.replace("_", " ")


def error_text(value: float, uncertainty: float | None = None) -> str:
    """A relative error in per cent with its sign, in digits that are certain."""
    return percent(value, signed=True, uncertainty=uncertainty)


def models_named(names: str | Sequence[str]) -> tuple[str, ...]:
    """The models that a text names, or several texts; names are separated by commas, "-" is "_".
    Raises InputError for an unknown one and for none."""
    listed = names.split(",") if isinstance(names, str) else names
    allowed = f"allowed are {', '.join(HYPHENATED.values())}"
    if not isinstance(listed, list | tuple) or not all(isinstance(name, str) for name in listed):
        raise InputError(f"models: is {listed!r}; {allowed}")
    models = [name.strip().replace("-", "_") for name in listed if name.strip()]
    for name in models:
        if name not in MODELS:
            near = f"the nearest is {HYPHENATED[nearest(name, MODELS)]}"
            raise InputError(f"models: there is no model {name}; {near}; {allowed}")
    if not models:
        raise InputError(f"models: is empty; {allowed}")
    return tuple(name for name in MODELS if name in models)
