"""Gallery of the shipped scenes: picture, verdict, one sentence and scene file of each, from runs.

    .venv/bin/python -m comparisons.examples.gallery --runs results

Scenes whose runs lie in that folder are read, the others are solved into it, which takes about ten
minutes in all. The page and its pictures are written beside the other pages."""

import argparse
from pathlib import Path

import numpy as np

import comparisons as crosscheck

HERE = Path(crosscheck.__file__).parent
SCENES = sorted((HERE / "scenes" / "library").glob("*.toml"), key=lambda path: path.stem)
DOCS = HERE / "docs"
HEAD = """# Gallery

Every shipped scene, as `./crosscheck run NAME` solves it: begin from the one nearest to yours. Each
picture has the pressure over Hertz's peak: orange by the half-plane, blue by the whole model. Below
it is the principal shear stress τ₁ of the latter. Lengths count half-widths of the smooth contact.
Ground surfaces and the gear flank are computed stand-ins for measured traces.

*Written by `.venv/bin/python -m comparisons.examples.gallery`.*
"""
COLOURS = {"half-plane": "#d95f02", "finite-element": "#1b6ca8", "whole": "#1b6ca8"}
SIZE, PIXELS = (3.6, 2.3), 200  # inches, and pixels to one


def run_of(scene: str, runs: Path) -> "crosscheck.api.Result":
    """The run of a scene in a folder of runs; solved where it is not there."""
    folder = runs / scene
    if not (folder / "result.json").exists():
        crosscheck.run(scene, out=folder)
    return crosscheck.read(folder)


def pressures(run: "crosscheck.api.Result") -> dict[str, dict[str, np.ndarray]]:
    """Curves of the half-plane, and of what its error is against."""
    try:
        last = {"whole": run.contact("whole")}
    except ValueError:  # the scene's own finite elements are it
        last = {"finite-element": run.contact("finite-element")}
    return {"half-plane": run.contact("half-plane"), **last}


def draw(run: "crosscheck.api.Result", path: Path) -> None:
    """Draw pressures and, where there is one, the field of τ₁ below; as PNG of few colours."""
    from matplotlib.figure import Figure
    from PIL import Image

    a, p0 = (run.figure(name, "hertz", "problem").value for name in ("half_width", "peak_pressure"))
    drawn = Figure(SIZE, dpi=PIXELS, layout="constrained")
    above, below = drawn.subplots(2, 1, sharex=True, height_ratios=(1.2, 1.0))
    for model, curve in pressures(run).items():
        above.plot(curve["x"] / a, curve["pressure"] / p0, color=COLOURS[model], linewidth=0.8)
    if run.result["scene"].get("stress"):
        field = run.stress(model)
        levels = np.linspace(0.0, np.nanmax(field["tau1"]), 13)
        below.contourf(field["x"] / a, field["z"] / a, field["tau1"], levels, cmap="cividis")
        below.set(ylim=(field["z"][-1] / a, 0.0), ylabel="z/a")
        above.set_xlim(field["x"][0] / a, field["x"][-1] / a)
    else:
        below.remove()
    above.set(ylim=(0.0, None), ylabel="p/p₀")
    drawn.axes[-1].set_xlabel("x/a")
    drawn.savefig(path)
    Image.open(path).convert("RGB").convert("P", palette=Image.Palette.ADAPTIVE, colors=48).save(
        path
    )


def card(scene: Path, run: "crosscheck.api.Result") -> str:
    """One scene on the page."""
    result, name = run.result, scene.stem
    [models] = (series["columns"] for series in result["series"] if series["study"] == "ladder")
    words = dict(zip(models["rung"], models["model"], strict=True))
    suffices = words.get(result["suffices"], "none is known to")
    parts = [
        f"-   ![{name}: pressures and shear](gallery/{name}.png)",
        f"**{name}**: {result['verdict'].upper()}",
        f"{result['scene']['title']}.",
        result["within_words"],
        f"Cheapest model that holds: {suffices}.",
        f"<details markdown><summary>{name}.toml</summary>",
        f"```toml\n{scene.read_text(encoding='utf-8').strip()}\n```",
        "</details>",
    ]
    lines = "\n\n".join(parts).splitlines()
    return "\n".join([lines[0], *(f"    {line}".rstrip() for line in lines[1:])])


def main(arguments: list[str] | None = None) -> None:
    """Draw every scene and write the page."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--runs", type=Path, default=Path("results"))
    parser.add_argument("--out", type=Path, default=DOCS)
    chosen = parser.parse_args(arguments)
    (chosen.out / "gallery").mkdir(parents=True, exist_ok=True)
    cards = []
    for scene in SCENES:
        run = run_of(scene.stem, chosen.runs)
        draw(run, chosen.out / "gallery" / f"{scene.stem}.png")
        cards.append(card(scene, run))
    page = "\n\n".join([HEAD, '<div class="grid cards" markdown>', *cards, "</div>"])
    (chosen.out / "gallery.md").write_text(f"{page}\n", encoding="utf-8")


if __name__ == "__main__":
    main()
