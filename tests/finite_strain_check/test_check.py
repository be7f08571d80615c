"""The independent finite-strain solutions: right by themselves, and what holds figures to them."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from scenes import finite_elements, problem, run_of

import comparisons as crosscheck
from comparisons.api import scene_of
from comparisons.models.level import Level
from comparisons.scenes.materials import solids
from tests.finite_strain_check import cases, check
from tests.finite_strain_check.contact import State, SurfacePair
from tests.finite_strain_check.figures import ContactFigures, figures
from tests.finite_strain_check.mesh import interpolated, refined, strip
from tests.finite_strain_check.solve import Task, solutions

STEEL = 210.0, 0.3  # GPa
WAVY = np.arange(-60.0, 61.0)  # um
HEIGHT = 0.15 * np.cos(2.0 * np.pi * WAVY / 10.0) + 0.05 * np.sin(WAVY / 3.0)


def smooth(curvature: float, law: str) -> Task:
    """A rigid cylinder of half-width 100 um on a body of modulus 1 GPa."""
    flat, radius = np.linspace(-4000.0, 4000.0, 101), 100.0 / curvature
    peak = 0.5 * curvature / (1.0 - 0.3**2)
    return Task(flat, 0.0 * flat, (1.0, 0.3), None, radius, 50.0 * np.pi * peak, 0.0, law)


def by_the_project(edges: int, **tables: dict):
    """The scene of a rigid circular roller, of 2 mm unless another is given, by the project's own
    elements, so many to Hertz's half-width: posed, and solved with its stresses."""
    roller = {"radius": 2e-3, "rigid": True} | tables.pop("roller", {})
    finite = {"deformation": "finite", "roller_shape": "circle"}
    scene = problem({"roller": roller, "finite_element": finite, "stress": {}} | tables)
    return scene, finite_elements(scene, scene.hertz.half_width / edges, fields=True)


def on_a_flat(load: float, friction: float) -> ContactFigures:
    """A rigid roller of 2 mm on smooth steel, under a load [N/m]."""
    x = np.linspace(-500.0, 500.0, 101)
    return cases.solved(Task(x, 0.0 * x, STEEL, None, 2000.0, load / 1e3, friction), (4.0, 2.0))[-1]


def are_alike(level: Level, other: ContactFigures, **near: float) -> None:
    """Figures of the project's own elements, and of these, by how near they are, relatively."""
    own = {name: abs(largest.value) for name, largest in level.stress.extremes.items()}
    own |= {"peak": level.solution.pressure.max(), "deformed_length": level.contact_length}
    for name, most in near.items():
        unit = 1e-6 if name == "deformed_length" else 1e9
        assert own[name] == pytest.approx(unit * getattr(other, name), rel=most), name


@cache
def finest(law: str) -> tuple[SurfacePair, State]:
    *_, last = solutions(smooth(0.05, law), (8.0, 4.0), 200.0)
    return last


def test_small_strains_meet_hertz():
    task, (pair, state) = smooth(0.05, "linear"), finest("linear")
    result, peak = figures(pair, state), 2.0 * task.load / (100.0 * np.pi)
    assert result.peak == pytest.approx(peak, rel=3e-4)
    assert result.length == pytest.approx(200.0, rel=3e-3)
    assert result.tau1 == pytest.approx(0.30028 * peak, rel=5e-3)
    assert result.tau1_depth == pytest.approx(78.6, rel=0.1)
    exact = peak * np.sqrt(np.maximum(1.0 - (pair.x / 100.0) ** 2, 0.0))
    assert np.abs(state.pressure - exact)[np.abs(pair.x) < 80.0].max() < 2e-3 * peak


def test_finite_strain_is_that_of_the_projects_own_elements():
    """Which gave 0.36 % at a/R = 0.05 with 80 edges to a half-width."""
    peaks = [figures(*finest(law)).peak for law in ("linear", "neo-hookean", "st-venant")]
    assert peaks[1] / peaks[0] - 1.0 == pytest.approx(0.0036, abs=1e-4)
    assert peaks[2] / peaks[0] - 1.0 == pytest.approx(-0.0208, abs=5e-4)


@pytest.mark.parametrize(
    ("roller", "radius"), [(None, 2000.0), (STEEL, 2000.0), (STEEL, 500.0)], ids=str
)
def test_forces_and_tangent_with_friction(roller, radius):
    task = Task(WAVY, HEIGHT, STEEL, roller, radius, 48.0, 0.2)
    assert task.is_disc == (radius < 1000.0)
    [(pair, state)] = solutions(task, (2.0,), 45.0)
    residual, matrix = pair.assembled(state)
    assert np.abs(residual).max() < 1e-6 * task.load
    counts = [solid.count for solid in pair.solids]
    direction = np.random.default_rng(1).standard_normal(len(residual))

    def residual_at(step: float) -> np.ndarray:
        moved, start = [u.copy() for u in state.moved], 0
        for solid, u in zip(pair.solids, moved, strict=True):
            u[~solid.held] += step * direction[start : start + solid.count].reshape(-1, 2)
            start += solid.count
        pressure = state.pressure.copy()
        pressure[state.active] += step * direction[start:-2]
        shifts = {"approach": state.approach, "shift": state.shift}
        shifts = {n: v + step * d for (n, v), d in zip(shifts.items(), direction[-2:], strict=True)}
        return pair.assembled(replace(state, moved=moved, pressure=pressure, **shifts))[0]

    step = 1e-6
    change = (residual_at(step) - residual_at(-step)) / (2.0 * step)
    expected = matrix @ direction
    # where integrals end moves with both surfaces' corners and is not in the tangent, nor are the
    # weights of the last row
    for part in np.split(np.arange(len(residual) - 2), np.cumsum(counts)):
        assert np.abs(change - expected)[part].max() < 5e-4 * np.abs(expected[part]).max()


def test_meshes_are_conforming_and_carry_quadratics_exactly():
    coarse = refined(strip(64.0, 2, 1), lambda at: 1.0 + 0.3 * np.hypot(*at.T))
    fine = refined(coarse, lambda at: 0.5 + 0.2 * np.hypot(*(at - [5.0, 0.0]).T))
    pairs, edge = fine.edges
    ends = fine.corners[pairs[np.bincount(edge.ravel()) == 1]]
    assert np.hypot(*(ends[:, 1] - ends[:, 0]).T).sum() == pytest.approx(6.0 * 64.0)

    def field(mesh):
        s, d = mesh.nodes.T
        return np.stack([s**2 - s * d, 3.0 * d**2 + s], axis=1)

    assert interpolated(coarse, fine, field(coarse)) == pytest.approx(field(fine), abs=1e-9)


def test_a_coated_body_is_that_of_the_projects_own_elements():
    """Under a rigid roller at a/R = 0.2, three times as stiff to a depth of 0.64 half-widths: the
    peak is 25 % above Hertz's, of which finite strain takes 1.4 %."""
    body, coating = (1.0, 0.3), (3.0, 0.2, 64.0)
    task = replace(smooth(0.2, "neo-hookean"), coating=coating)
    *_, last = solutions(task, (8.0, 4.0), 200.0)
    result, peak = figures(*last), 2.0 * task.load / (100.0 * np.pi)
    _, level = by_the_project(
        32,
        roller={"radius": 500e-6},
        body={"youngs_modulus": 1e9, "poissons_ratio": body[1]},
        coating={"thickness": 64e-6, "youngs_modulus": 3e9, "poissons_ratio": coating[1]},
        load={"hertz_peak_pressure": 1e9 * peak},
    )
    are_alike(level, result, peak=1e-3, deformed_length=5e-3, txz=4e-3)


@pytest.mark.parametrize("name", ["rail steel", "aluminium alloy", "fused silica"])
def test_measured_constants_are_those_of_the_projects_own_elements(name):
    """Under a rigid roller, where the law changes the peak by 1 to 3 %."""
    solid = solids()[name]
    load = {"hertz_peak_pressure": 0.018 * solid.material.youngs_modulus}
    wave = {"kind": "sinusoid", "wavelength": 40e-6, "amplitude": 0.05e-6, "length": 1e-3}
    scene, level = by_the_project(48, body={"material": name}, load=load, profile=wave)
    ell, m, _ = solid.law.murnaghan
    law = ell / solid.material.shear_modulus, m / solid.material.shear_modulus
    radius, load = 2000.0, scene.hertz.load_per_length / 1e3
    x = np.linspace(-500.0, 500.0, 4001)
    height = 0.05 * np.cos(2.0 * np.pi * x / 40.0)
    constants = solid.material.youngs_modulus / 1e9, solid.material.poissons_ratio
    task = Task(x, height, constants, None, radius, load, 0.0, law)
    # the length but for an element at each end
    near = {"peak": 2e-3, "deformed_length": 1.5e-2, "tau1": 6e-3}
    are_alike(level, cases.solved(task, (4.0, 2.0))[-1], **near)


def test_model_errors_under_friction_are_within_what_a_run_states():
    """A smooth rigid roller that slides at 0.3, where the largest shear is about to come up to the
    surface: peak, length and tau1."""
    tables = {
        "roller": {"radius": 2e-3, "rigid": True},
        "body": {"youngs_modulus": 210e9, "poissons_ratio": 0.3, "law": "neo-hookean"},
        "load": {"hertz_peak_pressure": 0.018 * 210e9, "friction": 0.3, "coupled": True},
        "finite_element": {"plastic": False},
        "stress": {"points": [60, 20]},
    }
    run = run_of(tables)
    result = on_a_flat(run.problem.hertz.load_per_length, 0.3)
    for quantity in ("peak_pressure", "contact_length", "tau1_max"):
        name, unit = cases.QUANTITIES[quantity]
        figures = run.figures.of(quantity=quantity, source="half_plane")
        half_plane, stated = (figures.one(study=name) for name in ("contact", "model_error"))
        error = half_plane.value / (getattr(result, name) * unit) - 1.0
        assert stated.value == pytest.approx(error, abs=stated.total)
        assert stated.total < 0.02


def test_strong_friction_is_those_of_the_projects_own_elements():
    """Friction of 0.5, which on tilted tangents bears 0.2 % of the load: peak, length and txz."""
    body = {"youngs_modulus": 210e9, "poissons_ratio": 0.3, "law": "neo-hookean"}
    hertz = {"hertz_peak_pressure": 0.018 * 210e9, "friction": 0.5}
    scene, level = by_the_project(48, body=body, load=hertz)
    load = scene.hertz.load_per_length
    assert level.solution.load == pytest.approx(load, rel=1e-6)
    are_alike(level, on_a_flat(load, 0.5), peak=3e-4, deformed_length=3e-3, txz=1e-3)


def test_a_capped_pressure_is_that_of_the_projects_own_elements():
    """At four fifths of Hertz's peak and friction 0.2: the contact is 5.5 % longer than Hertz's, of
    which finite strain takes 0.15 %."""
    curvature, share = 0.05, 0.8
    task = smooth(curvature, "neo-hookean")
    peak = 2.0 * task.load / (100.0 * np.pi)
    task = replace(task, friction=0.2, cap=share * peak)
    result = cases.solved(task, (4.0, 2.0))[-1]
    hertz = {"hertz_peak_pressure": 1e9 * peak, "friction": 0.2}
    body = {"youngs_modulus": 1e9, "poissons_ratio": 0.3, "law": "neo-hookean"}
    body["hardness"] = 1e9 * share * peak
    roller = {"radius": 100e-6 / curvature}
    _, level = by_the_project(48, roller=roller, body=body, load=hertz)
    assert level.solution.converged
    are_alike(level, result, deformed_length=1e-3, txz=1e-3, tau1=4e-3)


def test_small_strains_meet_the_half_plane_on_a_rough_body():
    """Pressure, shear and orthogonal shear to 0.2 %, the length to both grids."""
    scene = scene_of(cases.SCENES["unrun-rigid"])
    run = crosscheck.run(scene, models="half-plane")
    known = {f.quantity: f.value for f in run.figures.of(study="contact")}
    task = cases.task_of(scene, 0.0, "linear")
    result = cases.solved(task, (1.0, 0.125))[-1]
    assert 1e9 * result.peak == pytest.approx(known["peak_pressure"], rel=2e-3)
    assert 1e9 * result.tau1 == pytest.approx(known["tau1_max"], rel=2e-3)
    assert 1e9 * result.txz == pytest.approx(known["txz_max_abs"], rel=2e-3)
    assert 1e-6 * result.length == pytest.approx(known["contact_length"], rel=0.015)
    assert len(result.patches) == len(run.outcome.runs["half_plane"].finest.patches)


def test_every_scene_is_of_elastic_bodies():
    """The independent elements are elastic: a body that may flow has no error for elastic ones."""
    scenes = [scene_of(tables) for tables in cases.SCENES.values()]
    assert len(scenes) == 12 and all(scene.finite_element.plastic is False for scene in scenes)


def test_the_project_holds_a_small_rough_scene(capsys):
    assert check.main(["--scenes", "polished-rigid"]) == 0
    assert "all demands hold" in capsys.readouterr().out
