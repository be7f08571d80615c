"""Problem of both models: the same mesh whatever the last bits of a computed surface. The points
of the fields: what is asked for, and what must not depend on it."""

from dataclasses import replace

import numpy as np
import pytest
from scenes import STEEL, half_plane_at, problem, resolved
from scipy.signal import find_peaks

from analytic.contact.patches import contact_patches
from analytic.contact.problem import solve_contact
from analytic.operators.half_plane import HalfPlane
from analytic.profile import Profile
from comparisons.common.errors import SceneError
from comparisons.models.finite_element.mesh import Refinement, block_spec
from comparisons.models.posing import problem_of, standing_out
from comparisons.models.window import field_ends, search_window, window_of
from comparisons.scenes.fields import Extent
from comparisons.scenes.files import SCENES, read_toml
from comparisons.scenes.scene import Origin, Scene
from comparisons.scenes.surface import SceneSurface, surface_of
from meshes.build import in_units


def mesh_in_edges(scene: Scene, surface: SceneSurface) -> tuple:
    """Everything that the coarsest mesh is made from, with lengths in surface edges."""
    problem = problem_of(scene, surface)
    refinement = Refinement(problem.pitches[0])
    grid = problem.grid(refinement.pitch)
    solution = solve_contact(
        HalfPlane(grid.count, grid.pitch, problem.modulus),
        grid.hat_integrals(problem.gap, problem.knots),
        grid.weights,
        problem.constraints(),
    )
    spec = block_spec(problem, refinement, contact_patches(grid.x, solution.pressure, solution.gap))
    small = in_units(spec, spec.surface_size)
    return small.half_width, small.depth, small.growth, small.window, small.intervals


@pytest.mark.parametrize("thickness", [None, 1e-3])
@pytest.mark.parametrize("load", [1.0, 0.1])
@pytest.mark.parametrize("name", ["self-affine", "ground-unrun"])
def test_rounding_of_the_surface_does_not_change_the_mesh(name, load, thickness):
    scene = Scene.read(name)
    surface, weight = surface_of(scene), f"load.{scene.load.kind}"
    scene = scene.unchecked({weight: load * scene.load.value, "body.thickness": thickness})
    first = mesh_in_edges(scene, surface)
    noise = np.random.default_rng(1)
    for _ in range(3):
        rounding = 1.0 + 1e-14 * noise.standard_normal(len(surface.profile.height))
        profile = Profile(surface.profile.x, surface.profile.height * rounding)
        assert mesh_in_edges(scene, replace(surface, profile=profile)) == first


def test_pitches_halve_and_the_finest_is_a_fortieth_of_the_shortest_wave():
    """A sinusoid's own spectrum finds its wave a little short: the trace is of finite length."""
    pitches = np.array(problem_of(Scene.read("sinusoid")).pitches)
    assert pitches[:-1] / pitches[1:] == pytest.approx(2.0, rel=1e-15)
    assert 40.0 <= 50e-6 / pitches[-1] <= 44.0


def test_asperities_end_between_peaks_of_pressure():
    """Those of a wave end in its troughs; a smooth body is one, waves too low are none."""
    wave = {"kind": "sinusoid", "wavelength": 60e-6, "amplitude": 0.5e-6}
    rough = {"roller": {"radius": 8e-3, **STEEL}, "body": STEEL, "load": {"per_length": 1e6}}
    posed = problem(rough | {"profile": wave})
    ends = np.array(posed.asperities)
    assert len(ends) >= 4
    np.testing.assert_allclose((ends / 60e-6) % 1.0, 0.5, atol=0.05)  # crests stand at whole waves
    assert problem(rough).asperities == ()
    assert problem(rough | {"profile": wave | {"amplitude": 1e-9}}).asperities == ()


def test_what_stands_out_are_peaks_of_that_prominence():
    noise = np.random.default_rng(7)
    for count in (30, 300, 3000):
        values = np.pad(np.maximum(np.cumsum(noise.standard_normal(count)), 0.0), 1)
        for share in (0.02, 0.25):
            least = share * values.max()
            known, _ = find_peaks(values, prominence=least)
            assert standing_out(values, least) == list(known)


def posed_problem(name="ground-unrun", **stress):
    tables = read_toml(SCENES / f"{name}.toml")
    tables["stress"] = {**tables["stress"], **stress}
    return problem_of(Scene.of(tables, Origin(name, SCENES, name)))


@pytest.mark.parametrize("name", ["ground-unrun", "ground-run-in"])
def test_extremes_do_not_depend_on_the_points_of_the_field(name):
    extremes = []
    for points in ([3, 3], [40, 16], [600, 200]):
        posed = posed_problem(name, points=points)
        level = half_plane_at(posed, fields=True)
        extremes.append([e.value for e in level.stress.extremes.values()])
    assert extremes[:2] == [pytest.approx(extremes[2], rel=1e-9)] * 2


def test_a_trace_that_is_nothing_beside_the_window_is_refused_before_it_is_searched(tmp_path):
    """Nanometres high and picometres long: its waves ask for more points than there is memory."""
    height = np.cumsum(np.random.default_rng(1).standard_normal(256))
    np.savetxt(tmp_path / "trace.csv", np.column_stack([0.08 * np.arange(256), height]))
    tables = {
        "roller": {"radius": 1e-5, **STEEL},
        "body": STEEL,
        "profile": {"file": "trace.csv", "x_unit": "pm", "z_unit": "nm"},
        "load": {"hertz_peak_pressure": 1e9},
    }
    scene = resolved(tables | {"stress": {}}, folder=tmp_path)
    with pytest.raises(SceneError, match=r"stress.half_range: is 2.6e-07 m; .*: check x_unit and"):
        problem_of(scene)


@pytest.mark.parametrize("columns", [3, 10, 77, 600, 2500])
def test_points_belong_to_the_grid_of_every_level(columns):
    posed = posed_problem(points=[columns, 20])
    window = window_of(posed)
    assert len(window.x) == pytest.approx(columns, rel=0.5)
    assert len(window.z) == 20 and window.z[0] == 0.0
    spacing = np.diff(window.x).mean()
    for pitch in posed.pitches:
        ratio = window.stride(pitch) / window.subdivisions(pitch)
        assert ratio * pitch == pytest.approx(spacing, rel=1e-9)
        assert min(window.stride(pitch), window.subdivisions(pitch)) == 1


def test_the_search_is_as_dense_as_the_coarsest_pressures():
    posed = posed_problem(points=[10, 10])
    searched = search_window(posed)
    assert np.diff(searched.x).max() == pytest.approx(posed.pitches[0])
    assert searched.z[1] < posed.pitches[0]
    assert (searched.z[3:] / searched.z[2:-1]).max() < 1.7


def test_a_shallow_window_of_many_rows():
    window = window_of(posed_problem(depth="1 nm", points=[50, 300]))
    assert len(window.z) == 300 and window.z[-1] == pytest.approx(1e-9)


@pytest.mark.parametrize(
    ("asked", "extent", "ends"),
    [
        (None, (-1.6, 1.6), (-1.5, 1.5)),
        (None, (4.8, 5.2), (3.5, 6.5)),
        (None, (-3.0, 2.0), (-3.0, 2.0)),
        (0.5, (-1.6, 1.6), (-0.5, 0.5)),
        (0.5, (0.3, 1.6), (-0.5, 0.5)),
        (0.5, (4.8, 5.2), (4.5, 5.5)),
        (0.5, (4.0, 6.0), (4.0, 6.0)),
    ],
)
def test_a_field_stands_about_contact_that_it_would_not_show(asked, extent, ends):
    """All in half-widths; an extent has a margin of 0.15 beside the contact."""
    half_range = None if asked is None else Extent(asked, in_half_widths=True)
    posed = posed_problem()
    a, scene = posed.hertz.half_width, posed.scene.unchecked({"stress.half_range": half_range})
    moved = replace(posed, scene=scene, extent=(extent[0] * a, extent[1] * a))
    assert np.array(field_ends(moved)) / a == pytest.approx(np.array(ends))
