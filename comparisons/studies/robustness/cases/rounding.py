"""Perturbed arithmetic: how many digits of a result rounding of its input leaves.

Every number that a case is given is changed by up to 1e-15 of itself, at random, for several
seeds; or rounded to 32 bits. What a result then changes by, at most, says how many of its digits
mean anything:  digits = -log10(change), sixteen at most.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from analytic.contact.coupled import solve_coupled
from analytic.contact.equilibrium import Constraints
from analytic.contact.patches import contact_patches
from analytic.contact.problem import ContactSolution, solve_contact
from analytic.layers.layered import LayeredBody
from analytic.layers.operator import LayeredSurface
from analytic.material import Material
from analytic.operators.half_plane import HalfPlane
from analytic.operators.tangential import CoupledHalfPlane
from analytic.stress.points import stress_at
from comparisons.studies.robustness.cases.rough import rough
from comparisons.studies.robustness.row import Case, Figure, Findings, Model

PERTURBATION, SEEDS = 1e-15, 5
MOST_DIGITS = 16.0
COUNT, PITCH = 301, 0.01
LOAD = 1.007 * np.pi / 4.0 / 50.0  # no edge of contact on a node
DEPTHS = np.linspace(0.1, 1.0, 10)

Change = Callable[[np.ndarray | float], np.ndarray]


@dataclass(frozen=True)
class Digits:
    """Digits that results must keep, under perturbation and under 32-bit input."""

    perturbed: float
    single: float


def exact_input(value: np.ndarray | float) -> np.ndarray:
    return np.asarray(value, dtype=float)


def perturbed(seed: int) -> Change:
    """Changes numbers by up to PERTURBATION of themselves."""
    rng = np.random.default_rng(seed)

    def change(value: np.ndarray | float) -> np.ndarray:
        value = np.asarray(value, dtype=float)
        return value * (1.0 + PERTURBATION * rng.uniform(-1.0, 1.0, value.shape))

    return change


def single(value: np.ndarray | float) -> np.ndarray:
    """Rounded to 32 bits."""
    return np.asarray(value, dtype=np.float32).astype(float)


def digits_findings(results: Callable[[Change], dict[str, np.ndarray]], kept: Digits) -> Findings:
    """Digits of each result, by its change over its largest amount."""
    reference = results(exact_input)
    changed = dict.fromkeys(reference, 0.0)
    for seed in range(SEEDS):
        for name, value in results(perturbed(seed)).items():
            changed[name] = max(changed[name], _change(value, reference[name]))
    rounded = {name: _change(value, reference[name]) for name, value in results(single).items()}
    digits = {name: _digits(change) for name, change in changed.items()}
    digits |= {f"{name}, 32-bit input": _digits(change) for name, change in rounded.items()}
    figures = tuple(
        Figure(
            f"digits of {name}",
            value,
            MOST_DIGITS,
            "the exact input's result",
            least=kept.single if "32-bit" in name else kept.perturbed,
        )
        for name, value in sorted(digits.items(), key=lambda item: item[1])
    )
    return Findings(figures, digits=digits)


def _change(value: np.ndarray, reference: np.ndarray) -> float:
    return float(np.max(np.abs(value - reference)) / np.max(np.abs(reference)))


def _digits(change: float) -> float:
    if not np.isfinite(change):
        return 0.0
    return MOST_DIGITS if change == 0.0 else float(min(MOST_DIGITS, max(0.0, -np.log10(change))))


def results_of(solution: ContactSolution, x: np.ndarray) -> dict[str, np.ndarray]:
    """Pressure, approach, contact length and the largest shear below of a solution."""
    patches = contact_patches(x, solution.pressure, solution.gap)
    stress = stress_at(x, solution.pressure, 0.0, 0.5 * (patches[0, 0] + patches[0, 1]), DEPTHS)
    return {
        "pressure": solution.pressure,
        "approach": np.array(solution.approach),
        "contact length": np.array(np.ptp(patches, axis=1).sum()),
        "tau1": stress.tau1,
    }


def hertz_results(make: Callable[[float], HalfPlane], change: Change) -> dict[str, np.ndarray]:
    """A cylinder on the operator that `make` gives of a changed modulus."""
    x = PITCH * (np.arange(COUNT) - COUNT // 2)
    weights = np.full(COUNT, PITCH)
    operator = make(float(change(1.0)))
    gap = change(x**2 / 2.0 / 50.0 * PITCH)
    load = Constraints(load=float(change(LOAD)))
    solve = solve_coupled if isinstance(operator, CoupledHalfPlane) else solve_contact
    return results_of(solve(operator, gap, weights, load), x)


def rough_results(change: Change) -> dict[str, np.ndarray]:
    """A rough line."""
    count = 1024
    height = change(rough(count))
    weights = np.ones(count)
    operator = HalfPlane(count, 1.0, float(change(1.0)))
    load = Constraints(load=float(change(1.0)))
    return results_of(
        solve_contact(operator, -height, weights, load), np.arange(count, dtype=float)
    )


def finite_results(
    poissons_ratio: float, stiffness: float, change: Change
) -> dict[str, np.ndarray]:
    """Finite elements whose mesh is perturbed point by point; a coating of `stiffness`."""
    from comparisons.studies.robustness.finite_element.algebra import BONDED
    from comparisons.studies.robustness.finite_element.bodies import (
        compliance_of,
        flat_mesh,
        press_finite,
    )
    from comparisons.studies.robustness.finite_element.extremes import GRID
    from fem.body.coating import Coating
    from fem.body.elasticity import elastic_body

    flat = flat_mesh(40.0, 40.0, 1.5, 0.1, 0.3, 0.2)
    moved = flat.points.copy()
    corners = np.unique(flat.triangles[:, :3])
    inner = corners[(moved[corners, 1] > 0.0) & (moved[corners, 1] < 40.0)]
    inner = inner[(np.abs(moved[inner, 0]) < 40.0) & (moved[inner, 1] != 0.2)]
    moved[inner] = change(moved[inner])
    edges = flat.triangles[:, [[0, 1, 3], [1, 2, 4], [2, 0, 5]]].reshape(-1, 3)
    moved[edges[:, 2]] = 0.5 * (moved[edges[:, 0]] + moved[edges[:, 1]])
    mesh = replace(flat, points=moved)
    material = Material(0.91 * float(change(1.0)), poissons_ratio)
    coating = None if stiffness == 1.0 else Coating(Material(stiffness, 0.3), 0.2)
    compliance = compliance_of(elastic_body(mesh, material, BONDED, coating=coating), GRID)
    gap = change(GRID.hat_integrals(lambda x: x**2 / 100.0))
    model = HalfPlane(GRID.count, GRID.pitch, 1.0)
    load = Constraints(load=float(change(np.pi / 4.0 / 50.0 * max(1.0, stiffness))))
    solution = press_finite(compliance, model, GRID, gap, load).solution
    return {
        "pressure": solution.pressure,
        "approach": np.array(solution.approach),
        "displacement": compliance.apply(np.ones(GRID.count)),
    }


def cases() -> tuple[Case, ...]:
    """The cases of this module."""
    elastomer, steel = 0.5 - 1e-9, Material(1.0, 0.3)

    def layered(body: Callable[[float], LayeredBody]) -> Callable[[float], LayeredSurface]:
        return lambda modulus: LayeredSurface(COUNT, PITCH, body(modulus))

    makers = {
        "smooth": (lambda modulus: HalfPlane(COUNT, PITCH, modulus), Digits(11.0, 4.0)),
        "sliding, mu beta = 0.5": (
            lambda modulus: CoupledHalfPlane(COUNT, PITCH, modulus, 0.5),
            Digits(11.0, 4.0),
        ),
        "thin incompressible layer": (
            layered(
                lambda modulus: LayeredBody(Material(1e-2 * modulus, elastomer), 0.05, "bonded")
            ),
            Digits(12.0, 6.0),
        ),
        "coating 1e6 times as stiff": (
            layered(lambda modulus: LayeredBody(Material(1e6 * modulus, 0.3), 0.01, steel)),
            Digits(7.5, 2.0),
        ),
    }
    # Material's own numbers are as exact as its type allows: 1 - 2 nu is not perturbed.
    half: list[tuple[str, Model, Callable, Digits]] = [
        (name, "half_plane", partial(hertz_results, make), kept)
        for name, (make, kept) in makers.items()
    ]
    half.append(("rough", "half_plane", rough_results, Digits(11.0, 3.0)))
    finite: list[tuple[str, Model, Callable, Digits]] = [
        ("smooth", "finite_element", partial(finite_results, 0.3, 1.0), Digits(11.0, 5.5)),
        ("nu = 0.4999", "finite_element", partial(finite_results, 0.4999, 1.0), Digits(8.5, 5.5)),
        (
            "coating 1e6 times as stiff",
            "finite_element",
            partial(finite_results, 0.3, 1e6),
            Digits(5.0, 5.0),
        ),
    ]
    return tuple(
        Case("rounding", name, model, partial(digits_findings, results, kept))
        for name, model, results, kept in (*half, *finite)
    )
