"""Stresses of the rough body on finite elements: on the window, and at the mesh's points."""

import numpy as np

from analytic.gap import HatGrid
from analytic.plane_stress import PlaneStress
from comparisons.finite_element_contact import roller_normal
from comparisons.level import StressResult, Window
from comparisons.problem import Problem
from fem.compliance import FiniteElementCompliance
from fem.elasticity import ElasticBody
from fem.maximum import maximum
from fem.stress import NodalStress, evaluate, nodal_stress
from fem.surface import straight_down


def stresses_of(
    problem: Problem,
    compliance: FiniteElementCompliance,
    grid: HatGrid,
    pressure: np.ndarray,
    friction: float,
    window: Window,
) -> tuple[StressResult, PlaneStress]:
    """Stresses of linear elasticity under one friction coefficient."""
    body = compliance.body
    displaced = problem.scene.finite_element.gap == "displaced"
    nodal = nodal_stress(
        body,
        compliance.displacement(pressure, friction),
        compliance.hats,
        pressure,
        friction,
        roller_normal(problem) if displaced else straight_down,
    )
    stress = PlaneStress(nodal.stress.sx, nodal.stress.sz, nodal.stress.txz)
    return on_window(problem, body, nodal, friction, window), stress


def on_window(
    problem: Problem, body: ElasticBody, nodal: NodalStress, friction: float, window: Window
) -> StressResult:
    """Extremes and the field on the window from stresses at the mesh's points."""
    bounds = (-window.reach, window.reach, window.z[-1])
    quantities = {
        "tau1": lambda stress: stress.tau1,
        "txz": lambda stress: np.abs(stress.txz),
        "von_mises": lambda stress: stress.von_mises(stress.poissons_ratio),
    }
    extremes = {
        name: maximum(body, nodal, quantity, bounds) for name, quantity in quantities.items()
    }
    x, z = np.meshgrid(window.x, window.z)
    return StressResult(friction, extremes, evaluate(body, nodal, x, z))
