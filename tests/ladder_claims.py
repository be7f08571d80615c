"""What the ladder claims by estimates, against the whole model, on random scenes.

Started by `python -m tests.ladder_claims 40 claims.json`: as many scenes, smooth, wavy and rough,
with layers and without, of rigid and elastic rollers, known and unknown laws. Each is solved up to
the deformed half-plane and as a whole; a claim is a rung that is said to hold by estimates, and is
refuted where the whole says that it fails. Goes on from the scenes in the file."""

import json
import sys
from dataclasses import asdict
from pathlib import Path
from time import process_time

import numpy as np

from comparisons.common.errors import InputError, SceneError, SolverError
from comparisons.figures.quantity import MODELS
from comparisons.runs.run import run
from comparisons.scenes.scene import Origin, Scene
from comparisons.studies.ladder.rungs import verdict_of
from comparisons.studies.ladder.show import SUFFICES
from comparisons.studies.study import LADDER

LAWS = ({}, {"law": "neo-hookean"}, {"law": "hencky"}, {"law": "st-venant-kirchhoff"})


def scene_of(number: int) -> Scene:
    """One of the random scenes."""
    draw = np.random.default_rng([number, 29])
    body = {
        "youngs_modulus": 200e9,
        "poissons_ratio": float(draw.uniform(0.2, 0.4)),
        **LAWS[draw.integers(len(LAWS))],
    }
    roller = {"radius": 1e-2, "rigid": True}
    if draw.random() < 0.4:
        roller = {"radius": 1e-2, "youngs_modulus": 200e9 * float(draw.uniform(0.5, 3.0))}
        roller |= {"poissons_ratio": 0.3, **LAWS[draw.integers(len(LAWS))]}
    curvature = float(np.exp(draw.uniform(*np.log([2e-3, 6e-2]))))
    load = {"hertz_peak_pressure": 0.4 * curvature * 110e9}
    load["friction"] = float(draw.choice([0.0, 0.0, 0.1, 0.3]))
    tables = {"roller": roller, "body": body, "load": load}
    kind, width = draw.choice(["smooth", "layer", "sinusoid", "self-affine"]), curvature * 1e-2
    if kind == "layer":
        body["thickness"] = width / float(draw.uniform(0.05, 1.0))
    elif kind != "smooth":
        wave = width * float(draw.uniform(0.5, 1.5))
        height = wave * float(np.exp(draw.uniform(*np.log([5e-4, 1e-2]))))
        made = {"sinusoid": {"wavelength": wave, "amplitude": height}}
        shape = {"length": 12.0 * width, "samples": 257, "rms_height": height, "hurst": 0.8}
        made["self-affine"] = shape | {"shortest_wavelength": wave, "seed": number}
        tables["profile"] = {"kind": str(kind), **made[kind]}
    tables["tolerance"] = dict.fromkeys(("peak_pressure", "contact_length"), 0.0)
    if draw.random() < 0.5:
        tables["stress"] = {"points": [60, 20]}
        tables["tolerance"]["tau1_max"] = 0.0
    allowed = float(np.exp(draw.uniform(*np.log([3e-3, 6e-2]))))
    tables["tolerance"] = dict.fromkeys(tables["tolerance"], allowed)
    tables |= {"budget": {"time": 30.0}, "resolution": {"levels": 2}}
    return Scene.of(tables, Origin(f"random-{number}"))


def claims_of(number: int) -> dict:
    """What is said of one scene by estimates, and by the whole."""
    scene, began = scene_of(number), process_time()
    alone = run(scene.changed("budget.up_to", "deformed"), None, MODELS[:1])
    seconds = process_time() - began
    whole = run(scene, None, MODELS).figures.of(study=LADDER, against="whole")
    rungs = {figure.source for figure in whole}
    return {
        "number": number,
        "tables": scene.written,
        "claimed": alone.findings[LADDER].said(SUFFICES),
        "verdicts": {name: verdict_of(whole.of(source=name)) for name in sorted(rungs)},
        "seconds": [seconds, process_time() - began - seconds],
        "errors": [
            [f.source, f.quantity, f.value, f.total, asdict(f)["at"]]
            for f in (*alone.figures.of(study=LADDER), *whole)
        ],
    }


def main(count: int, path: Path) -> None:
    known = json.loads(path.read_text()) if path.exists() else []
    for number in range(len(known), count):
        known.append({"number": number, "refused": "the process was killed"})
        path.write_text(json.dumps(known))
        try:
            known[-1] = claims_of(number)
        except (InputError, SceneError, SolverError) as error:
            known[-1]["refused"] = str(error)
        path.write_text(json.dumps(known))
    solved = [one for one in known if "verdicts" in one]
    claimed = [one for one in solved if one["claimed"]]
    refuted = [one for one in claimed if one["verdicts"].get(one["claimed"]) == "fails"]
    print(f"{len(solved)} scenes, {len(claimed)} claims, {len(refuted)} refuted")


if __name__ == "__main__":
    main(int(sys.argv[1]), Path(sys.argv[2]))
