"""The factored bodies of a scene: the rough one, and an elastic roller's own where it needs one."""

from collections import OrderedDict
from collections.abc import Callable, Hashable
from dataclasses import dataclass, fields, replace
from functools import partial

import numpy as np

from analytic.material import Law, Material
from comparisons.common.progress import Stages
from comparisons.models.finite_element.mesh import Refinement, block_spec, rough_key, rough_mesh
from comparisons.models.finite_element.roller import (
    disc_support,
    is_disc,
    roller_key,
    roller_mesh,
    roller_spec,
)
from comparisons.models.problem import Problem
from fem.body.elasticity import Coating, ElasticBody, elastic_body
from fem.body.support import Sides, Support
from meshes.block import BlockMesh, BlockSpec
from meshes.build import build_block

UNBOUNDED_SIDES = "fixed"  # half of the error in tau1 that free sides or rollers leave
HELD = 2  # a rough body, and what presses it: each more would add to the memory of a whole run


@dataclass(frozen=True)
class BodyPair:
    """Bodies that press and are pressed."""

    rough: ElasticBody  # the rough body
    # the roller's own body; None: rigid, or the rough body's block serves for both
    roller: ElasticBody | None
    # of the rough body's compliance that a roller without a body adds: moduli's ratio, 0 if rigid
    roller_share: float

    @property
    def all(self) -> tuple[ElasticBody, ...]:
        return (self.rough,) if self.roller is None else (self.rough, self.roller)


class Latest(OrderedDict):
    """The latest few of what was made, by what it was made of."""

    def of(self, make: Callable[[], object], *key: Hashable) -> object:
        """Object made of a key, made where it is new; the oldest beyond HELD is dropped."""
        if key not in self:
            while len(self) >= HELD:  # before the next is made: memory
                self.popitem(last=False)
            self[key] = make()
        self.move_to_end(key)
        return self[key]


class BodyCache:
    """The latest meshes and factored bodies, which all that need the same ones share.
    Loads, friction coefficients, laws at finite strains and profiles in the gap change neither, but
    for a load that changes where the contact may be. Few are held: a request mostly repeats one of
    the last."""

    def __init__(self) -> None:
        self.mesh, self.body = Latest(), Latest()


def bodies_of(
    problem: Problem,
    refinement: Refinement,
    patches: np.ndarray,
    stages: Stages,
    body_cache: BodyCache,
) -> BodyPair:
    """Mesh and factor the bodies for contact predicted on `patches` (k, 2) [m]."""
    scene, degree = problem.scene, problem.scene.finite_element.degree

    def factored(
        spec: BlockSpec,
        words: str,
        shaped: Callable[[Problem, BlockMesh], BlockMesh],
        shape: tuple[Hashable, ...],
        material: Material,
        support: Support,
        coating: Coating | None = None,
    ) -> ElasticBody:
        """The body on the flat mesh of a spec, made `shaped`; flat ones of one spec are alike."""

        def make() -> ElasticBody:
            with stages.stage("mesh", "finite elements: mesh"):
                mesh = shaped(problem, flat)
            with stages.stage("assembly", "finite elements: assembly"):
                made = elastic_body(mesh, material, support, degree=degree, coating=coating)
            with stages.stage("factorisation", "finite elements: factorisation"):
                _ = made.factor
            return made

        key, linear = _key(spec), replace(material, law=Law())
        with stages.stage("mesh", f"finite elements: {words}"):
            flat = body_cache.mesh.of(partial(build_block, spec), key)
        known = body_cache.body.of(make, key, shape, linear, support, degree, coating)
        return known if known.material == material else known.with_law(material.law)

    spec = block_spec(problem, refinement, patches)
    beyond = 0.5 if refinement.half_block else np.inf
    support = rough_support(problem, spec, beyond)
    coating = scene.coating and Coating(scene.coating.material, scene.coating.thickness)
    shaped = rough_mesh, rough_key(problem)
    rough = factored(spec, "mesh", *shaped, scene.body.material, support, coating)
    if scene.roller.rigid:
        return BodyPair(rough, None, 0.0)
    if problem.shares_factor:
        return BodyPair(rough, None, scene.body.youngs_modulus / scene.roller.youngs_modulus)
    wanted = roller_spec(problem, spec)
    aside = beyond if problem.period is None else np.inf
    within = aside * wanted.half_width, beyond * wanted.depth
    support = Support("bonded", _sides(problem), within)
    if is_disc(problem):
        support = disc_support(problem)
    shaped = roller_mesh, roller_key(problem)
    roller = factored(wanted, "mesh of the roller", *shaped, scene.roller.material, support)
    return BodyPair(rough, roller, 0.0)


def rough_support(problem: Problem, spec: BlockSpec, beyond: float = np.inf) -> Support:
    """Support of the rough body; where it is unbounded, everywhere `beyond` this part of it."""
    scene = problem.scene
    within = (
        beyond * spec.half_width if problem.width is None else np.inf,
        beyond * spec.depth if scene.body.thickness is None else np.inf,
    )
    sides = "free" if scene.body.width is not None else _sides(problem)
    return Support(scene.body.base or "bonded", sides, within)


def _sides(problem: Problem) -> Sides:
    """Sides of a body without width of its own."""
    return UNBOUNDED_SIDES if problem.period is None else "tied"


def _key(spec: BlockSpec) -> Hashable:
    """The spec as something that can be looked up."""
    values = (getattr(spec, field.name) for field in fields(spec))
    return tuple(value.tobytes() if isinstance(value, np.ndarray) else value for value in values)
