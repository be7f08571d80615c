"""The elastic roller: its mesh, and what holds it.

A half-plane, a block that ends far away; or a disc (`finite_element.roller_body`), held by what
`roller.support` says. Where nothing is said, the disc is a sector, free on its rays and held on its
inner arc. A disc's support is its own: no far boundary that stands for an unbounded body."""

from collections.abc import Callable, Hashable
from dataclasses import replace

import numpy as np

from comparisons.common.errors import SceneError
from comparisons.models.problem import Problem
from fem.body.support import Support
from fem.contact.rigid_roller import Roller, circle, parabola
from meshes.block import BlockMesh, BlockSpec
from meshes.disc import disc, half_disc_size, opposite_size, ring, ring_size
from meshes.real_shape import bent, roughen

# The slope of a roller on a block fades over this multiple of the extent of pressures.
LEVELS_OFF = 2.0
SECTOR = 0.7, 0.6  # of the radius: half-width and depth of the sector where no support is given
# Of the radius: pressures reach no farther on a disc that is held as the scene says.
FARTHEST = 0.6


def roller_key(problem: Problem) -> tuple[Hashable, ...]:
    """Key of what shapes a roller's boundary, beside its flat mesh; empty where it stays flat."""
    scene, settings = problem.scene, problem.scene.finite_element
    if not is_shaped(problem):
        return ()
    shape = settings.roller_shape, settings.roller_body, scene.roller.support
    return scene.roller.radius, *shape, problem.extent


def roller_of(problem: Problem) -> Roller:
    """The shape of the finite elements' roller."""
    scene = problem.scene
    shape = circle if scene.finite_element.roller_shape == "circle" else parabola
    return shape(scene.roller.radius)


def is_disc(problem: Problem) -> bool:
    """Whether the roller is an elastic body of finite size."""
    scene = problem.scene
    return scene.finite_element.roller_body == "disc" and not scene.roller.rigid


def roller_spec(problem: Problem, spec: BlockSpec) -> BlockSpec:
    """The mesh of an elastic roller, refined as the body's `spec` is: a block, or the flat of a
    disc. Raises SceneError for a disc that the pressures reach beyond."""
    if is_disc(problem):
        half_width, depth, farthest = _disc_size(problem)
        reached = np.abs(problem.extent).max()
        if reached > farthest:
            raise SceneError(f"{problem.scene.source}: {_beyond_disc(problem, reached, farthest)}")
    else:
        width, depth = problem.unbounded
        half_width = 0.5 * width
        if (spec.half_width, spec.depth, spec.interface) == (half_width, depth, None):
            return spec  # one mesh serves both
    return replace(spec, half_width=half_width, depth=depth, window=None, interface=None)


def _beyond_disc(problem: Problem, reached: float, farthest: float) -> str:
    """Why a disc does not bear pressures that reach so far [m], by what the scene's file has."""
    written, load = problem.scene.written, problem.scene.load
    asked = written.get("finite_element", {}).get("roller_body") == "disc"
    field = "finite_element.roller_body" if asked else f"load.{load.kind}"
    remedy = "budget.effects = false, without the disc"
    if asked:
        remedy = 'finite_element.roller_body = "half-plane" with budget.effects = false'
    return (
        f"{field}: pressures may reach to {reached:.3g} m from the middle, "
        f"{reached / problem.hertz.half_width:.3g} Hertz half-widths; a disc bears them up to "
        f"{farthest:.3g} m, {farthest / problem.scene.roller.radius:.3g} of roller.radius; allowed "
        f"is a lighter load, a larger radius or {remedy}"
    )


def _disc_size(problem: Problem) -> tuple[float, float, float]:
    """Half-width and depth of the flat of a disc, and how far pressures may reach on it [m]."""
    roller = problem.scene.roller
    radius = roller.radius
    if roller.support is None:
        half_width, depth = (share * radius for share in SECTOR)
        return half_width, depth, half_width
    if roller.hub is not None:
        return *ring_size(radius, roller.hub), FARTHEST * radius
    size = {"half disc": half_disc_size, "opposite": opposite_size}[roller.support](radius)
    return size, size, FARTHEST * radius


def roller_mesh(problem: Problem, flat: BlockMesh) -> BlockMesh:
    """The roller's mesh from the flat one: that of a disc; at finite deformation a block with the
    roller's shape on it, which levels off beside the extent."""
    roller = problem.scene.roller
    if is_disc(problem):
        shaped = bent if roller.support is None else ring if roller.hub else disc
        return shaped(flat, roller.radius)
    if not is_shaped(problem):
        return flat
    return roughen(flat, levelled(roller_of(problem), np.abs(problem.extent).max()))


def is_shaped(problem: Problem) -> bool:
    """Whether the roller's mesh is another one than that of its flat."""
    return is_disc(problem) or problem.scene.finite_element.deformation != "linear"


def disc_support(problem: Problem) -> Support:
    """Support of the flat of a disc."""
    roller = problem.scene.roller
    if roller.support is None:
        return Support("bonded", "free")
    # a ring's sides meet in one line, which stays where it is by symmetry
    return Support("bonded", "rollers" if roller.hub else "fixed")


def levelled(roller: Roller, reach: float) -> Callable[[np.ndarray], np.ndarray]:
    """Heights [m] of a roller on a half-plane, zero at its lowest point: its shape to `reach` [m]
    on either side, beyond which its slope fades over LEVELS_OFF as much."""
    length = LEVELS_OFF * reach
    edge, slope, _ = roller(np.array([reach]))

    def height(x: np.ndarray) -> np.ndarray:
        inside = np.clip(x, -reach, reach)
        beyond = np.minimum((np.abs(x) - np.abs(inside)) / length, 1.0)
        # the integral of (1 - t)^2 (1 + 2 t)
        faded = slope * length * beyond * (1.0 - beyond**2 + 0.5 * beyond**3)
        return -(np.where(beyond > 0.0, edge, roller(inside)[0]) + faded)

    return height
