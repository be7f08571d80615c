"""Which figures of a repeated run moved, and whether by more than their stated uncertainty.

A figure is every number, truth and verdict of result.json but those under `cost`. It may move by
the total uncertainty that the recorded run states for it, or for the figure that it depends on
(DEPENDS); without one, by rounding."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import inf, isfinite

import numpy as np

from analytic.contact.problem import KKT_TOLERANCE

Value = float | int | bool | str | None
Path = tuple[str | int, ...]

# Relative, between converged solutions on other processors; the same machine gives the same bits.
ROUNDING = KKT_TOLERANCE
# Orders of irregular sequences jump, memory may decide on the levels, estimates are no results.
NO_FIGURES = frozenset({"cost", "seconds", "iterations", "order", "levels"})
NO_FIGURES |= {"estimate", "not_modelled", "plan", "safety_factor"}
DEPENDS = {
    "von_mises_max": "tau1_max",
    "contact_ratio_extent": "contact_length",
    "patches": "contact_length",
    "contact_shift": "contact_length",
    "tau1_max_at": "tau1_max_depth",
    "txz_max_abs_at": "tau1_max_depth",
    "von_mises_max_at": "tau1_max_depth",
}
PATCHES = "patches"


@dataclass(frozen=True)
class Stated:
    """How far a figure may move: `allowed` in its unit, by whose uncertainty, and its `scale`."""

    allowed: float
    by: str
    scale: float


@dataclass(frozen=True)
class Moved:
    """A figure that moved."""

    path: str  # in result.json
    recorded: Value | list  # None where there is none, as repeated
    repeated: Value | list
    # relative; None where they have no meaning: verdicts, and what came or went
    change: float | None
    stated: float | None
    by: str  # whose uncertainty is stated, "" without one
    beyond: bool  # whether it moved by more than is stated


@dataclass(frozen=True)
class Movement:
    """All of it: rows of what `moved`, number of figures that are the `same`, that moved by no
    more than `rounding`, and that are `new`, of which the record knows nothing."""

    moved: tuple[Moved, ...]
    same: int
    rounding: int
    new: int

    @property
    def beyond(self) -> tuple[Moved, ...]:
        return tuple(row for row in self.moved if row.beyond)


def movement(recorded: dict, repeated: dict) -> Movement:
    """Compare two contents of result.json."""
    before, after = dict(_figures(recorded)), dict(_figures(repeated))
    rows, same, rounding = [], 0, 0
    for path, old in before.items():
        new = after.get(path)
        if old == new and type(old) is type(new):
            same += 1
            continue
        row, size = _compared(path, old, new, recorded)
        if size <= ROUNDING:
            rounding += 1
        else:
            rows.append(row)
    return Movement(tuple(rows), same, rounding, len(set(after) - set(before)))


def check_figures(recorded: dict) -> None:
    """Raise ValueError where a content of result.json is not built as a run builds it."""
    try:
        _moves_load(recorded), recorded["models"], recorded["comparison"], recorded["hertz"]
        for path, value in _figures(recorded):
            if _is_number(value):
                stated_for(path, value, recorded)
                # as where they are compared with a repetition's
                _difference(value, []) if isinstance(value, list) else float(value)
    except (AttributeError, LookupError, TypeError, ValueError, OverflowError) as error:
        raise ValueError(f"figures are missing or misplaced ({error!r})") from error


def _figures(value: object, path: Path = ()) -> Iterator[tuple[Path, Value | list]]:
    """Every figure below `value` with its path; texts are none, but for verdicts."""
    if isinstance(value, dict):
        for name, item in value.items():
            if name not in NO_FIGURES:
                yield from _figures(item, (*path, name))
    elif isinstance(value, list) and path[-1] != PATCHES:
        for index, item in enumerate(value):
            yield from _figures(item, (*path, index))
    elif path and (isinstance(value, bool | int | float | list) or path[-1] == "verdict"):
        yield path, value


def _compared(
    path: Path, old: Value | list, new: Value | list, recorded: dict
) -> tuple[Moved, float]:
    """The row of a figure, and the relative size of its movement, infinite where it has none."""
    name = written(path)
    if not (_is_number(old) and _is_number(new)) or isinstance(old, list) is not isinstance(
        new, list
    ):
        return Moved(name, old, new, None, None, "", True), inf
    stated = stated_for(path, old, recorded)
    difference = _difference(old, new) if isinstance(old, list) else new - old
    change, allowed = difference / stated.scale, stated.allowed / stated.scale
    beyond = abs(change) > max(allowed, ROUNDING)
    return Moved(name, old, new, change, allowed, stated.by, beyond), abs(change)


def stated_for(path: Path, value: Value | list, recorded: dict) -> Stated:
    """What the recorded run states of one of its figures."""
    hertz = recorded.get("hertz") or {}
    half_width = hertz.get("half_width") or 1.0
    name = str(path[-1])
    match path:
        case ("models", str(model), int(entry), "contact", "peak_position"):
            levels = (recorded["models"][model][entry].get("cost") or {}).get("levels") or [{}]
            return Stated(_number(levels[-1].get("pitch")), "one pressure element", half_width)
        case ("models", str(model), int(entry), "checks", _):
            return Stated(KKT_TOLERANCE, "convergence", 1.0)
        case ("models", _, int(_), "operator", *_, "difference" | "beyond"):
            return Stated(abs(value), "itself", 1.0)  # an error: as sure as its order of size
        case ("models", str(model), int(entry), "uncertainty", quantity, _):
            return Stated(_total(recorded, model, entry, quantity)[0], "itself", 1.0)
        case ("models", str(model), int(entry), "stress", place, _):
            return _relative(recorded, model, entry, DEPENDS.get(place, place), half_width)
        case ("models", str(model), int(entry), "contact", "patches"):
            length = float(sum(stop - start for start, stop in value))
            return _relative(recorded, model, entry, "patches", length or half_width)
        case ("models", str(model), int(entry), "normal_tangential_coupling", quantity, part):
            scale = 1.0 if part == "difference" else _scale(value, quantity, hertz)
            return _relative(recorded, model, entry, quantity, scale)
        case ("models", _, int(_), "contact", "load_per_length") if not _moves_load(recorded):
            return Stated(0.0, "", abs(value) or 1.0)
        case ("models", str(model), int(entry), "contact" | "stress", _):
            return _relative(recorded, model, entry, name, _scale(value, name, hertz))
        case ("comparison", quantity, int(entry), "half_plane" | "finite_element"):
            return _relative(recorded, name, entry, quantity, _scale(value, quantity, hertz))
        case ("comparison", quantity, int(entry), "difference" | "uncertainty"):
            rows = recorded["comparison"][quantity]
            own = _number(rows[entry].get("uncertainty"))
            return Stated(own, "itself" if name == "uncertainty" else quantity, 1.0)
        case ("model_error", quantity, int(entry), *place):
            return _of_model_error(recorded["model_error"][quantity][entry], place, value)
        case ("error_budget", "quantities", quantity, int(entry), "numerical", model, "limit"):
            row = recorded["error_budget"]["quantities"][quantity][entry]
            share = _number(row["numerical"][model]["discretisation"])
            return Stated(share * abs(value), "itself", abs(value) or 1.0)
        case ("error_budget", "quantities", _, int(_), *_):
            return Stated(abs(value), "itself", 1.0)
        case ("yield", "by_friction", int(_), str(part)) if part != "friction":
            return _largest(recorded, 1.0 if part == "share_at_hardness" else abs(value) or 1.0)
        case ("answers", answer, "comparison", quantity, int(entry), "reference" | "difference"):
            own = _number(recorded["answers"][answer]["comparison"][quantity][entry]["uncertainty"])
            scale = 1.0 if name == "difference" else abs(value) or 1.0
            return Stated(own * scale, quantity, scale)
        case ("answers", *_):
            return Stated(abs(value), "itself", abs(value) or 1.0)
        case ("quiescent_zone", model, int(entry), str(quantity), "value" | "uncertainty"):
            own = _number(recorded["quiescent_zone"][model][entry][quantity]["uncertainty"])
            return Stated(own, "itself", abs(value) or 1.0)
        case ("bulge", "by_friction", int(entry), "height" | "rise" | "half_plane", *_):
            own = _number(recorded["bulge"]["by_friction"][entry]["uncertainty"])
            return Stated(own, "itself", abs(value) or 1.0)
        case ("quiescent_zone" | "bulge" | "heat" | "statistics", *_):
            return _largest(recorded, abs(value) or 1.0)
        case ("groups", "peak_pressure_over_hardness"):
            return _largest(recorded, abs(value) or 1.0, "peak_pressure")
        case ("hertz" | "groups", _) if _moves_load(recorded):
            return _largest(recorded, abs(value) or 1.0)
    return Stated(0.0, "", abs(value) or 1.0)


def written(path: Path) -> str:
    """The path as a program would write it: models.half_plane[0].contact.peak_pressure."""
    return "".join(f"[{p}]" if isinstance(p, int) else f".{p}" for p in path).lstrip(".")


def _relative(recorded: dict, model: str, entry: int, figure: str, scale: float) -> Stated:
    """By the total uncertainty of a figure of a model, or of what it depends on."""
    total, by = _total(recorded, model, entry, DEPENDS.get(figure, figure))
    return Stated(total * scale, "itself" if by == figure else by, scale)


def _of_model_error(entry: dict, place: Sequence[str], value: Value | list) -> Stated:
    """What the half-plane's model error states: of an effect its own uncertainty, of the whole and
    of the interaction that of the whole; of an uncertainty its own size."""
    match place:
        case ("effects", effect, "value"):
            return Stated(_number(entry["effects"][effect]["uncertainty"]), "itself", 1.0)
        case ("value",) | ("interaction",):
            return Stated(_number(entry["uncertainty"]), "model_error", 1.0)
        case ("friction",) | ("tolerance",):
            return Stated(0.0, "", abs(value) or 1.0)
    return Stated(abs(value), "itself", 1.0)


def _total(recorded: dict, model: str, entry: int, quantity: str) -> tuple[float, str]:
    """Total uncertainty of a quantity, else the largest there is, and whose it is.
    With too few levels for a total its iteration's part counts: as many levels are repeated."""
    entries = recorded["models"].get(model) or []
    stated = entries[entry].get("uncertainty") or {} if entry < len(entries) else {}
    chosen = [quantity] if quantity in stated else stated
    sizes = {}
    for name in chosen:
        total = stated[name].get("total")
        sizes[name] = _number(stated[name].get("iteration") if total is None else total)
    by = max(sizes, key=sizes.__getitem__, default="")
    return sizes.get(by, 0.0), by


def _largest(recorded: dict, scale: float, quantity: str = "") -> Stated:
    """By the largest of a quantity's uncertainties in any model."""
    found = [
        _total(recorded, model, entry, quantity)
        for model, entries in recorded["models"].items()
        for entry in range(len(entries))
    ]
    total, by = max(found, default=(0.0, ""))
    return Stated(total * scale, by, scale)


def _moves_load(recorded: dict) -> bool:
    """Whether the load is a result of the bodies' compliance."""
    return "approach" in recorded["scene"]["load"]


def _scale(value: float, quantity: str, hertz: dict) -> float:
    """The figure's own size, or the smooth contact's where it vanishes."""
    if value:
        return abs(value)
    length = "length" in quantity or "depth" in quantity or "position" in quantity
    return hertz.get("half_width" if length else "peak_pressure") or 1.0


def _is_number(value: Value | list) -> bool:
    """Whether it can move by an amount: a number, or intervals."""
    return isinstance(value, int | float | list) and not isinstance(value, bool)


def _number(value: object) -> float:
    return float(value) if isinstance(value, int | float) and isfinite(value) else 0.0


def _difference(one: list, other: list) -> float:
    """Length [m] that one of two sets of intervals covers and the other does not."""
    if one == other:
        return 0.0
    ends = np.unique([end for patch in [*one, *other] for end in patch])
    middle = 0.5 * (ends[1:] + ends[:-1])
    covered = np.zeros((2, len(middle)), dtype=bool)
    for row, patches in zip(covered, (one, other), strict=True):
        for start, stop in patches:
            row |= (start < middle) & (middle < stop)
    return float(np.diff(ends) @ (covered[0] ^ covered[1]))
