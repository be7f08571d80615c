"""How many digits of a result survive rounding of its input.

Every number of a case's input is changed by up to 1e-15 of itself, at random, for several seeds;
or rounded to 32 bits. The largest change of a result says how many of its digits mean anything:
digits = -log10(change), sixteen at most.
"""

from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np

from analytic.contact.equilibrium import Constraints
from analytic.layers.layered import Base, LayeredBody
from analytic.layers.operator import LayeredSurface
from analytic.material import Material
from analytic.operators.half_plane import HalfPlane, ModelOperator
from analytic.operators.tangential import CoupledHalfPlane
from analytic.stress.points import stress_at
from comparisons.studies.checks import BoundedFigure, Findings, Groups
from comparisons.studies.robustness.cases.rough import rough
from comparisons.studies.robustness.loaded_contact import LoadedContact, load_contact

PERTURBATION, SEEDS = 1e-15, 5
MOST_DIGITS = 16.0
COUNT, PITCH = 301, 0.01
LOAD = 1.007 * np.pi / 4.0 / 50.0  # no edge of contact on a node
DEPTHS = np.linspace(0.1, 1.0, 10)

Change = Callable[[np.ndarray | float], np.ndarray]
Results = dict[str, np.ndarray]


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


def digits_findings(
    results: Callable[[Change], Results], least: float, least_single: float
) -> Findings:
    """Digits of each result: at least `least` under perturbation, `least_single` in 32 bits."""
    reference = results(exact_input)
    changed = [_changes(results(perturbed(seed)), reference) for seed in range(SEEDS)]
    worst = {name: max(change[name] for change in changed) for name in reference}
    rounded = _changes(results(single), reference)
    found = [(name, _digits(change), least) for name, change in worst.items()]
    found += [
        (f"{name}, 32-bit input", _digits(change), least_single) for name, change in rounded.items()
    ]
    return Findings(
        tuple(
            BoundedFigure(f"digits of {name}", digits, MOST_DIGITS, "the exact input's result", low)
            for name, digits, low in sorted(found, key=lambda each: each[1])
        )
    )


def _changes(found: Results, reference: Results) -> dict[str, float]:
    """Largest change of each result, relative to its largest value."""
    return {
        name: float(np.max(np.abs(found[name] - value)) / np.max(np.abs(value)))
        for name, value in reference.items()
    }


def _digits(change: float) -> float:
    if not np.isfinite(change):
        return 0.0
    return MOST_DIGITS if change == 0.0 else float(min(MOST_DIGITS, max(0.0, -np.log10(change))))


def results_of(contact: LoadedContact) -> Results:
    """Pressure, approach, contact length and the largest shear below the first patch."""
    patches = contact.patches
    middle = 0.5 * (patches[0, 0] + patches[0, 1])
    return {
        "pressure": contact.pressure,
        "approach": np.array(contact.solution.approach),
        "contact length": np.array(contact.contact_length),
        "tau1": stress_at(contact.x, contact.pressure, 0.0, middle, DEPTHS).tau1,
    }


def hertz_results(make: Callable[[float], ModelOperator], change: Change) -> Results:
    """A cylinder on the operator that `make` returns for a changed modulus."""
    x = PITCH * (np.arange(COUNT) - COUNT // 2)
    operator = make(float(change(1.0)))
    gap = change(x**2 / 2.0 / 50.0 * PITCH)
    return results_of(load_contact(operator, x, gap, Constraints(load=float(change(LOAD)))))


def layered(
    stiffness: float, poissons_ratio: float, thickness: float, base: Base | Material, modulus: float
) -> LayeredSurface:
    """A surface layer, of a stiffness in units of `modulus`, on a base."""
    layer = Material(stiffness * modulus, poissons_ratio)
    return LayeredSurface(COUNT, PITCH, LayeredBody(layer, thickness, base))


def rough_results(change: Change) -> Results:
    height = change(rough(1024))
    operator = HalfPlane(1024, 1.0, float(change(1.0)))
    load = Constraints(load=float(change(1.0)))
    return results_of(load_contact(operator, np.arange(1024.0), -height, load))


def finite_element_results(poissons_ratio: float, stiffness: float, change: Change) -> Results:
    """Finite elements whose mesh is perturbed point by point; a coating of modulus `stiffness`."""
    from comparisons.studies.robustness.finite_element.loaded_body import (
        BONDED,
        GRID,
        compliance_of,
        flat_mesh,
        load_body,
    )
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
    material = Material(0.91 * float(change(1.0)), poissons_ratio)
    coating = None if stiffness == 1.0 else Coating(Material(stiffness, 0.3), 0.2)
    body = elastic_body(replace(flat, points=moved), material, BONDED, coating=coating)
    compliance = compliance_of(body)
    gap = change(GRID.hat_integrals(lambda x: x**2 / 100.0))
    load = float(change(np.pi / 4.0 / 50.0 * max(1.0, stiffness)))
    solution = load_body(compliance, gap, load, modulus=1.0)
    return {
        "pressure": solution.pressure,
        "approach": np.array(solution.approach),
        "displacement": compliance.apply(np.ones(GRID.count)),
    }


def cases() -> Groups:
    # The layer's own numbers are as exact as its type allows: 1 - 2 nu is not perturbed.
    soft = partial(layered, 1e-2, 0.5 - 1e-9, 0.05, "bonded")
    hard = partial(layered, 1e6, 0.3, 0.01, Material(1.0, 0.3))
    sliding = partial(CoupledHalfPlane, COUNT, PITCH, friction_dundurs=0.5)
    given = {
        "smooth": (partial(hertz_results, partial(HalfPlane, COUNT, PITCH)), 11.0, 4.0),
        "sliding, mu beta = 0.5": (partial(hertz_results, sliding), 11.0, 4.0),
        "thin incompressible layer": (partial(hertz_results, soft), 12.0, 6.0),
        "coating 1e6 times as stiff": (partial(hertz_results, hard), 7.5, 2.0),
        "rough": (rough_results, 11.0, 3.0),
    }
    return {"rounding": {name: partial(digits_findings, *each) for name, each in given.items()}}


def finite_element_cases() -> Groups:
    given = {
        "smooth": (partial(finite_element_results, 0.3, 1.0), 11.0, 5.5),
        "nu = 0.4999": (partial(finite_element_results, 0.4999, 1.0), 8.5, 5.5),
        "coating 1e6 times as stiff": (partial(finite_element_results, 0.3, 1e6), 5.0, 5.0),
    }
    return {"rounding": {name: partial(digits_findings, *each) for name, each in given.items()}}
