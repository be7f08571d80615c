"""What the law of elasticity may change, where the scene leaves it open.

In: a scene whose whole model deforms finitely. Out: the laws with which the whole is solved once
more on its coarsest level, and what they say of every solid that may be meant.

All laws have one limit of small strains. Their next terms have Murnaghan's constants l and m (n
moves nothing in the plane), for lambda and mu of Lame:

    neo-Hookean l = -lambda, m = -lambda - 2 mu; Hencky l = -lambda, m = -lambda - 3 mu;
    St. Venant-Kirchhoff l = m = 0

So a law is a point (l/mu, m/mu), and what it changes is linear in this, to first order in the
strain. The whole's own law and two others are three points; the plane through their figures holds
every solid. The two are solids themselves, that span the largest triangle with the whole's.

Where the scene names no law, the error lies between those of the published solids of its kind.
Where it names a solid whose constants were measured, each is moved by its standard error; two of
them, independent of each other, are the 95 % of every other uncertainty."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np

from analytic.material import Law, Material
from comparisons.figures.quantity import QUANTITIES
from comparisons.models.problem import Problem
from comparisons.models.window import Window
from comparisons.scenes.scene import Scene
from comparisons.scenes.sections import ElasticSection
from comparisons.studies.model_error.quantities_of_interest import (
    QuantitiesOfInterest,
    relative_sizes,
)
from comparisons.studies.model_error.variants import ModelVariant

EFFECT = "law_of_elasticity"
BODIES = ("body", "roller")
COVERED = 2.0  # standard errors
# Relative changes on the coarsest level move by less of themselves on finer ones: peaks and shears
# of smooth contacts by 0.03, lengths, which are read between nodes, by 0.17.
SETTLED = 0.2
# Change of the peak of a smooth contact, over p0/E, by l/mu and m/mu: at Poisson's ratio 0.3 and
# a/R = 0.05, for estimates.
BY_L, BY_M = -0.057, -0.22
FLAT = 0.05  # a triangle's height over its length, below which the plane is taken along it alone

Point = tuple[float, float]  # l/mu, m/mu


def point_of(material: Material) -> Point:
    """The law's constants of third order."""
    lame = 2.0 * material.poissons_ratio / (1.0 - 2.0 * material.poissons_ratio)  # over mu
    law = material.law
    if law.name == "murnaghan":
        ell, m, _ = law.murnaghan
        return ell / material.shear_modulus, m / material.shear_modulus
    return {
        "neo-hookean": (-lame, -lame - 2.0),
        "hencky": (-lame, -lame - 3.0),
        "st-venant-kirchhoff": (0.0, 0.0),
    }[law.name]


def _by_point(ell: float, m: float) -> float:
    return BY_L * ell + BY_M * m


@dataclass(frozen=True)
class OpenLaw:
    """What is not known of the law of one body, or of both where they are of one solid."""

    bodies: tuple[str, ...]  # of BODIES
    material: Material  # with the law that the whole has
    solids: Mapping[str, Point]  # that may be meant, by name
    probes: Mapping[str, Law]  # that the whole is solved with, by name
    is_scatter: bool = False  # of measured constants: the probes are these moved, one by one

    @property
    def words(self) -> str:
        """For the account of effects."""
        if self.is_scatter:
            return "its constants are measured; the whole is solved again at their standard errors"
        solved = " and ".join(self.probes)
        return f"the scene names no solid; the whole is solved again as {solved}"

    @property
    def size(self) -> float:
        """The largest change of the peak of a smooth contact, over p0/E."""
        ell, m = point_of(self.material)
        if self.is_scatter:
            moves = (self._point(law) for law in self.probes.values())
            return COVERED * float(np.hypot.reduce([_by_point(a - ell, b - m) for a, b in moves]))
        return max(abs(_by_point(a - ell, b - m)) for a, b in self.solids.values())

    def range(self, changes: Mapping[str, float]) -> tuple[float, float]:
        """The least and the largest change that a solid makes, by those of the probes."""
        origin = np.array(point_of(self.material))
        moves = [np.array(self._point(law)) - origin for law in self.probes.values()]
        slopes = np.linalg.lstsq(np.array(moves), np.array(list(changes.values())), rcond=FLAT)[0]
        others = [(np.array(point) - origin) @ slopes for point in self.solids.values()]
        every = [*changes.values(), *map(float, others)]
        return min(every), max(every)

    def _point(self, law: Law) -> Point:
        return point_of(replace(self.material, law=law))


def open_laws(scene: Scene) -> tuple[OpenLaw, ...]:
    """Those of a scene's elastic bodies; bodies of equal constants and laws vary together."""
    found: dict[tuple, OpenLaw] = {}
    for name in BODIES:
        section = getattr(scene, name)
        if section.material is None or (open_law := _open_law(section)) is None:
            continue
        key = open_law.material, open_law.is_scatter, tuple(open_law.probes)
        bodies = found[key].bodies if key in found else ()
        found[key] = replace(open_law, bodies=(*bodies, name))
    return tuple(found.values())


def _open_law(section: ElasticSection) -> OpenLaw | None:
    """None where the law is known."""
    if section.law is not None:
        return None
    material = section.material
    solids = dict(DEVELOP.items())
    points = {
        n: point_of(replace(material, law=law(material.shear_modulus))) for n, law in solids.items()
    }
    origin = point_of(material)

    def area(pair: tuple[str, str]) -> float:
        one, other = (np.subtract(points[name], origin) for name in pair)
        return abs(float(one[0] * other[1] - one[1] * other[0]))

    chosen = max(combinations(points, 2), key=area, default=tuple(points))
    probes = {name: solids[name](material.shear_modulus) for name in chosen}
    return OpenLaw((), material, points, probes)


DEVELOP = {
    "carbon steel": lambda mu: Law("murnaghan", (-5.6 * mu, -7.8 * mu, -8 * mu)),
    "7075 aluminium": lambda mu: Law("murnaghan", (-9.4 * mu, -10.3 * mu, -12 * mu)),
    "Armco iron": lambda mu: Law("murnaghan", (-4.2 * mu, -12.6 * mu, 13 * mu)),
    "Pyrex": lambda mu: Law("murnaghan", (0.5 * mu, 3.3 * mu, 15 * mu)),
}


def law_variants(
    whole: ModelVariant, laws: tuple[OpenLaw, ...]
) -> dict[tuple[int, str], ModelVariant]:
    """The whole with each probe, by place in `laws` and the probe's name."""
    return {
        (number, probe): replace(
            whole,
            laws=tuple((body, law) for body in each.bodies),
            laws_name=f"{'-and-'.join(each.bodies)}-{'-'.join(probe.split())}",
        )
        for number, each in enumerate(laws)
        for probe, law in each.probes.items()
    }


@dataclass(frozen=True)
class LawSolutions:
    """The whole at one friction coefficient on its coarsest level, and with other laws."""

    problem: Problem
    window: Window | None
    laws: tuple[OpenLaw, ...]
    whole: QuantitiesOfInterest
    moved: Mapping[tuple[int, str], QuantitiesOfInterest]  # by place in `laws`, and probe

    def spread(self, name: str, at: int) -> "LawSpread":
        """Of a quantity, at an asperity where it is a largest value."""
        low = high = scatter = 0.0
        for number, law in enumerate(self.laws):
            changes = {probe: self._change(number, probe, name, at) for probe in law.probes}
            sizes = list(changes.values())
            if law.is_scatter:
                scatter += COVERED * float(np.hypot.reduce(sizes))
            elif QUANTITIES[name].of_pair:  # a norm's change has no sign
                low, high = low - max(sizes), high + max(sizes)
            else:
                ends = law.range(changes)
                low, high = low + ends[0], high + ends[1]
        half = 0.5 * (high - low) + SETTLED * max(abs(low), abs(high))
        return LawSpread(0.5 * (low + high), half, (1.0 + SETTLED) * scatter)

    def _change(self, number: int, probe: str, name: str, at: int) -> float:
        """Relative, of the whole's figure on that level."""
        change = self.moved[number, probe] - self.whole
        if QUANTITIES[name].of_pair:
            return relative_sizes(change, self.whole, self.problem, self.window)[name]
        scale = abs(self.whole.figures[name][at]) or QUANTITIES[name].scale(self.problem.hertz)
        return float(change.figures[name][at] / scale)


@dataclass(frozen=True)
class LawSpread:
    """What the law changes in the whole's figure, relative to it."""

    middle: float = 0.0  # of the published solids, against the law that the whole has
    half: float = 0.0  # of their range, about its middle
    scatter: float = 0.0  # of measured constants, for 95 %
