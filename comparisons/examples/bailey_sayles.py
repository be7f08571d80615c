"""Bailey and Sayles (1991) computed anew: figures 1 and 5 to 8, and what the paper claims.

    .venv/bin/python -m comparisons.examples.bailey_sayles --out results/bailey_sayles

D. M. Bailey and R. S. Sayles (Effect of roughness and sliding friction on contact stresses, Journal
of Tribology 113, 729-738) press a smooth cylinder on three ground surfaces, and sum the stresses
below. Their traces are not published: three computed profiles stand in for them, under the paper's
load and Hertz pressure, 4.15 GPa. All is the half-plane's, as in the paper.

The table has a row for each claim that a number can judge: the number, where it would confirm the
claim, and the result. Where the paper has words and no number ("many", "near the surface") the
bounds are this script's; between them and plain denial a claim is open. What a profile was made to
show is "made so", and proves nothing.

Lengths are over a, stresses over p0: half-width and peak pressure of the smooth contact, as in the
paper. τ1 is the principal shear, τxz the orthogonal one, z the depth, µ the friction."""

import argparse
from collections.abc import Iterator
from dataclasses import dataclass
from math import inf, pi
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from scipy.ndimage import label

import comparisons as crosscheck

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SMOOTH, ROUGH = "smooth", ("ground-unrun", "ground-run-in", "ground-polished")  # scenes
SHOWN = {8: "unrun", 9: "run in", 10: "polished"}  # these by the paper's figures
MU = 0.1  # of the paper's lubricated contacts
TAU1 = 0.300283  # p0: the largest τ1 of the smooth contact without friction
NEAR, DEEP = 0.1, 0.5  # a: asperities shear above the one, the smooth contact below the other
SAMPLE = 1e-6  # m, of the traces
WAVES = 0.34, 0.36, 0.38  # a, of bodies whose asperities may bridge the quiescent zone
SYMBOLS = {"sx": "σx", "sz": "σz", "txz": "τxz", "tau1": "τ1"}


class PressedSurface:
    """A surface under the cylinder, by the name of its scene."""

    def __init__(self, scene: str, changes: dict | None = None) -> None:
        fine = {"load.friction": [0.0, MU], "stress.points": [600, 120]}
        self.scene = crosscheck.Scene.read(scene).changed(fine | (changes or {}))
        self.run = crosscheck.run(self.scene, "half-plane")
        self.a, self.p0, self.modulus = (  # m, Pa, Pa
            self.run.figure(name, "hertz", "problem").value
            for name in ("half_width", "peak_pressure", "reduced_modulus")
        )
        contact, fields = self.run.contact(), {mu: self.run.stress(friction=mu) for mu in (0.0, MU)}
        self.x, self.pressure = contact["x"] / self.a, contact["pressure"] / self.p0
        self.along, self.z = (fields[0.0][name] / self.a for name in ("x", "z"))  # (k,), (m,)
        self.stress = {  # (m, k) by name and friction
            (name, mu): fields[mu][name] / self.p0 for name in SYMBOLS for mu in fields
        }
        self.tau1 = self.stress["tau1", 0.0]

    def figure(self, quantity: str, study: str = "contact", mu: float = 0.0) -> float:
        """A figure of the run, SI."""
        return self.run.figure(quantity, "half-plane", study, friction=mu).value

    def over_p0(self, quantity: str) -> float:
        return self.figure(quantity) / self.p0

    def depth(self) -> float:
        """Depth of the largest τ1."""
        return self.figure("tau1_max_depth") / self.a

    def patches(self) -> np.ndarray:
        """First node of each patch of contact, and the one after its last (n, 2)."""
        touches = np.concatenate([[False], self.pressure > 0.0, [False]])
        return np.flatnonzero(np.diff(touches)).reshape(-1, 2)

    def pressed(self, limit: float) -> float:
        """Share of the patches whose highest pressure exceeds a limit."""
        return np.mean([self.pressure[i:j].max() > limit for i, j in self.patches()])

    def sheared(self, limit: float) -> float:
        """Share of the patches below which τ1 exceeds a limit."""
        highest = self.tau1[self.z <= NEAR].max(axis=0)
        columns = np.abs(self.along - self.x[:, None]).argmin(axis=1)
        return np.mean([highest[columns[i:j]].max() > limit for i, j in self.patches()])

    def agreement(self) -> float:
        """Depth below which τ1 is within 5 % of the smooth maximum from the smooth contact's."""
        apart = np.abs(self.tau1 - hertz(self.along, self.z[:, None])[-1]).max(axis=1)
        return self.z[np.flatnonzero(apart > 0.05 * TAU1)[-1] + 1]

    def zone(self, tau1: np.ndarray, level: float) -> np.ndarray:
        """Zone where τ1 is above a level, in smooth maxima, joined with its largest deep one."""
        zones, _ = label(tau1 >= level * TAU1, np.ones((3, 3)))
        return zones == max(zones.flat[np.where(self.z[:, None] >= DEEP, tau1, 0.0).argmax()], 1)

    def drawn_up(self) -> float:
        """How much nearer to the surface the zone of half the maximum is than the smooth one's."""
        fields = hertz(self.along, self.z[:, None])[-1], self.tau1
        smooth, rough = (self.z[self.zone(tau1, 0.5).any(axis=1).argmax()] for tau1 in fields)
        return smooth - rough

    def opening(self, mu: float) -> float:
        """Highest level, in smooth maxima, at which that zone reaches the surface."""
        tau1, levels = self.stress["tau1", mu], np.linspace(1.0, 0.0, 401)
        return next(level for level in levels if self.zone(tau1, level)[0].any())


def hertz(x: np.ndarray, z: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Exact σx, σz and τ1 of the smooth contact; on the axis the paper's equations (6a) to (6c)
    (K. L. Johnson, Contact Mechanics, eq. 4.49)."""
    s = 1.0 - x**2 + z**2
    root = np.hypot(s, 2.0 * x * z)
    m, n = np.sqrt(0.5 * (root + s)), np.sqrt(np.maximum(0.5 * (root - s), 0.0))
    share = (z**2 + n**2) / root
    sx, sz = 2.0 * z - m * (1.0 + share), m * (share - 1.0)
    return sx, sz, np.hypot(0.5 * (sx - sz), n * (m**2 - z**2) / root)


def strips(
    middles: np.ndarray, pressure: np.ndarray, mu: float, x: np.ndarray, z: np.ndarray
) -> np.ndarray:
    """σx and σz (2, …) of uniform strips, by equations (1) and (2) of the paper."""
    pitch = middles[1] - middles[0]
    x = np.asarray(x)[..., None] - np.append(middles, middles[-1] + pitch) + 0.5 * pitch
    z = np.asarray(z)[..., None]
    t, far = np.arctan2(z, x), np.diff(np.log(np.hypot(x, z)))
    turned, sine, cosine = (np.diff(part) for part in (t, np.sin(2.0 * t), np.cos(2.0 * t)))
    along = -2.0 * turned - sine + mu * (4.0 * far - cosine)
    return np.stack([along, sine - 2.0 * turned + mu * cosine]) @ pressure / (2.0 * pi)


def error_on_axis(smooth: PressedSurface) -> float:
    """Largest error of strips at depths less than one of them."""
    z = (smooth.x[1] - smooth.x[0]) * np.geomspace(0.02, 1.0, 8)
    return np.abs(strips(smooth.x, smooth.pressure, 0.0, 0.0 * z, z) - hertz(0.0, z)[:2]).max()


def error_below_samples(rough: PressedSurface) -> float:
    """Largest error of strips as wide as the trace's samples, sliding, against finer pressures
    that are joined linearly."""
    window = {"stress.depth": SAMPLE, "stress.half_range": 0.9, "stress.points": [600, 8]}
    fine, pitch = PressedSurface(rough.scene.name, window), SAMPLE / rough.a
    middles = pitch * np.arange(np.ceil(rough.x[0] / pitch), rough.x[-1] / pitch)
    pressure = np.interp(middles, rough.x, rough.pressure)
    found = strips(middles, pressure, MU, fine.along, fine.z[1:, None])
    return np.abs(found - [fine.stress[name, MU][1:] for name in ("sx", "sz")]).max()


def bridging(smooth: PressedSurface) -> float:
    """Shortest wave that bridges the quiescent zone: whose mean shear falls nowhere below three
    quarters of the maxima above and below. The waves would close under 2 p0."""
    ratios = []
    for wave in WAVES:
        height = 2.0 * smooth.p0 * wave * smooth.a / (pi * smooth.modulus)
        profile = {"kind": "sinusoid", "wavelength": wave * smooth.a, "amplitude": height}
        wavy = PressedSurface(SMOOTH, {"profile": profile})
        ratios.append(wavy.figure("ratio", "quiescent_zone"))
    return np.interp(0.75, ratios, WAVES)


@dataclass(frozen=True)
class Claim:
    """Claim that a figure of the paper shows, and the number that judges it."""

    figure: str
    says: str
    number: float
    low: float  # bounds inside which it is confirmed
    high: float
    allowed: float | None = None  # least value that does not deny it; None: `low`
    made_so: bool = False

    @property
    def outcome(self) -> str:
        if self.low <= self.number <= self.high:
            return "made so" if self.made_so else "confirmed"
        least = self.low if self.allowed is None else self.allowed
        return "open" if least <= self.number <= self.high else "denied"

    def __str__(self) -> str:
        bounds = f"from {self.low:g}" if self.high == inf else f"{self.low:g} to {self.high:g}"
        return f"| {self.figure} | {self.says} | {self.number:.3g} | {bounds} | {self.outcome} |"


def claims(
    smooth: PressedSurface, unrun: PressedSurface, run_in: PressedSurface, polished: PressedSurface
) -> Iterator[Claim]:
    """Claims in the order of the figures; those of every rough surface last."""
    load = unrun.pressure.sum() * (unrun.x[1] - unrun.x[0]) / (0.5 * pi)
    middle, edge = (np.abs(smooth.along - x).argmin() for x in (0.0, 1.0))
    axis = [smooth.stress[name, 0.0][:, middle] for name in ("sx", "sz")]
    error = np.abs(np.subtract(axis, hertz(0.0, smooth.z)[:2])).max()
    by_strips = error_on_axis(smooth), error_below_samples(unrun)
    sheared = [np.gradient(smooth.z) @ smooth.stress["tau1", mu][:, edge] for mu in (0.0, MU)]
    near = polished.tau1[polished.z <= NEAR].max(axis=1) / TAU1
    twice, even = (surface.over_p0("tau1_max") / TAU1 for surface in (unrun, polished))
    quiet = [unrun.figure("ratio", "quiescent_zone", mu) for mu in (0.0, MU)]
    ratios = [surface.figure("contact_ratio") for surface in (unrun, run_in)]
    yield Claim("1", "pressures carry the load, unrun", load, 0.999, 1.001)
    yield Claim("5a", "error of σx and σz on the axis, smooth", error, 0.0, 0.01)
    yield Claim("5b", "that of strips, less deep than one is wide", by_strips[0], 0.0, 0.01)
    yield Claim("5b", "the same below the unrun surface, sliding", by_strips[1], 0.0, 0.01)
    yield Claim("6b", "largest τxz, smooth: 0.25", smooth.over_p0("txz_max_abs"), 0.2475, 0.2525)
    yield Claim("6e", "largest τ1, smooth: 0.300", smooth.over_p0("tau1_max"), 0.2973, 0.3033)
    yield Claim("6e", "its depth: 0.786", smooth.depth(), 0.778, 0.794)
    yield Claim("8a", "contact ratio, unrun: 0.69", ratios[0], 0.68, 0.7, made_so=True)
    yield Claim("8a", "many asperities beyond 1.7 p0", unrun.pressed(1.7), 0.25, 1.0, 0.05, True)
    yield Claim("8e", "largest τ1 over the smooth one: twice", twice, 2.0, inf)
    yield Claim("8e", "so below many asperities", unrun.sheared(2.0 * TAU1), 0.25, 1.0, 0.05)
    yield Claim("8e", "depth of the largest: the surface", unrun.depth(), 0.0, 0.05)
    yield Claim("8g", "friction bridges the quiescent zone (11a)", quiet[1], 0.75, 1.0)
    yield Claim("9a", "contact ratio, run in: 0.87", ratios[1], 0.86, 0.88, made_so=True)
    yield Claim("9a", "peak slightly below 1.7 p0", run_in.pressure.max(), 1.6, 1.7, made_so=True)
    yield Claim("9e", "depth of the largest τ1: the surface", run_in.depth(), 0.0, 0.05)
    yield Claim("10e", "asperities' τ1, polished: below 1", near.max(), 0.0, 1.0, made_so=True)
    yield Claim("10e", "its depth: much shallower", polished.z[near.argmax()], 0.0, 0.05)
    yield Claim("10e", "largest τ1 over the smooth one: as smooth", even, 0.98, 1.02)
    yield Claim("10e", "its depth: as smooth", polished.depth(), 0.747, 0.826)
    yield Claim("11a", "quiescent zone, unrun: its least shear", quiet[0], 0.0, 0.75)
    yield Claim("11a", "waves bridge it, from this length on", bridging(smooth), 0.0, 1.0)
    yield Claim("11b", "friction shears the edge more", sheared[1] / sheared[0], 1.0, inf)
    for surface, (number, name) in zip((unrun, run_in, polished), SHOWN.items(), strict=True):
        depth, opening = surface.agreement(), surface.opening(MU)
        yield Claim(f"{number}f", f"as smooth from 0.5 a on, {name}", depth, 0.0, 0.5)
        yield Claim(f"{number}f", "Hertz zone drawn up by", surface.drawn_up(), 0.0, inf)
        yield Claim(f"{number}g", "open to the surface by friction", opening, 0.5, inf, 0.333)


def draw_axis(drawn: "Figure", smooth: PressedSurface) -> None:
    """Figure 5: stresses on the axis, marks computed, lines exact."""
    middle = len(smooth.along) // 2
    for axes, depth in zip(drawn.subplots(1, 2), (1.0, 0.1), strict=True):
        fine = np.linspace(0.0, depth, 101)
        marked = np.unique(smooth.z.searchsorted(np.linspace(0.0, 0.99 * depth, 12)))
        for name, exact in zip(("sx", "sz", "tau1"), hertz(0.0, fine), strict=True):
            computed = smooth.stress[name, 0.0][marked, middle]
            [line] = axes.plot(exact, fine, linewidth=0.8, label=f"{SYMBOLS[name]}/p0")
            axes.plot(computed, smooth.z[marked], "o", color=line.get_color(), markersize=3.0)
        axes.set(ylim=(depth, 0.0), ylabel="z/a")
    axes.legend()


def draw_shear(drawn: "Figure", surface: PressedSurface) -> None:
    """Figures 6 and 8: both shears without friction and with it, as contours of one scale."""
    rows = drawn.subplots(2, 2, sharex=True, sharey=True)
    bands = {"txz": np.linspace(-0.35, 0.35, 15), "tau1": np.linspace(0.0, 0.5, 11)}
    for row, (name, levels) in zip(rows, bands.items(), strict=True):
        look = {"extend": "both", "cmap": "RdBu_r" if name == "txz" else "viridis"}
        for axes, mu in zip(row, (0.0, MU), strict=True):
            field = surface.stress[name, mu]
            shown = axes.contourf(surface.along, surface.z, field, levels, **look)
            axes.set(title=f"{SYMBOLS[name]}/p0, µ = {mu:g}", xlim=(-1.25, 1.25), ylim=(1.0, 0.0))
        drawn.colorbar(shown, ax=row)
    drawn.supxlabel("x/a")
    drawn.supylabel("z/a")


def draw_profiles(drawn: "Figure", surfaces: list[PressedSurface]) -> None:
    """Figure 7: the profiles, unrun, run in, and unrun beside polished."""
    files = [surface.scene.folder / surface.scene.profile.file for surface in surfaces]
    unrun, run_in, polished = (np.loadtxt(f, delimiter=",", skiprows=3).T for f in files)
    panels = {"unrun": [unrun], "run in": [run_in], "unrun, and polished": [unrun, polished]}
    rows = drawn.subplots(3, 1, sharex=True, sharey=True)
    for axes, (title, traces) in zip(rows, panels.items(), strict=True):
        for x, height in traces:
            axes.plot(x, height, linewidth=0.6)
        axes.set(title=title, ylabel="height [µm]")
    axes.set_xlabel("position on the trace [µm]")


def main(arguments: list[str] | None = None) -> None:
    """Solve, print the table, and write it with the pictures."""
    from matplotlib.figure import Figure
    from rich.console import Console
    from rich.markdown import Markdown

    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--out", type=Path, default=Path("results/bailey_sayles"))
    out = parser.parse_args(arguments).out
    out.mkdir(parents=True, exist_ok=True)
    smooth, *rough = (PressedSurface(name) for name in (SMOOTH, *ROUGH))
    head = "| figure | claim | number | confirmed | outcome |\n| --- | --- | ---: | --- | --- |"
    table = "\n".join([head, *map(str, claims(smooth, *rough))])
    (out / "claims.md").write_text(f"{table}\n", encoding="utf-8")
    Console().print(Markdown(table))
    pictures = {1: rough[0].run.plot.pressure()[0].figure}
    drawings = {5: (draw_axis, smooth), 6: (draw_shear, smooth), 7: (draw_profiles, rough)}
    for number, (draw, shown) in (drawings | {8: (draw_shear, rough[0])}).items():
        pictures[number] = Figure((7.0, 3.4), layout="constrained")
        draw(pictures[number], shown)
    for number, drawn in pictures.items():
        drawn.savefig(out / f"figure-{number}.png", dpi=100)


if __name__ == "__main__":
    main()
