"""The factored bodies of a scene: the rough one, and an elastic roller's own where it needs one."""

from collections import OrderedDict
from collections.abc import Callable, Hashable
from dataclasses import dataclass, fields, replace
from functools import partial
from typing import TypeVar

import numpy as np

from analytic.material import Law, Material
from comparisons.common.progress import Stages
from comparisons.models.finite_element.mesh import Refinement, block_spec, rough_key, rough_mesh
from comparisons.models.finite_element.roller import (
    disc_support,
    is_disc,
    is_shaped,
    roller_key,
    roller_mesh,
    roller_spec,
)
from comparisons.models.problem import Problem
from fem.body.elasticity import Coating, ElasticBody, elastic_body
from fem.body.support import Sides, Support
from meshes.block import BlockMesh, BlockSpec
from meshes.build import build_block

Result = TypeVar("Result")

UNBOUNDED_SIDES = "fixed"  # half of the error in tau1 that free sides or rollers leave
HELD = 2  # a rough body, and what presses it: each more would add to the memory of a whole run


@dataclass(frozen=True)
class BodyPair:
    """What presses and is pressed."""

    rough: ElasticBody  # the rough body
    # the roller's own body; None: rigid, or the rough body's block serves for both
    roller: ElasticBody | None
    # of the rough body's compliance that a roller without a body adds: moduli's ratio, 0 if rigid
    roller_share: float

    @property
    def all(self) -> tuple[ElasticBody, ...]:
        return (self.rough,) if self.roller is None else (self.rough, self.roller)


class BodyCache:
    """The latest meshes and factored bodies, which all that need the same ones share.
    Loads, friction coefficients, laws at finite strains and profiles in the gap change neither, but
    for a load that changes where the contact may be. Few are held: a request mostly repeats one of
    the last."""

    def __init__(self) -> None:
        self._meshes: OrderedDict[Hashable, BlockMesh] = OrderedDict()
        self._bodies: OrderedDict[Hashable, ElasticBody] = OrderedDict()

    def mesh(self, spec: BlockSpec) -> BlockMesh:
        return _held(self._meshes, _key(spec), partial(build_block, spec))

    def body(
        self, shape: Hashable, make: Callable[[], ElasticBody], *properties: Hashable
    ) -> ElasticBody:
        """The body of a shape and its properties, made and factored where it is new."""
        return _held(self._bodies, (shape, *properties), make)


def bodies_of(
    problem: Problem,
    refinement: Refinement,
    patches: np.ndarray,
    stages: Stages,
    body_cache: BodyCache,
) -> BodyPair:
    """Mesh and factor the bodies for contact predicted on `patches` (k, 2) [m]."""
    scene, settings = problem.scene, problem.scene.finite_element

    def body(
        shaped: Callable[[], BlockMesh],
        shape: Hashable,
        material: Material,
        support: Support,
        coating: Coating | None = None,
    ) -> ElasticBody:
        """Factored."""

        def make() -> ElasticBody:
            with stages.stage("mesh", "finite elements: mesh"):
                mesh = shaped()
            with stages.stage("assembly", "finite elements: assembly"):
                made = elastic_body(mesh, material, support, degree=degree, coating=coating)
            with stages.stage("factorisation", "finite elements: factorisation"):
                _ = made.factor
            return made

        degree, linear = settings.degree, replace(material, law=Law())
        known = body_cache.body(shape, make, linear, support, degree, coating)
        return known if known.material == material else known.with_law(material.law)

    spec = block_spec(problem, refinement, patches)
    beyond = 0.5 if refinement.half_block else np.inf
    support = rough_support(problem, spec, beyond)
    with stages.stage("mesh", "finite elements: mesh"):
        flat = body_cache.mesh(spec)
    shape = (_key(spec), rough_key(problem)) if problem.rough_boundary else _key(spec)
    coating = scene.coating and Coating(scene.coating.material, scene.coating.thickness)
    shaped = partial(rough_mesh, problem, flat)
    rough = body(shaped, shape, scene.body.material, support, coating)
    if scene.roller.rigid:
        return BodyPair(rough, None, 0.0)
    if problem.shares_factor:
        share = scene.body.youngs_modulus / scene.roller.youngs_modulus
        return BodyPair(rough, None, share)
    wanted = roller_spec(problem, spec)
    with stages.stage("mesh", "finite elements: mesh of the roller"):
        flat = body_cache.mesh(wanted)
    # flat, it is that of a flat rough body, if they are alike
    shape = (_key(wanted), roller_key(problem)) if is_shaped(problem) else _key(wanted)
    aside = beyond if problem.period is None else np.inf
    within = aside * wanted.half_width, beyond * wanted.depth
    support = Support("bonded", _sides(problem), within)
    if is_disc(problem):
        support = disc_support(problem)
    roller = body(partial(roller_mesh, problem, flat), shape, scene.roller.material, support)
    return BodyPair(rough, roller, 0.0)


def rough_support(problem: Problem, spec: BlockSpec, beyond: float = np.inf) -> Support:
    """How the rough body is held; where it is unbounded, everywhere `beyond` this part of it."""
    scene = problem.scene
    within = (
        beyond * spec.half_width if problem.width is None else np.inf,
        beyond * spec.depth if scene.body.thickness is None else np.inf,
    )
    sides = "free" if scene.body.width is not None else _sides(problem)
    return Support(scene.body.base or "bonded", sides, within)


def _sides(problem: Problem) -> Sides:
    """Of a body without width of its own."""
    return UNBOUNDED_SIDES if problem.period is None else "tied"


def _key(spec: BlockSpec) -> Hashable:
    """The spec as something that can be looked up."""
    values = (getattr(spec, field.name) for field in fields(spec))
    return tuple(value.tobytes() if isinstance(value, np.ndarray) else value for value in values)


def _held(held: OrderedDict, key: Hashable, make: Callable[[], Result]) -> Result:
    """The result of a key, made where it is not there; the oldest beyond HELD is dropped."""
    if key in held:
        held.move_to_end(key)
        return held[key]
    while len(held) >= HELD:  # before the next is made: memory
        held.popitem(last=False)
    held[key] = make()
    return held[key]
