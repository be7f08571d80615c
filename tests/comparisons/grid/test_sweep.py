"""One scene at many values of its fields: from Python, by the command, scattered, refused."""

import csv
import io
import json

import numpy as np
import pytest
from rich.console import Console
from scenes import RIGID_PAIR, STEADY, STEEL, STEEL_PAIR, as_toml, changed

import comparisons as crosscheck
from comparisons.api import scene_of
from comparisons.cli import main
from comparisons.common.errors import InputError, SolverError
from comparisons.drawing import style
from comparisons.grid.sweep import MARGIN, Sweep, sweep_request
from comparisons.grid.sweep_picture import sweep_figure, zone_map_figure
from comparisons.grid.table import scatter, warnings_of
from comparisons.models.posing import problem_of

WAVES = RIGID_PAIR | {
    "profile": {"kind": "self-affine", "length": "1.2 mm", "samples": 600, "hurst": 0.8,
                "rms_height": "0.1 um", "seed": 3},
    "load": {"hertz_peak_pressure": "1 GPa", "friction": [0.0]},
    "resolution": {"levels": 2},
}  # fmt: skip
SINUSOID = {"kind": "sinusoid", "wavelength": "40 um"}


def request(over):
    return sweep_request([scene_of(WAVES)], over, ("half_plane",))


def values_of(swept, study, quantity):
    return [
        r["value"] for r in swept.figures.rows if (r["study"], r["quantity"]) == (study, quantity)
    ]


def test_placements_keep_the_contact_on_the_trace():
    asked = request(["position=5"])
    [values] = [axis["values"] for axis in asked.content["over"]]
    problem = problem_of(scene_of(WAVES))
    reach, surface = problem.extent, problem.surface
    start, end = surface.position + surface.profile.x[[0, -1]]
    assert values[0] + MARGIN * reach[0] == pytest.approx(start)
    assert values[-1] + MARGIN * reach[1] == pytest.approx(end)
    assert np.ptp(np.diff(values)) < 1e-12


@pytest.mark.parametrize("over", ["profile.seed=1,2", "profile.seed=1:2:2"])
def test_whole_numbers_stay_whole(over):
    asked = request([over])
    assert [point.scene.profile.seed for point in asked.points] == [1, 2]
    assert [type(seed) for seed in asked.content["over"][0]["values"]] == [int, int]


def test_another_kind_of_load_takes_the_place_of_the_scenes_own():
    asked = request(["load.per_length=1e5,2e5"])
    loads = [(point.scene.load.kind, point.scene.load.value) for point in asked.points]
    assert loads == [("per_length", 1e5), ("per_length", 2e5)]
    with pytest.raises(InputError, match="is given beside"):  # not which of two is meant
        request(["load.per_length=1e5,2e5", "load.hertz_peak_pressure=1e9,2e9"])


def test_each_point_is_the_scene_with_its_values():
    swept = crosscheck.sweep(WAVES, ["position=2", "load=0.5 GPa,1 GPa"], workers=1)
    assert len(swept.content["points"]) == 4
    place, load = swept.content["points"][1]["values"]
    alone = WAVES | {"load": {"hertz_peak_pressure": load, "position": place, "friction": [0.0]}}
    there = crosscheck.run(alone, "half-plane").figures.rows
    rows = [r for r in swept.figures.rows if (r["load.position"], r["load.hertz_peak_pressure"])
            == (place, load)]  # fmt: skip
    assert [row["value"] for row in rows] == [row["value"] for row in there]
    assert "4 scenes (2 of load.position x 2 of load.hertz_peak_pressure), 0 failed" in repr(swept)


def test_the_scatter_is_that_of_the_values():
    swept = crosscheck.sweep(WAVES, "friction=0:0.2:2", workers=1)
    assert [row["friction"] for row in swept.content["scatter"]] == [None] * 2
    values = np.array([1.0, 2.0, 6.0])
    named = {"study": "contact", "quantity": "peak_pressure", "source": "half_plane"}
    rows = [[named | {"against": None, "friction": 0.0, "value": v}] for v in values]
    [one] = scatter([{"rows": part} for part in rows], over_friction=False)
    assert (one["count"], one["mean"], one["smallest"], one["largest"]) == (3, 3.0, 1.0, 6.0)
    assert one["standard_deviation"] == pytest.approx(np.sqrt((4.0 + 1.0 + 9.0) / 2.0))


def test_pressure_follows_the_root_of_the_load():
    """Hertz's law along a sweep of the load, both ends with their units."""
    smooth = STEEL_PAIR | {"load": {"per_length": 1e6}}
    swept = crosscheck.sweep(smooth, "load=0.5 kN/mm:2 kN/mm:4", workers=1)
    peaks = values_of(swept, "contact", "peak_pressure")
    steps = 0.5 * np.diff(np.log([0.5, 1, 1.5, 2]))
    assert np.diff(np.log(peaks)) == pytest.approx(steps, abs=1e-4)


def printed(content) -> list[list[str]]:
    """Lines of the table of a sweep, in words."""
    text = io.StringIO()
    Console(file=text, width=120).print(Sweep(content, None).tables())
    return [line.split() for line in text.getvalue().splitlines()]


def test_a_trace_in_another_unit_is_seen_in_the_table_and_told(tmp_path, monkeypatch, capsys):
    """Its peak pressure is none; what every point has is told once, what some have with their
    values."""
    x = np.arange(1200.0)
    for name, amplitude in (("a", 0.05), ("b", 0.06), ("c", 20.0)):
        np.savetxt(tmp_path / f"{name}.csv", np.c_[x, amplitude * np.cos(2.0 * np.pi * x / 40.0)])
    tables = WAVES | {"profile": {"file": "a.csv", "x_unit": "um", "z_unit": "um"}}
    monkeypatch.chdir(tmp_path)
    swept = crosscheck.sweep(tables, "profile.file=a.csv,b.csv,c.csv", workers=1)
    counts = [len(point["warnings"]) for point in swept.content["points"]]
    assert counts[:2] == [0, 0] and counts[2] > 0
    header, _, *rows = printed(swept.content)[:5]
    assert header[:4] == ["profile.file", "warnings", "peak", "pressure"]
    assert [row[0] for row in rows] == ["a.csv", "b.csv", "c.csv"] and rows[2][1] == str(counts[2])
    told = list(warnings_of(swept.content))
    assert all(text.startswith("at profile.file c.csv: ") for text in told)
    assert "the rms slope is" in told[0] and len(told) == counts[2]
    for point, own in zip(swept.content["points"], (["x", "y"], ["x"], ["x", "y"]), strict=True):
        point["warnings"] = own
    assert list(warnings_of(swept.content)) == ["x", "at profile.file a.csv and 1 more: y"]


def test_points_show_verdict_and_judged_errors_where_models_are_compared():
    row = {"study": "model_error", "against": "whole", "source": "half_plane", "unit": ""}
    row |= {"quantity": "tau1_max", "verdict": "fails", "uncertainty": 2e-3}
    at = [(0.0, -0.013), (0.3, -0.041), (0.5, 0.02)]
    rows = tuple(row | {"friction": friction, "value": value} for friction, value in at)
    solved = {"values": [1e9], "status": "solved", "verdict": "fails", "within": 0.0431}
    points = [
        solved | {"rows": rows},
        {"values": [2e9], "status": "failed", "why": "no", "rows": ()},
    ]
    over = [{"field": "load.hertz_peak_pressure", "values": [1e9, 2e9]}]
    content = {"over": over, "points": points, "scatter": []}
    first, second, *_ = printed(content)[3:]
    assert first == ["1", "fails", "4.4", "%", "-4.1", "+-", "0.20"] and second == ["2", "failed"]
    points *= 60
    assert ["20", "points", "more", "are", "in", "the", "files"] in printed(content)


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    folder = tmp_path_factory.mktemp("sweep")
    tables = WAVES | {"title": "Waves", "profile": SINUSOID | {"amplitude": "50 nm"}}
    (folder / "waves.toml").write_text(as_toml(tables))
    asked = ["sweep", str(folder / "waves.toml"), "--out", str(folder / "out"), "--workers", "1"]
    asked += ["--over", "profile.amplitude=20 nm,50 nm,5e-8", "--over", "roller.radius=8e-3,1e-2"]
    return folder / "out", asked, main(asked)


@pytest.mark.parametrize(
    ("over", "label", "band"),
    [
        (["load=0.5 GPa,1e9"], "load.hertz_peak_pressure [GPa]", False),
        (
            ["position=3", "roller.radius=8 mm,9e-3"],
            "position of the roller on the trace [µm]",
            True,
        ),
        (["body.material=brass,carbon steel", "load=0.5 GPa,1e9"], "body.material", False),
    ],
)
def test_pictures_have_a_unit_an_axis_all_words_inside_and_a_band_for_samples(over, label, band):
    swept = crosscheck.sweep(WAVES | {"title": "Waves"}, over, workers=1)
    with style.drawing():
        figure = sweep_figure(swept.content)
        figure.draw_without_rendering()
    assert figure.axes[-1].get_xlabel() == label
    assert band or figure.axes[0].lines[0].get_xdata()[-1] == 1.0
    words = [axis.label for axes in figure.axes for axis in (axes.xaxis, axes.yaxis)]
    words += [text for legend in figure.legends for text in legend.texts]
    for word in words:
        box = word.get_window_extent()
        assert box.width == 0.0 or (box.x0 >= 0.0 and box.x1 <= figure.bbox.x1 and box.y0 >= 0.0)
    assert all(bool(axes.patches) == band for axes in figure.axes)
    assert ("mean" in repr(swept)) == (len(over) == 1 and band)
    assert len(figure.legends) == (len(over) == 2)


def test_the_command_leaves_table_picture_and_json(made, monkeypatch, capsys):
    out, asked, status = made
    assert status == 0
    content = json.loads((out / "sweep.json").read_text())
    assert len(content["points"]) == 4  # 5e-8 m is 50 nm
    with (out / "sweep.csv").open() as lines:
        rows = list(csv.DictReader(lines))
    assert {row["profile.amplitude"] for row in rows} == {"20 nm", "50 nm"}
    assert (out / "sweep.svg").read_text().startswith("<?xml")
    before = (out / "sweep.json").read_bytes()
    monkeypatch.setattr("comparisons.runs.run.run", None)  # a second call solves nothing
    assert main(asked) == 0
    assert (out / "sweep.json").read_bytes() == before
    said = "4 scenes (2 of profile.amplitude x 2 of roller.radius), 0 failed"
    assert said in capsys.readouterr().out


@pytest.mark.parametrize(
    ("over", "said"),
    [
        ("load=1 GPa,nan", "load.hertz_peak_pressure: is nan, which is not finite"),
        ("load=1e9,inf", "load.hertz_peak_pressure: is inf"),
        ("body.poissons_ratio=0.2,0.5", "body.poissons_ratio: is 0.5; allowed is"),
        ("body.material=brass,unobtainium", 'body.material: is "unobtainium"'),
        ("load.position=10 um,60 um,119 um", "reaches the end of the trace"),
    ],
)
def test_a_wrong_value_after_a_right_one_solves_and_writes_nothing(
    made, tmp_path, complaint, monkeypatch, over, said
):
    monkeypatch.setattr("comparisons.grid.points.called", None)
    line = complaint("sweep", made[1][1], "--over", over, "--out", tmp_path / "out")
    assert said in line and over.rpartition(",")[2] in line


@pytest.mark.parametrize(
    ("error", "status"), [(SolverError("no luck"), 3), (InputError("no luck"), 0)]
)
def test_points_that_fail_are_told_with_the_status_of_solvers(
    made, tmp_path, capsys, monkeypatch, error, status
):
    """A point without a scene is no failure of theirs."""

    def solved(point):
        if point.at["roller.radius"] == 8e-3:
            raise error
        return {"status": "solved", "rows": ()}

    monkeypatch.setattr("comparisons.grid.sweep.solved", solved)
    monkeypatch.setattr(Sweep, "pictures", lambda _: {})
    asked = [*made[1][:3], str(tmp_path / "out"), *made[1][4:]]
    assert main(asked) == status
    assert "2 failed\nfailed, 2: no luck" in capsys.readouterr().out


def test_rough_fields_are_mapped_by_their_quiescent_zone(tmp_path, capsys):
    """Long waves bridge it, short ones do not, and friction does."""
    tables = changed(WAVES, load={"friction": [0, 0.3]}, stress={"points": [120, 40]})
    tables |= {"title": "Waves", "profile": SINUSOID | {"amplitude": "200 nm"}}
    tables |= {"roller": {"radius": 5.76923e-3, **STEEL}}
    (tmp_path / "waves.toml").write_text(as_toml(tables))
    out = tmp_path / "out"
    asked = ["sweep", str(tmp_path / "waves.toml"), "--workers", "1", "--out", str(out)]
    for _ in range(2):  # the second goes on from the files of the first
        assert main([*asked, "--over", "profile.wavelength=20 um,45 um"]) == 0
        assert "quiescent_zone.svg" in capsys.readouterr().out
    content = json.loads((out / "sweep.json").read_text())
    zones = [p["quiescent_zone"]["half_plane"] for p in content["points"]]
    statuses = [[entry["status"] for entry in entries] for entries in zones]
    assert statuses == [["quiescent", "bridged"], ["bridged", "bridged"]]
    assert all(0 <= entry["bridged"] <= entry["asperities"] for e in zones for entry in e)
    with style.drawing():
        axes = zone_map_figure(content).axes
    shown = [[text.get_text() for text in panel.texts] for panel in axes]
    assert shown == [[f"{e[k]['level']:.2f}" for e in zones] for k in (0, 1)]
    titles = [panel.get_title(loc="left") for panel in axes]
    assert titles == ["friction 0, half-plane", "friction 0.3, half-plane"]


def test_stresses_as_arrays():
    run = crosscheck.run(STEADY | {"stress": {"points": [21, 8], "depth": 1.0}}, "half-plane")
    arrays = run.stress()
    shape = (*arrays["z"].shape, *arrays["x"].shape)
    assert len(shape) == 2 and arrays["z"][0] == 0.0 and np.all(np.diff(arrays["z"]) > 0.0)
    assert all(arrays[name].shape == shape for name in ("sx", "sz", "txz", "tau1"))
    middle = shape[1] // 2  # the pressure, in compression, under the roller's middle
    assert arrays["sz"][0, middle] == pytest.approx(-run.contact()["pressure"].max(), rel=0.01)
    radius = np.hypot(0.5 * (arrays["sx"] - arrays["sz"]), arrays["txz"])
    assert arrays["tau1"] == pytest.approx(radius)
    with pytest.raises(InputError, match="at friction 0"):
        run.stress(friction=0.3)
    with pytest.raises(InputError, match="model: is whole"):
        run.stress("whole")


def test_figures_of_further_studies_are_swept():
    """The length that sticks of a smooth contact falls as by Cattaneo and Mindlin."""
    load = {"per_length": 1e6, "friction": [0.3]}
    tables = STEEL_PAIR | {"load": load, "partial_slip": {"load": 0.5}}
    swept = crosscheck.sweep(tables, "partial_slip.load=0.19,0.51,0.84", workers=1)
    lengths = values_of(swept, "partial_slip", "stick_length")
    half_width = problem_of(scene_of(tables)).hertz.half_width
    assert lengths == pytest.approx(np.array([1.8, 1.4, 0.8]) * half_width, rel=2e-3)
    assert "length that sticks" in repr(swept)
