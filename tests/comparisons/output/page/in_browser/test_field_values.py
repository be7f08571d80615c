"""Values and sections that a reader takes from the fields are those of the run."""

import csv
import re

import numpy as np
import pytest

from comparisons.output.page.pictures.stresses import COMPONENTS
from comparisons.studies.study import Run

WIDTH = 1280
NUMBERS = (
    "[...document.querySelectorAll('#look [text-anchor=end]')].map((t) => +t.getAttribute('y'))"
)
BELOW = 232  # pixels: where the panel of the difference begins
NUMBER = r"(−?[\d.]+(?:e−?\d+)?)"


def figures(text: str) -> dict[str, float]:
    """Place and values that a line of the page shows."""
    names = ("x", "z", "half-plane", "finite elements", "difference")
    numbers = {}
    for name in names:
        match = re.search(rf"{name}(?: =)? {NUMBER}", text.replace("\u00a0", " "))
        numbers[name] = float(match[1].replace("−", "-"))
    return numbers


def field(outcome: Run, model: str, component: int, friction: float) -> np.ndarray:
    stress = outcome.runs[model].finest.stress(friction).field
    return COMPONENTS[component].of(stress) / outcome.problem.hertz.peak_pressure


def expect(text: str, outcome: Run, component: int, friction: float) -> dict[str, float]:
    """The values shown are those of the point shown; returns them."""
    shown, a = figures(text), outcome.problem.hertz.half_width
    row = np.argmin(np.abs(outcome.window.z / a - shown["z"]))
    column = np.argmin(np.abs(outcome.window.x / a - shown["x"]))
    one, other = (
        field(outcome, name, component, friction) for name in ("half_plane", "finite_element")
    )
    assert shown["half-plane"] == pytest.approx(one[row, column], abs=1e-4)
    assert shown["finite elements"] == pytest.approx(other[row, column], abs=1e-4)
    largest = np.max(np.abs(one - other))
    between = one[row, column] - other[row, column]
    assert shown["difference"] == pytest.approx(between, rel=0.06, abs=float(1e-4 * largest))
    return shown


def test_the_depth_that_is_chosen_is_the_one_that_is_shown(tab, wavy_file, wavy_outcome: Run):
    page = tab(wavy_file, WIDTH)
    depths = set()
    for component in (0, 1):
        for friction, coefficient in enumerate(wavy_outcome.problem.scene.load.friction):
            for row in (0, 3, 7):
                text = page.value(
                    f"""(() => {{
                      const [component, friction] = document.querySelectorAll("#look select");
                      const [depth, place] = document.querySelectorAll("#look input");
                      [component.value, friction.value] = [{component}, {friction}];
                      [depth.value, place.value] = [{row}, Math.round(place.max / 3)];
                      depth.dispatchEvent(new Event("input"));
                      return document.querySelector("#look [role=status]").textContent;
                    }})()"""
                )
                depths.add(expect(text, wavy_outcome, component, coefficient)["z"])
                heights = page.value(NUMBERS)
                assert min(sum(y < BELOW for y in heights), sum(y > BELOW for y in heights)) > 1
    assert len(depths) == 3
    paths = page.value("[...document.querySelectorAll('#look path')].map((p) => p.outerHTML)")
    assert len(paths) == 3  # both models, and their difference below
    assert len(set(paths)) == 3
    assert page.complaints() == []


def test_the_places_to_point_at_are_where_the_fields_are_drawn(tab, wavy_file):
    page = tab(wavy_file, WIDTH)
    # of every box a colour just inside its upper right corner, and one above it beside the title
    colours = page.value(
        """(async () => {
          const boxes = [];
          for (const picture of document.querySelectorAll("[data-field]")) {
            const drawn = JSON.parse(picture.dataset.field);
            if (drawn.component !== 0) continue; // whose colours are never white
            await picture.decode();
            const canvas = document.createElement("canvas");
            [canvas.width, canvas.height] = [800, 800];
            const context = canvas.getContext("2d");
            context.drawImage(picture, 0, 0, 800, 800);
            const at = (x, y) => [...context.getImageData(800 * x, 800 * y, 1, 1).data];
            for (const [x, y, w, h] of drawn.boxes)
              boxes.push([at(x + w - 0.004, y + 0.004), at(x + w - 0.004, y - 0.008),
                at(x + 0.004, y + h - 0.006), at(x - 0.008, y + h / 3)]);
          }
          return boxes;
        })()"""
    )
    assert len(colours) == 4 * 3
    for number, (inside, above, low, beside) in enumerate(colours):
        models = number % 3 < 2
        assert sum(inside[:3]) < 700 or not models, (number, inside)
        assert sum(low[:3]) < 700 or not models, (number, low)
        for outside in (above, beside):
            assert outside[3] == 0 or sum(outside[:3]) > 740, (number, outside)


def test_every_picture_of_a_field_gives_its_points_as_csv(tab, wavy_file, wavy_outcome: Run):
    page = tab(wavy_file, WIDTH)
    files = page.value(
        """(async () => {
          const blobs = [];
          URL.createObjectURL = (blob) => (blobs.push(blob), "#look");
          const links = [...document.querySelectorAll("figcaption a.data[href='#look']")];
          for (const link of links) link.click();
          const texts = await Promise.all(blobs.map((blob) => blob.text()));
          const drawn = (link) =>
            JSON.parse(link.closest("figure").querySelector("img").dataset.field);
          return links.map((link, k) => [drawn(link), link.textContent, link.download, texts[k]]);
        })()"""
    )
    frictions, a = wavy_outcome.problem.scene.load.friction, wavy_outcome.problem.hertz.half_width
    assert len(files) == 6
    for drawn, words, name, text in files:
        header, *rows = csv.reader(text.splitlines())
        symbol = COMPONENTS[drawn["component"]].symbol
        names = "half-plane", "finite elements", "difference"
        assert header == ["x/a", "z/a", *(f"{symbol}/p₀, {name}" for name in names)]
        assert name == f"{symbol}.csv"
        numbers = np.array(rows, dtype=float)
        deep = np.unique(numbers[:, 1])
        assert words == f"CSV, {len(rows) // len(deep)} × {len(deep)} points"
        assert deep[-1] == pytest.approx(drawn["z"][1], rel=1e-4)
        which = drawn["component"], frictions[drawn["friction"]]
        row, column = (
            np.argmin(np.abs(places[:, None] / a - at), axis=0)
            for places, at in zip(
                (wavy_outcome.window.z, wavy_outcome.window.x), numbers[:, [1, 0]].T, strict=True
            )
        )
        one, other = (
            field(wavy_outcome, model, *which)[row, column]
            for model in ("half_plane", "finite_element")
        )
        assert numbers[:, 2] == pytest.approx(one, abs=1e-4)
        assert numbers[:, 3] == pytest.approx(other, abs=1e-4)
        least = float(1e-4 * np.abs(one - other).max())
        assert numbers[:, 4] == pytest.approx(one - other, abs=least)


def test_a_pointer_on_a_picture_reads_both_models(tab, wavy_file, wavy_outcome: Run):
    page = tab(wavy_file, WIDTH)
    frictions, a = wavy_outcome.problem.scene.load.friction, wavy_outcome.problem.hertz.half_width
    count = page.value("document.querySelectorAll('[data-field]').length")
    assert count == 6  # two components and next to the surface, twice
    for number in range(count):
        drawn, frame = page.value(
            f"""(() => {{
              const picture = document.querySelectorAll("[data-field]")[{number}];
              picture.scrollIntoView({{block: "center", behavior: "instant"}});
              const {{left, top, width, height}} = picture.getBoundingClientRect();
              return [JSON.parse(picture.dataset.field), [left, top, width, height]];
            }})()"""
        )
        assert len(drawn["boxes"]) == 3
        for left, top, width, height in drawn["boxes"]:
            page.point(
                frame[0] + frame[2] * (left + 0.3 * width),
                frame[1] + frame[3] * (top + 0.5 * height),
            )
            text = page.value("document.querySelector('.tip').textContent")
            assert page.value("!document.querySelector('.tip').hidden")
            shown = expect(text, wavy_outcome, drawn["component"], frictions[drawn["friction"]])
            wanted = drawn["x"][0] + 0.3 * np.ptp(drawn["x"])
            near = float(0.02 * np.ptp(wavy_outcome.window.x) / a)
            assert shown["x"] == pytest.approx(wanted, abs=near)
            wanted = drawn["z"][0] + 0.5 * np.ptp(drawn["z"])
            rows = np.abs(wavy_outcome.window.z / a - wanted)
            assert abs(shown["z"] - wanted) <= 1.001 * rows.min() + 1e-4
        page.point(frame[0] + 2.0, frame[1] + 2.0)
        assert page.value("document.querySelector('.tip').hidden")
