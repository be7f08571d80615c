"""The half-plane's model error as rows of text, for the page and for the terminal."""

from dataclasses import dataclass

from comparisons.common.numbers import given_percent, percent, with_unit
from comparisons.figures.figure import Figure, grouped
from comparisons.figures.quantity import QUANTITIES, label
from comparisons.output.page.tables.text import error_text, listed
from comparisons.studies.model_error.account import INPUTS, INTERACTION, JUMP, LEFT
from comparisons.studies.model_error.catalogue import EFFECTS
from comparisons.studies.study import MODEL_ERROR, Run, TextTable

WORTH_A_MOVE = 0.75  # of the pressures' difference that is left without it, at most
SHOWN = 5e-4  # effects below this, and below a tenth of the error, are not listed
WORDS = {INTERACTION: "interaction", JUMP: "another asperity"}  # of parts that are no effects


@dataclass(frozen=True)
class ModelErrorRow:
    """The half-plane's model error in a quantity, at one or more friction coefficients."""

    quantity: str
    label: str
    friction: str
    error: str
    uncertainty: str
    tolerance: str
    # what makes it up with signs, the largest first; of pressures first what moved peaks leave
    contributions: tuple[str, ...]
    note: str  # what to know before the figure is taken for evidence
    moved: str  # where the whole has its largest value, if not at the half-plane's asperity


def model_error_rows(run: Run, judged: bool = False) -> list[ModelErrorRow]:
    """In the order of quantities, then of friction coefficients; only `judged` ones, if asked."""
    rows = []
    for name in QUANTITIES:
        errors = run.figures.of(study=MODEL_ERROR, quantity=name)
        if judged and not any(error.bounds for error in errors):
            continue
        for same in grouped(errors, lambda error: (_shown(error), error.place)):
            error, uncertainty, contributions = _shown(same[0])
            without = moved_text(run, same[0].friction) if name == "pressure_l2" else ()
            bound = same[0].tolerance
            rows.append(
                ModelErrorRow(
                    quantity=name,
                    label=label(name),
                    friction=listed(error.friction for error in same),
                    error=error,
                    uncertainty=uncertainty,
                    tolerance="" if bound is None else given_percent(bound),
                    contributions=(*without, *contributions),
                    note=left_out(run, same[0]),
                    moved=_moved(same[0]),
                )
            )
    return rows


def _shown(error: Figure) -> tuple[str, str, tuple[str, ...]]:
    size = error_text(error.quantity, error.value, error.numerical)
    return size, percent(error.numerical), contributions_in_words(error)


def left_out(run: Run, figure: Figure) -> str:
    """That effects which no model has may exceed the tolerance of a quantity; else nothing."""
    wanted = {"study": MODEL_ERROR, "quantity": figure.quantity, "at": figure.at}
    error = run.figures.one(**wanted)
    if error is None or error.bounds is None or error.not_modelled <= error.tolerance:
        return ""
    return f"{percent(error.not_modelled)} not modelled"


def _moved(error: Figure) -> str:
    if error.place is None:
        return ""
    before, after = (with_unit(x, "m", 4) for x in error.place)
    return f"at x = {after}, of the half-plane at {before}"


def contributions_of(error: Figure) -> dict[str, float]:
    """What a model error is made of, with its sign: an effect that raises the finite elements'
    figure makes the half-plane's too low. Norms have sizes alone."""
    sizes = {}
    for part in error.parts:
        if part.name != INPUTS:
            size = part.value if part.name == JUMP else -part.value
            name = EFFECTS[part.name].label if part.name in EFFECTS else WORDS[part.name]
            sizes[name] = abs(size) if QUANTITIES[error.quantity].of_pair else size
    return sizes


def contributions_in_words(error: Figure) -> tuple[str, ...]:
    """The same in words, the largest first."""
    least = max(SHOWN, 0.1 * abs(error.value))
    return tuple(
        f"{name} {error_text(error.quantity, size)}"
        for name, size in sorted(contributions_of(error).items(), key=lambda item: -abs(item[1]))
        if abs(size) >= least
    )


def moved_text(run: Run, friction: float) -> tuple[str, ...]:
    """What is left of the pressures' difference once peaks are moved, unless most of it is."""
    known = run.figures.of(study=MODEL_ERROR, friction=friction)
    error, left = known.one(quantity="pressure_l2"), known.one(quantity=LEFT)
    if left is None or run.problem.scene.profile is None:
        return ()
    if left.value > WORTH_A_MOVE * error.value:
        return ()
    mean = with_unit(known.one(quantity="pressure_mean_shift").value, "m", 2)
    return (f"{percent(left.value)} with peaks moved by {mean}",)


def not_modelled_line(run: Run) -> str:
    """The effects that no model of the run has, by reason, each with its largest estimate."""
    selection = run.data(MODEL_ERROR).selection
    effects = (*selection.impossible, *selection.negligible)
    parts = []
    for same in grouped(effects, lambda name: selection.impossible.get(name, "")):
        sizes = [percent(_largest(run, selection.estimates[name])) for name in same]
        named = ", ".join(
            f"{EFFECTS[name].label} (at most {size})"
            for name, size in zip(same, sizes, strict=True)
        )
        parts.append(": ".join(filter(None, (named, selection.impossible.get(same[0])))))
    if (left := run.found[MODEL_ERROR].said("left out")) is not None:
        parts.append(f"left out is {left}")
    return "; ".join(parts) or "nothing"


def effects_table(run: Run) -> TextTable | None:
    """What became of each effect that the half-plane does not model; None with one model."""
    if MODEL_ERROR not in run.found:
        return None
    rows = []
    for found in run.found[MODEL_ERROR].table("effects").rows():
        if found["status"] != "does not apply":
            effect = EFFECTS[found["effect"]]
            estimate = {name: found[name] for name in QUANTITIES if found[name] is not None}
            largest = percent(_largest(run, estimate)) if estimate else ""
            rows.append((effect.label, effect.words, found["status"], largest, found["because"]))
    head = ("effect", "not modelled by the half-plane", "status", "estimate, at most", "because")
    return TextTable("", head, tuple(rows)) if rows else None


def _largest(run: Run, estimate: dict[str, float]) -> float:
    """Of the estimates of an effect on what is judged, or on anything where nothing is."""
    judged = set(run.problem.scene.tolerances) & set(estimate)
    return max(estimate[name] for name in judged or estimate)
