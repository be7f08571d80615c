"""Rough spheres of Greenwood and Tripp: figures 4.5 and 4.6 of Seireg's book."""

import numpy as np

from comparisons.campaigns.paper.claims.book import (
    HEAVY,
    LIGHT,
    SETS,
    contact,
    growth,
    real_pressure,
)
from comparisons.drawing.style import COLUMN, REFERENCE, Picture, data_uri, figure

COLOURS = dict(zip(SETS, ("#0072B2", "#D55E00", "#009E73"), strict=True))
LOADS = {"light": 0.1, "heavy": 100.0}  # T of figure 4.6


def real_pressure_picture() -> Picture:
    drawn = figure(COLUMN, 3.7)
    axes = drawn.add_axes((0.13, 0.125, 0.83, 0.745))
    loads = np.geomspace(LIGHT, HEAVY, 7)
    for name, summits in SETS.items():
        values = [1e3 * real_pressure(summits, load) for load in loads]
        axes.plot(loads, values, color=COLOURS[name], label=f"set {name}")
    axes.set(xscale="log", xlabel="T of set A", ylabel="mean real pressure [E*/1000]")
    axes.set_ylim(bottom=0.0)
    axes.legend(loc="lower right", ncols=3)
    said = f"over three decades of load it grows by {growth():.2f} at most"
    return Picture(
        source=data_uri(drawn),
        alternative=f"Mean real pressure of rough spheres of sets A, B and C against load: {said}.",
        caption=f"Mean real pressure on rough spheres of 10 mm, sets A, B and C: {said}.",
    )


def spheres_picture() -> Picture:
    drawn = figure(COLUMN, 3.7)
    for place, (words, load) in enumerate(LOADS.items()):
        axes = drawn.add_axes((0.1 + 0.47 * place, 0.125, 0.41, 0.745))
        sphere = contact(SETS["A"], load)
        a, peak = sphere.smooth
        x = np.linspace(0.0, 1.0, 201)
        axes.plot(x, np.sqrt(1.0 - x**2), label="Hertz", **REFERENCE)
        axes.plot(sphere.rho / a, sphere.pressure / peak, color=COLOURS["A"], label="rough")
        bears = sphere.rho[sphere.pressure > 1e-3 * sphere.pressure[0]].max() / a
        axes.set(xlim=(0.0, max(bears, 1.1)), ylim=(0.0, 1.05), xlabel="r/a")
        axes.set_title(f"{words}, T = {load:g}")
    drawn.axes[0].set_ylabel("p/p₀")
    drawn.axes[1].legend(loc="upper right")
    return Picture(
        source=data_uri(drawn),
        alternative="Pressures of a rough and a smooth sphere under a light and a heavy load.",
        caption="Pressures of a rough sphere, set A, and Hertz's, under a light and a heavy load.",
    )
