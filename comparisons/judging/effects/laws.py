"""Changes by the law of elasticity, where the scene leaves it open.

In: a scene whose whole model deforms finitely. Out: the laws with which it is solved once
more on its coarsest level, and what they say of every solid that may be meant.

All laws have one limit of small strains. Their next terms have Murnaghan's constants l and m (n
moves nothing in the plane; `analytic.material.third_order` has those of every law). So a law is a
point (l/mu, m/mu), and what it changes is linear in this, to first order in the strain. The model's
own law and two others are three points; the plane through their figures holds every solid. The two
are solids themselves, that span the largest triangle with the model's.

Where the scene names no law, the error lies between those of the published solids of its kind.
Where it names a solid whose constants were measured, each is moved, and the change is scaled to its
standard error; two of them, independent of each other, are the 95 % of every other uncertainty."""

import math
import operator
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import combinations

import numpy as np

from analytic.material import Law, Material
from analytic.material.third_order import is_elliptic, peak_change, third_order
from comparisons.common.numbers import percent, with_unit
from comparisons.models.level import Level
from comparisons.models.problem import Problem
from comparisons.scenes.materials import RUBBER, measured_solids, scaled_law
from comparisons.scenes.scene import Scene
from comparisons.scenes.sections import ElasticSection

COVERED = 2.0  # standard errors
MOVED = {"l": 5.0, "m": 3.0}  # by these times the shear modulus
NOT_STATED = 0.1  # standard error of a constant whose source has none: as of those that have one
# Relative changes on the coarsest level move by less of themselves on finer ones: peaks and shears
# of smooth contacts by 0.03, lengths, which are read between nodes, by 0.17.
SETTLED = 0.2
SOFT = 1e9  # [Pa] below it, a body like no known solid is taken for rubber
OF_THE_PEAK = 0.3  # largest tau1 below a smooth contact, of its peak pressure
FLAT = 0.05  # a triangle's height over its length, below which the plane is taken along it alone


def point_of(law: Law, material: Material) -> np.ndarray:
    """(2,) l/mu, m/mu."""
    return np.array(third_order(law, material)[:2]) / material.shear_modulus


@dataclass(frozen=True)
class OpenLaw:
    """Law that is not known of one body, or of both where they are of one solid."""

    material: Material  # with the whole model's law
    solids: tuple[tuple[str, Law], ...]  # that may be meant, with the body's own moduli
    # of measured constants, which the probes move one by one: standard errors over the moves
    shares: tuple[float, ...] = ()
    solid: str | None = None  # that the scene names
    bodies: tuple[str, ...] = ()

    @property
    def laws(self) -> tuple[Law, ...]:
        return tuple(law for _, law in self.solids)

    @cached_property
    def probes(self) -> dict[str, Law]:
        """The two laws that span the largest triangle with the body's own, or the only one: the
        whole is solved with these."""
        laws = {name: law for name, law in self.solids if law != self.material.law}

        def area(pair: tuple[str, ...]) -> float:
            one, other = (self._move(laws[name]) for name in pair)
            return abs(float(one[0] * other[1] - one[1] * other[0]))

        chosen = max(combinations(laws, 2), key=area, default=tuple(laws))
        return {name: laws[name] for name in chosen}

    def _move(self, law: Law) -> np.ndarray:
        """(2,) from the body's own law to another."""
        return point_of(law, self.material) - point_of(self.material.law, self.material)

    @property
    def is_scatter(self) -> bool:
        """True for measured constants; else the solids that may be meant."""
        return bool(self.shares)

    def scatter(self, changes: Iterable[float]) -> float:
        """Change by all standard errors together, for 95 %, from the probes' changes."""
        return COVERED * math.hypot(*map(operator.mul, self.shares, changes))

    @property
    def words(self) -> str:
        """Words for the account of effects."""
        solved = " and ".join(self.probes)
        if self.is_scatter:
            return f"its constants were measured; for their errors it is solved with {solved}"
        return f"{' and '.join(self.bodies)} of no measured solid: solved again as {solved}"

    @property
    def size(self) -> float:
        """The largest change of the peak of a smooth contact, over p0/E."""
        before = peak_change(self.material.law, self.material)
        changes = [peak_change(law, self.material) - before for law in self.laws]
        return self.scatter(changes) if self.is_scatter else max(map(abs, changes))

    def range(self, changes: Mapping[str, float]) -> tuple[float, float]:
        """The least and the largest change that a solid makes, by those of the probes."""
        moves = np.array([self._move(law) for law in self.probes.values()])
        slopes = np.linalg.lstsq(moves, np.array(list(changes.values())), rcond=FLAT)[0]
        every = [*changes.values(), *(float(self._move(law) @ slopes) for law in self.laws)]
        return min(every), max(every)


def open_laws(scene: Scene) -> tuple[OpenLaw, ...]:
    """Laws of a scene's elastic bodies; bodies of one solid vary together, as do those of equal
    constants that name none."""
    bodies: dict[OpenLaw, list[str]] = {}
    for name, section in scene.elastic_sections.items():
        if (law := _open_law(section)) is not None:
            bodies.setdefault(replace(law, solid=section.solid), []).append(name)
    return tuple(replace(law, bodies=tuple(names)) for law, names in bodies.items())


def _open_law(section: ElasticSection) -> OpenLaw | None:
    """Law of a section; None where it is known for certain."""
    material = section.material
    if section.law is not None:
        return _scattered(material) if section.measured_law is not None else None
    if RUBBER in section.kinds or (not section.kinds and material.youngs_modulus < SOFT):
        laws = {"neo-Hookean rubber": Law(), "rubber by Hencky's law": Law("hencky")}
    else:
        measured = measured_solids(*section.kinds)
        laws = {solid.name: scaled_law(solid, material) for solid in measured}
    return OpenLaw(material, tuple(laws.items()))


def _scattered(material: Material) -> OpenLaw:
    """Law with l and m moved, by more than the standard error: a small change of a length, which is
    read between nodes, would be noise."""
    constants = np.array(material.law.murnaghan)
    errors = material.law.standard_errors or NOT_STATED * np.abs(constants)
    moved, shares = {}, []
    for place, (name, times) in enumerate(MOVED.items()):
        step = np.zeros(3)
        step[place] = times * material.shear_modulus
        moved[f"{name} moved"] = Law("murnaghan", tuple(constants + step))
        shares.append(float(errors[place] / step[place]))
    return OpenLaw(material, tuple(moved.items()), tuple(shares))


@dataclass(frozen=True)
class LawSpread:
    """Changes of the whole model's figure by the law, relative to it."""

    middle: float = 0.0  # of the published solids, against the whole model's law
    half: float = 0.0  # of their range, about its middle
    scatter: float = 0.0  # of measured constants, for 95 %


def law_spread(laws: tuple[OpenLaw, ...], changes: Mapping[tuple[int, str], float]) -> LawSpread:
    """Spread from the probes' relative changes on the coarsest level, by law's index and probe."""
    low = high = scatter = 0.0
    for number, law in enumerate(laws):
        mine = {probe: changes[number, probe] for probe in law.probes}
        if law.is_scatter:
            scatter += law.scatter(mine.values())
        else:
            ends = law.range(mine)
            low, high = low + ends[0], high + ends[1]
    half = 0.5 * (high - low) + SETTLED * max(abs(low), abs(high))
    return LawSpread(0.5 * (low + high), half, (1.0 + SETTLED) * scatter)


def trust(problem: Problem, whole: Level) -> str | None:
    """Where Murnaghan's series is strained beyond half of what it bears, in a sentence without its
    full stop; None where it is not, or no body has it.

    Its strains are taken for those of a linear body under the largest pressure and the largest
    principal shear; it bears them where the acoustic tensor stays positive."""
    peak, stress = int(np.argmax(whole.solution.pressure)), whole.stress
    pressure = float(whole.solution.pressure[peak])
    tau1 = OF_THE_PEAK * pressure if stress is None else stress.extremes["tau1"].value
    for name, section in problem.scene.elastic_sections.items():
        material = section.material
        if material.law.murnaghan is None:
            continue
        nu = material.poissons_ratio
        squeezed = pressure * (1.0 + nu) * (1.0 - 2.0 * nu) / material.youngs_modulus
        sheared = 0.5 * tau1 / material.shear_modulus
        times = np.linspace(0.0, 2.0, 201)[1:]
        stretches = 1.0 - times * squeezed + np.outer([1.0, -1.0], times * sheared)
        lost = np.flatnonzero(~is_elliptic(material.law, material, *stretches))
        if lost.size:
            x, share = with_unit(whole.grid.x[peak], "m", 3), percent(1.0 / float(times[lost[0]]))
            return (
                f"at x = {x} the {name} is strained to {share} of what its third-order constants "
                "bear (beyond 100 % they describe no stable solid): terms of higher order, which "
                "nobody has measured, count there"
            )
    return None
