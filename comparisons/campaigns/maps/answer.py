"""What is said of a scene before it is solved: a verdict and corrected figures of the half-plane.

By the finished map of the scene's kind that knows most, with the uncertainty of its interpolation
and the estimates of what its points leave out. Else by the half-plane with all that it can have,
on the deformed surface or by an operator, its contact alone; and what each effect may do at most,
by estimates."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from comparisons.campaigns.maps.map import finished_map, finished_names
from comparisons.campaigns.maps.place import Place, known_to, place_on, unlike
from comparisons.common.numbers import percent, with_uncertainty
from comparisons.common.progress import Stages
from comparisons.figures.figure import Figure
from comparisons.figures.quantity import QUANTITIES, WHOLE, error_text, label
from comparisons.figures.uncertainty import Uncertainty
from comparisons.models.half_plane import half_plane_level
from comparisons.models.problem import Problem
from comparisons.studies.contact import values_of
from comparisons.studies.ladder.operators import (
    OperatorModel,
    carried_deformed,
    carried_linear,
    is_deformed,
    problem_carrying,
    words_of,
)
from comparisons.studies.ladder.rungs import verdict_of
from comparisons.studies.model_error.catalogue import COUPLED, EFFECTS, UNKNOWN
from comparisons.studies.model_error.estimates import Sizes, beyond_second_order, estimates
from comparisons.studies.model_error.laws import EFFECT as LAW

Values = Mapping[str, float]
NAME = "first answer"
CORRECTED = ("peak_pressure", "contact_length")  # figures of the contact alone
MOST_ELEMENTS = 100_000  # of pressure: more take longer than anybody waits for a first answer


@dataclass(frozen=True)
class CoarseContact:
    """The half-plane's contact on the scene's third level, and how far the second is off."""

    problem: Problem
    values: Values  # [SI] by quantity of CORRECTED
    unsure: Values  # relative
    pressure: np.ndarray

    @classmethod
    def of(cls, problem: Problem) -> "CoarseContact":
        """Nothing that answers here flows, though the scene's finite elements may."""
        scene, friction = problem.scene, problem.scene.load.friction[0]
        problem = replace(problem, scene=scene.unchecked({"finite_element.plastic": False}))
        levels = [half_plane_level(problem, p, None, Stages()) for p in problem.pitches[-2:]]
        first, last = (values_of(level, problem, friction) for level in (levels[0], levels[-1]))
        unsure = {name: abs(first[name] / last[name] - 1.0) for name in CORRECTED}
        values = {name: last[name] for name in CORRECTED}
        return cls(problem, values, unsure, levels[-1].solution.pressure)

    @property
    def sizes(self) -> dict[str, Sizes]:
        """Estimates of all that the half-plane leaves out."""
        return self.left(frozenset())

    def left(self, held: frozenset[str]) -> dict[str, Sizes]:
        """Of what a model with the effects `held` leaves out."""
        peak = float(self.pressure.max())
        mean = float(self.pressure @ self.pressure / self.pressure.sum())
        known = estimates(self.problem, peak, mean, held)
        applying = {name: of for name, of in known.items() if EFFECTS[name].applies(self.problem)}
        return {name: sizes for name, sizes in applying.items() if name not in held}

    def text(self, errors: Mapping[str, tuple[float, float]]) -> str:
        """Figures corrected by relative model errors with their uncertainties."""
        said = []
        for name in CORRECTED:
            if name in errors and errors[name][1] < 1.0:
                (error, unsure), value = errors[name], self.values[name]
                corrected = value / (1.0 + error)
                unit, total = QUANTITIES[name].unit, unsure / (1.0 + error) + self.unsure[name]
                figure = with_uncertainty(corrected, corrected * total, unit, value)
                said.append(f"{label(name)} {figure}")
        return ", ".join(said)


def first_answer(problem: Problem) -> list[str]:
    """Lines for a user who waits; none where they would take as long as the half-plane's run."""
    if np.ptp(problem.extent) > MOST_ELEMENTS * problem.pitches[-1]:
        return []
    contact = CoarseContact.of(problem)
    answers = [answer for name in finished_names() if (answer := _by_map(name, contact))]
    if answers:
        place, figures = min(answers, key=lambda one: sum(f.total for f in one[1]))
        return [_verdict(place, figures, contact)]
    return [*_by_half_plane(contact), *_by_estimates(contact)]


def _by_map(name: str, contact: CoarseContact) -> tuple[Place, list[Figure]] | None:
    """Judged errors where the map is of the scene's kind, and the scene between its points."""
    problem, content = contact.problem, finished_map(name)
    place = None if unlike(content, problem) else place_on(name, problem)
    tolerances = problem.scene.tolerances
    if place is None or place.shown != place.groups or not place.errors.keys() >= tolerances.keys():
        return None
    left, figures = contact.left(_effects_of(content)).values(), []
    for quantity, tolerance in tolerances.items():
        error, bound = place.errors[quantity], sum(sizes.get(quantity, 0.0) for sizes in left)
        grown = (1.0 + abs(error)) * bound / (1.0 - bound) if bound < 1.0 else np.inf
        parts = {"map": known_to(content, quantity, *place.shown), "effects": grown}
        figures.append(
            Figure(
                study=NAME,
                quantity=quantity,
                source="half_plane",
                value=error,
                against=WHOLE,
                uncertainty=Uncertainty(parts),
                bounds=(-tolerance, tolerance),
            )
        )
    return place, figures


def _effects_of(content: dict) -> frozenset[str]:
    """What the finite elements of a map have."""
    switched = content["finite_element"].items()
    names = {
        name for name, effect in EFFECTS.items() if effect.sets and effect.sets.items() <= switched
    }
    if "finite_strain" in names:
        names.add("deformed_gap")
    groups = {content[axis]["group"] for axis in "xy"}
    if {"a_over_thickness", "a_over_width"} & groups:
        names.add("finite_size")
    if "coating_over_a" in groups:
        names.add("coating")
    return frozenset(names)


def _verdict(place: Place, figures: list[Figure], contact: CoarseContact) -> str:
    errors = {figure.quantity: (figure.value, figure.total) for figure in figures}
    said = ", ".join(
        f"{label(name)} {error_text(name, error, unsure).removesuffix(' %')} ± {percent(unsure)}"
        for name, (error, unsure) in errors.items()
    )
    verdict = verdict_of(figures).upper()
    return f"{place.words}: {verdict}, model error {said}; {contact.text(errors)}"


def _by_half_plane(contact: CoarseContact) -> list[str]:
    """The contact with all effects that a half-plane's solution can have."""
    problem = contact.problem
    sizes, friction = contact.sizes, max(problem.scene.load.friction)
    deformed = carried_deformed(problem, sizes)
    held = deformed or carried_linear(problem.scene, sizes)
    if not held:
        return []
    coupling = friction if COUPLED in held else 0.0
    posed = problem_carrying(problem, held)
    model = OperatorModel(posed, (friction,), coupling, is_deformed(held))
    solved = values_of(model.level(problem.pitches[-1], None), problem, friction)
    left = [of for name, of in sizes.items() if name not in held]
    if deformed:
        left.append(beyond_second_order(problem, float(contact.pressure.max())))
    errors = {}
    for name in CORRECTED:
        bound = sum(of.get(name, 0.0) for of in left)
        errors[name] = contact.values[name] / solved[name] - 1.0, bound
    text = contact.text(errors)
    return [f"by the {words_of(held)}: {text}"] if text else []


def _by_estimates(contact: CoarseContact) -> list[str]:
    bounds = []
    counted = {e: of for e, of in contact.sizes.items() if e not in UNKNOWN or e == LAW}
    for name in contact.problem.scene.tolerances:
        sizes = {effect: of[name] for effect, of in counted.items() if name in of}
        if sizes:
            total, most = sum(sizes.values()), max(sizes, key=sizes.get)
            bound = f"{100.0 * total:.2g} %" if total < 1.0 else "100 % or more"
            bounds.append(f"{label(name)} {bound} ({EFFECTS[most].label} most)")
    if not bounds:
        return []
    return [f"by estimates, on no finished map: model error at most about {', '.join(bounds)}"]
