"""The half-plane's model error as rows of text, for the page and for the terminal."""

from dataclasses import dataclass

from comparisons.common.numbers import given_percent, percent, with_unit
from comparisons.figures.quantity import QUANTITIES, label
from comparisons.report.tables.text import TextTable, error_text, grouped, listed
from comparisons.results.outcome import Outcome
from comparisons.studies.model_error.catalogue import EFFECTS
from comparisons.studies.model_error.model_error import ModelError

WORTH_A_MOVE = 0.75  # of the pressures' difference that is left without it, at most
SHOWN = 5e-4  # effects below this, and below a tenth of the error, are not listed


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


def model_error_rows(outcome: Outcome, judged: bool = False) -> list[ModelErrorRow]:
    """In the order of quantities, then of friction coefficients; only `judged` ones, if asked."""
    tolerance = outcome.problem.scene.tolerances
    rows = []
    for name in QUANTITIES:
        errors = [e for e in outcome.budget.model_errors if e.quantity == name]
        if judged and name not in tolerance:
            continue
        for same in grouped(errors, lambda error: (_shown(error), error.moved)):
            error, uncertainty, contributions = _shown(same[0])
            without = moved_text(outcome, same[0].friction) if name == "pressure_l2" else ()
            rows.append(
                ModelErrorRow(
                    quantity=name,
                    label=label(name),
                    friction=listed(error.friction for error in same),
                    error=error,
                    uncertainty=uncertainty,
                    tolerance=given_percent(tolerance[name]) if name in tolerance else "",
                    contributions=(*without, *contributions),
                    note=left_out(outcome, name),
                    moved=_moved(same),
                )
            )
    return rows


def _shown(error: ModelError) -> tuple[str, str, tuple[str, ...]]:
    size = error_text(error.quantity, error.value, error.uncertainty)
    return size, percent(error.uncertainty), contributions_in_words(error)


def left_out(outcome: Outcome, quantity: str) -> str:
    """That effects which no model has may exceed the tolerance of a quantity; else nothing."""
    budget, tolerance = outcome.budget, outcome.problem.scene.tolerances
    size = None if budget is None else budget.beyond(quantity, tolerance)
    return "" if size is None else f"{percent(size)} not modelled"


def _moved(errors: list[ModelError]) -> str:
    moves = [error.moved for error in errors if error.moved]
    if not moves:
        return ""
    before, after = (with_unit(x, "m", 4) for x in moves[0])
    return f"at x = {after}, of the half-plane at {before}"


def contributions_in_words(error: ModelError) -> tuple[str, ...]:
    """What the half-plane does not model, as shares of its error, the largest first. An effect that
    raises the finite elements' figure makes the half-plane's too low. Norms have no sign."""
    sizes = {EFFECTS[name].label: -effect.value for name, effect in error.effects.items()}
    sizes |= {"interaction": -error.interaction, "another asperity": error.jump}
    least = max(SHOWN, 0.1 * abs(error.value))
    is_norm = QUANTITIES[error.quantity].of_pair
    return tuple(
        f"{name} {error_text(error.quantity, abs(size) if is_norm else size)}"
        for name, size in sorted(sizes.items(), key=lambda item: -abs(item[1]))
        if abs(size) >= least
    )


def moved_text(outcome: Outcome, friction: float) -> tuple[str, ...]:
    """What is left of the pressures' difference once peaks are moved, unless most of it is."""
    entries = outcome.result["model_error"].get("pressure_l2", ())
    entry = next((each for each in entries if each["friction"] == friction), None)
    if entry is None or outcome.problem.scene.profile is None:
        return ()
    if entry["value_after_shift"] > WORTH_A_MOVE * entry["value"]:
        return ()
    mean, left = with_unit(entry["mean_shift"], "m", 2), percent(entry["value_after_shift"])
    return (f"{left} with peaks moved by {mean}",)


def not_modelled_line(outcome: Outcome) -> str:
    """The effects that no model of the run has, by reason, each with its largest estimate."""
    selection = outcome.budget.selection
    effects = (*selection.impossible, *selection.negligible)
    parts = []
    for same in grouped(effects, lambda name: selection.impossible.get(name, "")):
        sizes = [percent(_largest(outcome, selection.estimates[name])) for name in same]
        named = ", ".join(
            f"{EFFECTS[name].label} (at most {size})"
            for name, size in zip(same, sizes, strict=True)
        )
        parts.append(": ".join(filter(None, (named, selection.impossible.get(same[0])))))
    if outcome.budget.left_out is not None:
        parts.append(f"left out is {outcome.budget.left_out}")
    return "; ".join(parts) or "nothing"


def effects_table(outcome: Outcome) -> TextTable | None:
    """What became of each effect that the half-plane does not model; None with one model."""
    if outcome.budget is None:
        return None
    rows = []
    for name, found in outcome.result["error_budget"]["effects"].items():
        if found["status"] != "does not apply":
            effect, estimate = EFFECTS[name], found["estimate"]
            largest = "" if estimate is None else percent(_largest(outcome, estimate))
            rows.append((effect.label, effect.words, found["status"], largest, found["because"]))
    head = ("effect", "not modelled by the half-plane", "status", "estimate, at most", "because")
    return TextTable("", head, tuple(rows)) if rows else None


def _largest(outcome: Outcome, estimate: dict[str, float]) -> float:
    """Of the estimates of an effect on what is judged, or on anything where nothing is."""
    judged = set(outcome.problem.scene.tolerances) & set(estimate)
    return max(estimate[name] for name in judged or estimate)
