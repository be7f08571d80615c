"""The check of the finite elements' compliance before contact, as a table and how to read it."""

from itertools import chain, repeat

from comparisons.common.numbers import percent, plain, with_unit
from comparisons.models.finite_element.compliance_check import OperatorCheck
from comparisons.report.tables.evidence import Table
from comparisons.results.outcome import Outcome

READING = {
    "neither": "Mesh and body are right: what is left between the models is contact.",
    "mesh": "The mesh is too coarse under the pressures: no other figure is better than it.",
    "modulus": "The finite elements' elastic constants are not those of the other model.",
    "block": "The block is too small, or held too near, to stand for the body.",
    "geometry": "The mesh is right; the body is not judged, its own geometry is in the figures.",
}
FOUND = {
    "neither": "no fault of mesh or body",
    "mesh": "the mesh is too coarse",
    "modulus": "the elastic constants are off",
    "block": "the block is too small",
    "geometry": "no fault of the mesh",
}
HOW = (
    "Displacements under given pressures on the finest level, before any contact, against those of "
    "the nearest analytic surface{datum}. Columns: under a single pressure element, the L2 norm of "
    "the difference; far: without the elements next to the load. Waves: the work of the pressures, "
    "negative where finite elements are stiffer. Both small: mesh and body are right, what is left "
    "is contact error. Short waves off: the mesh. Columns off far from the load, or long waves "
    "only: the block's size. All waves off alike: the elastic constants."
)


def operator_table(outcome: Outcome) -> Table | None:
    """Columns and waves of the finest level; None where nothing was checked."""
    check = _check(outcome)
    if check is None:
        return None
    head = ["", "difference", "far"]
    if check.half_plane is not None:
        head.append(f"from the half-plane: what {_listed(check.finite)} does")
    found, effect = check.nearest, check.half_plane
    others = repeat(None) if effect is None else chain(effect.columns, effect.waves)
    rows = []
    for own, other in zip(chain(found.columns, found.waves), others, strict=False):
        if own in found.columns:
            name, far = f"column at x = {with_unit(own.x, 'm', 3)}", percent(own.beyond)
            signed = False
        else:
            name, far = f"waves of {with_unit(own.length, 'm', 3)}", ""
            name, signed = f"{name}, {plain(float(f'{own.elements:.3g}'))} elements", True
        cells = [name, percent(own.difference, signed=signed), far]
        if other is not None:
            cells.append(percent(other.difference, signed=signed))
        rows.append(tuple(cells))
    title = f"Finite elements' compliance before contact: {FOUND[check.verdict]}"
    return Table(title, tuple(head), tuple(rows))


def operator_note(outcome: Outcome) -> str:
    """What the table says, and how it is read; empty without one."""
    check = _check(outcome)
    if check is None:
        return ""
    datum = "" if check.datum else ", a constant removed"
    because = check.because[0].upper() + check.because[1:]
    return f"{READING[check.verdict]} {because}. {HOW.format(datum=datum)}"


def _check(outcome: Outcome) -> OperatorCheck | None:
    run = outcome.runs.get("finite_element")
    return None if run is None else run.finest.operator


def _listed(names: tuple[str, ...]) -> str:
    return " and ".join(f"the {name}" for name in names)
