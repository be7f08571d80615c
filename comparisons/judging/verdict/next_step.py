"""Next step: a sentence on what to do, and the command that does it.

In: a run and its verdict. Out: of what would decide or improve it the best that the scene takes.
Each offer is held to the scene's own rules before it is printed: what they refuse, what is done
already, and what would not compute what it speaks of is passed over, and the next best comes up."""

import math
import shlex
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from analytic.contact.problem import ContactError
from comparisons.common.errors import InputError
from comparisons.common.numbers import percent, percent_as_written, plain, rounded_up, with_unit
from comparisons.common.progress import machine_memory
from comparisons.figures.figure import Figure, deciding
from comparisons.figures.quantity import HYPHENATED, QUANTITIES, WHOLE, label
from comparisons.judging import yielding
from comparisons.judging.effects.catalogue import EFFECTS, FLOW, LAW, SAMPLING, contained, why_not
from comparisons.judging.model_error.model_error import INPUTS
from comparisons.judging.model_error.show import figure_of_whole
from comparisons.judging.study import LADDER, MODEL_ERROR, Run
from comparisons.models.plan import time_with_flow, with_one_more
from comparisons.models.posing import problem_of
from comparisons.models.problem import TABOR
from comparisons.scenes.materials import kinds_like, measured_solids, solids, typical_range
from comparisons.scenes.scene import settings_of, with_law, with_settings, with_tolerance
from comparisons.scenes.sections import ElasticSection

AT_TOLERANCE = 0.2  # of the tolerance: an error that is certain to that and still not decided
PLASTIC = "finite_element.plastic=true"
SHEARS = ("tau1_max", "txz_max_abs")
MORE_SAMPLES = "a trace with more samples on the contact"


@dataclass(frozen=True)
class Offer:
    """One thing to do, in words without a full stop: fields to set and options of the command."""

    says: str
    settings: tuple[str, ...] = ()  # FIELD=VALUE
    options: Mapping[str, str] = field(default_factory=dict)
    computes: str = ""  # the effect that it is to compute
    is_known: bool = True  # whether the values are: else the user puts in his own
    or_linear: bool = False  # whether linear elasticity may be the question in its place


LINEAR = Offer("--law linear, within linear elasticity", options={"--law": "linear"})


def next_of(run: Run, kind: str) -> tuple[Offer, ...]:
    """Offers that would decide or improve a verdict of a kind; another question after it."""
    offers = (offer for offer in _candidates(run, kind) if offered(run, offer))
    best = next(offers, Offer("a lighter load or a smoother surface"))
    return (best, LINEAR) if best.or_linear and offered(run, LINEAR) else (best,)


def offered(run: Run, offer: Offer) -> bool:
    """True if a run's scene takes what is offered, is another one then, and what the offer is to
    compute can be computed there. What changes nothing is but a sentence."""
    scene = run.problem.scene
    if not (offer.settings or offer.options):
        return True
    try:
        changed = with_settings(scene, offer.settings)
        if "--law" in offer.options:
            changed = with_law(changed, offer.options["--law"])
        if "--tolerance" in offer.options:
            changed = with_tolerance(changed, float(offer.options["--tolerance"]))
        if changed.tables == scene.tables:
            return "--models" in offer.options
        posed = problem_of(changed, run.problem.surface, run.problem.hertz.load_per_length)
    except (InputError, ContactError):
        return False
    wanted = {offer.computes} - {"", *contained(changed)}
    return not any(why_not(effect, posed) for effect in wanted)


def pasted(run: Run, offer: Offer) -> tuple[str, ...]:
    """The run's own command with what is offered, for a shell; for Python where none was typed.
    None of one whose words no text holds, such as a file's name in another encoding."""
    scene = run.problem.scene
    is_text = all(map(str.isprintable, scene.command))
    if not (offer.settings or offer.options) or not (offer.is_known and is_text):
        return ()
    if words := scene.command:
        for text in offer.settings:
            words = (*_without(words, "--set", text.partition("=")[0]), "--set", text)
        for option, value in offer.options.items():
            words = (*_without(words, option), option, value)
        return (shlex.join(words),)
    fields = settings_of(scene, offer.settings)
    asked = [f"scene.changed({fields!r})" if fields else "scene"]
    if "--tolerance" in offer.options:
        asked.append(f"tolerance={offer.options['--tolerance']}")
    if "--law" in offer.options:
        asked.append(f"law={offer.options['--law']!r}")
    return (f"crosscheck.run({', '.join(asked)})",)


def _without(words: Sequence[str], option: str, name: str = "") -> list[str]:
    """The words of a command without an option and its value; of one that sets fields, without that
    of a name."""
    kept, rest = [], iter(words)
    for word in rest:
        given, equals, value = word.partition("=")
        if given != option:
            kept.append(word)
            continue
        value = value if equals else next(rest, "")
        if name and value.partition("=")[0].strip() != name:
            kept += [option, value]
    return kept


def _candidates(run: Run, kind: str) -> Iterator[Offer]:
    """Offers that may be made, the best first. What changes nothing can always be said."""
    if kind == "not converged":
        yield from _finer_pressures(run)
    elif kind == "not compared":
        both = {"--models": ",".join(HYPHENATED.values())}
        yield Offer("both models show how far to trust either", options=both)
    elif run.findings[yielding.NAME].said(yielding.BEYOND_DOUBT):
        why = run.data(MODEL_ERROR).selection.impossible.get(FLOW, "")
        yield from _of_effect(run, FLOW)
        yield Offer(f"a scene whose flow can be computed{why and f': {why}'}")
    elif not run.model_errors:
        yield Offer("a tolerance to judge by, such as tolerance.peak_pressure = 0.02")
    elif kind == "inconclusive":
        yield from _of_open(run, deciding(run.model_errors))
    else:
        if unknown := yielding.may_flow(run, at_any=kind == "fails"):
            stress, said, is_known = _typical_stress(run)
            words = f"body.yield_stress: {unknown}{said * is_known}"
            yield Offer(words, (f"body.yield_stress={stress}",), is_known=is_known)
        whole = f"{figures_of_whole(run)} in place of the half-plane's"
        yield Offer("nothing" if kind == "holds" else whole)


def figures_of_whole(run: Run) -> str:
    """The figures to use instead, at the largest friction, each with its uncertainty; before them
    those that are not known to their tolerance, or that the body cannot bear, and why."""
    friction, known = max(run.problem.scene.load.friction), run.figures.of(study=LADDER)
    offered, withheld = [], {}
    for error in run.model_errors.of(friction=friction):
        of_whole = known.one(source=WHOLE, quantity=error.quantity, friction=friction) or error
        unsure, value = of_whole.total, figure_of_whole(run, error)
        borne = _borne(run, friction) if error.quantity in SHEARS else math.inf
        size = with_unit(value, QUANTITIES[error.quantity].unit)
        figure = f"{label(error.quantity)} {size} ± {percent(unsure)}"
        if value > borne:
            why = f"more than the body bears, {with_unit(borne, 'Pa')}"
            withheld.setdefault(why, []).append(figure)
        elif not unsure <= error.tolerance:
            why = "finer levels take more budget.time"
            if of_whole.not_modelled > of_whole.numerical:
                why = f"{EFFECTS[of_whole.largest_unknown].label} is not modelled"
            withheld.setdefault(f"not known to the tolerance ({why})", []).append(figure)
        else:
            offered.append(figure)
    where = f" (friction {plain(friction)})" if len(run.problem.scene.load.friction) > 1 else ""
    said = f"take the whole model's {', '.join(offered)}" if offered else "take no figure"
    words = (f"{', '.join(figures)}: {why}" for why, figures in withheld.items())
    return "; ".join([*words, f"{said}{where}"])


def _borne(run: Run, friction: float) -> float:
    """The largest shear [Pa] that a body bears which flows in the whole model: by von Mises, with
    what it has hardened by; infinite where the flow stress is not known."""
    body = run.problem.scene.body
    if body.yield_stress is None or FLOW not in run.data(MODEL_ERROR).selection.whole:
        return math.inf
    flow = body.flow_stress()
    wanted = {"study": yielding.NAME, "quantity": yielding.PLASTIC_STRAIN, "source": WHOLE}
    strain = run.figures.one(**wanted, friction=friction)
    if strain is None:
        hardens = flow.slope(np.zeros(1))[0] or flow.kinematic
        return math.inf if hardens else flow.yield_stress / 3.0**0.5
    most = strain.value * (1.0 + strain.numerical)
    # Prager's back stress in tension is H' times the plastic strain
    return float(flow.stress(most) + flow.kinematic * most) / 3.0**0.5


def _of_open(run: Run, worst: Figure) -> Iterator[Offer]:
    """Offers that would decide an error: its largest unknown computed, or a smaller uncertainty;
    else the tolerance at which it holds."""
    largest = worst.largest_unknown
    why = run.data(MODEL_ERROR).selection.impossible.get(largest, "")
    because = f"{EFFECTS[largest].label} is not computed: {why}" if why else ""
    if not worst.is_unresolved and largest:
        yield from _of_effect(run, largest)
        because = f"{MORE_SAMPLES} tells more" if largest == SAMPLING else because
        because = because or (_unknown_law(run) if largest == LAW else "")
    elif worst.uncertainty.parts.get(INPUTS, 0.0) > 0.5 * worst.numerical:
        because = "third-order constants are measured no better"
    elif worst.total <= AT_TOLERANCE * worst.tolerance:
        because = "the error lies at the tolerance, and more digits decide nothing that matters"
    else:
        yield from _finer_levels(run)
    if math.isfinite(reach := max(error.reach for error in run.model_errors)):
        holds_at = rounded_up(reach)
        said = f"a tolerance of {percent_as_written(holds_at)} holds{because and f'; {because}'}"
        options = {"--tolerance": f"{holds_at:g}"}
        yield Offer(said, options=options, or_linear=largest == LAW and not worst.is_unresolved)
    if largest == SAMPLING:
        yield Offer(MORE_SAMPLES)
    if largest == FLOW:
        yield LINEAR


def _of_effect(run: Run, name: str) -> Iterator[Offer]:
    """Offers that compute an effect."""
    selection = run.data(MODEL_ERROR).selection
    why = selection.impossible.get(name, "")
    if "budget.effects" in why:
        asked = "true" if "not asked for" in why else "all"
        yield Offer("budget.effects computes it", (f"budget.effects={asked}",), computes=name)
    seconds = selection.time if name == "finite_strain" else 0.0
    if name == FLOW and "budget.time" in why:
        patches = run.runs["half_plane"].levels[0].patches
        seconds = time_with_flow(run.problem, patches)
    if seconds:
        text = f"budget.time={rounded_up(seconds):g}"
        yield Offer("budget.time computes it", (text,), computes=name)
    if name == FLOW:
        yield from _of_flow(run)
    elif name == LAW:
        yield from _of_law(run)
    elif name == "roller_support":
        said = 'roller.support is what holds the roller: "opposite", "half disc" or {hub = …}'
        yield Offer(said, ("roller.support=opposite",))


def _of_flow(run: Run) -> Iterator[Offer]:
    """A yield stress, the switch, and a load in place of an approach, as far as they are needed."""
    stress, said, is_known = _typical_stress(run)
    given = () if run.problem.scene.body.yield_stress else (f"body.yield_stress={stress}",)
    load = f"load.per_length={run.problem.hertz.load_per_length:.6g}"
    for way in (*[()] * bool(given and run.plan.effects), (PLASTIC,), (load, PLASTIC)):
        settings = (*given, *way)
        fields = ", ".join(text.partition("=")[0] for text in settings)
        words = f"the flow is computed with {fields}{said * bool(given)}"
        yield Offer(words, settings, {}, FLOW, is_known, or_linear=bool(given))


def _typical_stress(run: Run) -> tuple[str, str, bool]:
    """A yield stress as text, what is to be said of it, and whether it may stand for the body's: by
    the hardness or by the solid; of a class of solids it is but an example."""
    body = run.problem.scene.body
    if body.yield_stress is not None:
        return f"{body.yield_stress:g}", "", True
    if body.hardness is not None:
        stress = _in_mpa(body.hardness / TABOR)
        return stress, f"; {stress} is a third of the hardness, put in yours", True
    known = solids()[body.solid].typical.get("yield_stress") if body.solid else None
    if known is not None:
        stress = _in_mpa(known.value)
        return stress, f"; {stress} is typical, put in yours", True
    if (typical := typical_range("yield_stress", None, body.kinds)) is None:
        return _in_mpa(yielding.STIFF), "", False
    low, high = (with_unit(end, "Pa", 2) for end in typical)
    return (
        _in_mpa(sum(typical) / 2.0),
        f"; typical of {' or '.join(body.kinds)} is {low} to {high}",
        False,
    )


def _in_mpa(stress: float) -> str:
    return f"{stress / 1e6:.4g} MPa"


def _of_law(run: Run) -> Iterator[Offer]:
    """The measured solids that bodies without a name may be of the class of, with their own moduli,
    to which measured constants belong."""
    like, settings = {}, []
    for name, part in _bodies_of_open_law(run).items():
        if part.solid is None:
            kinds = kinds_like(part.youngs_modulus, part.poissons_ratio)
            solid = next((one for one in measured_solids(*kinds) if one.kind in kinds), None)
            if solid is None:
                return
            like[name] = f'{name}.material = "{solid.name}"'
            settings.append(f"{name}.material={solid.name}")
            settings += [
                f"{name}.{field}={solid.values[field].value!r}"
                for field in ("youngs_modulus", "poissons_ratio")
                if not solid.agrees(field, getattr(part, field))
            ]
    if like:
        said = (
            f"{' and '.join(like.values())}, or what it is (crosscheck materials), with its moduli"
        )
        yield Offer(said, tuple(settings), or_linear=True)


def _bodies_of_open_law(run: Run) -> dict[str, ElasticSection]:
    """Bodies, by name, between whose laws of elasticity an error lies."""
    laws = run.data(MODEL_ERROR).selection.laws
    names = dict.fromkeys(name for law in laws if not law.is_scatter for name in law.bodies)
    return {name: getattr(run.problem.scene, name) for name in names}


def _unknown_law(run: Run) -> str:
    """Why the law of elasticity is not known better."""
    bodies = _bodies_of_open_law(run)
    named = dict.fromkeys(part.solid for part in bodies.values())
    if None in named:
        return f"{' and '.join(bodies)}.material would narrow it, where it is known"
    return f"no third-order constants of {' or '.join(named)} are published" if named else ""


def _finer_levels(run: Run) -> Iterator[Offer]:
    """The time and the memory of one more level of each model."""
    budget = run.problem.scene.budget
    seconds, memory = with_one_more(run.problem, run.runs)
    wanted = {"memory": rounded_up(memory)} if memory > budget.memory else {}
    if seconds > budget.time or not wanted:
        wanted["time"] = max(2.0 * budget.time, rounded_up(seconds))
    if memory <= machine_memory():
        fields = " and ".join(f"budget.{name}" for name in wanted)
        settings = tuple(f"budget.{name}={size:g}" for name, size in wanted.items())
        yield Offer(f"{fields} for finer levels and a smaller uncertainty", settings)


def _finer_pressures(run: Run) -> Iterator[Offer]:
    """Pressure elements of half the size, by whichever field the scene says it."""
    asked = run.problem.scene.resolution
    for settings in (
        f"resolution.pitch={0.5 * run.problem.pitches[0]:.6g}",
        f"resolution.elements={2.0 * (asked.elements or 1.0):g}",
        f"resolution.nodes={2 * (asked.nodes or 1)}",
    ):
        yield Offer("finer pressures may converge; else a lighter load", (settings,))
