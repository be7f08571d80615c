"""What a finite-element code under comparison is given, and what it returns, as files.

Each code runs as a process of its own, some of them in an interpreter without this project's
packages: this module and the programs need numpy and the code itself, no more.

    g0(x) = x^2 / (2 R) + sum_k A_k (1 - cos(2 pi x / lambda_k + phi_k))    initial gap [m]
    u_z >= d - g0,   p >= 0,   p (u_z + g0 - d) = 0                         on the ground

u_z is the displacement of the flat top into the body and d the approach, which is prescribed.
"""

import time
from collections.abc import Callable
from dataclasses import asdict, dataclass

import numpy as np

SLACK = 1e-9  # of the block: points closer to a side than this are on it


@dataclass(frozen=True)
class Task:
    """One contact problem on one mesh. Lengths in m, moduli in Pa.

    points          (n, 2) x along the surface and z into the body: vertices, then edge midpoints
    triangles       (m, 6) three vertices, then the midpoints of edges (0, 1), (1, 2), (2, 0)
    half_width, depth   of the block: no displacement at its bottom and sides
    ground          (2,) stretch of the top that may be touched, cut into equal edges
    surface_size    their length
    growth          of the elements per distance from the ground
    radius, waves   R, and (k, 3) rows of A_k, lambda_k, phi_k [rad]
    approach        d
    repeats         solutions beyond the first one, in the same process
    """

    points: np.ndarray
    triangles: np.ndarray
    half_width: float
    depth: float
    ground: np.ndarray
    surface_size: float
    growth: float
    radius: float
    waves: np.ndarray
    approach: float
    youngs_modulus: float
    poissons_ratio: float
    repeats: int

    def gap(self, x: np.ndarray) -> np.ndarray:
        """g0 [m] at x [m], of any shape."""
        return gap(x, self.radius, self.waves)

    @property
    def lame(self) -> tuple[float, float]:
        """Lame's lambda and mu in plane strain [Pa]."""
        young, nu = self.youngs_modulus, self.poissons_ratio
        return young * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)), young / (2.0 * (1.0 + nu))

    @property
    def vertices(self) -> np.ndarray:
        """(v, 2) [m], the first of the points."""
        return self.points[: 1 + self.triangles[:, :3].max()]

    def held(self, x: np.ndarray, z: np.ndarray) -> np.ndarray:
        """Whether points are on the bottom or on one of the sides."""
        slack = SLACK * self.depth
        return (np.abs(x) >= self.half_width - slack) | (z >= self.depth - slack)

    def touchable(self, x: np.ndarray, z: np.ndarray) -> np.ndarray:
        """Whether points are on the ground."""
        slack = SLACK * self.depth
        start, stop = self.ground
        return (z <= slack) & (x >= start - slack) & (x <= stop + slack)

    def save(self, path: str) -> None:
        np.savez(path, **asdict(self))

    @classmethod
    def load(cls, path: str) -> "Task":
        with np.load(path) as kept:
            return cls(**{name: kept[name] if kept[name].ndim else kept[name][()] for name in kept})


@dataclass(frozen=True)
class Answer:
    """Contact pressures of one run.

    x, pressure  (k,) ascending [m], and [Pa] there, drawn straight between; zero elsewhere
    seconds      (1 + repeats,) processor time of each solution, mesh in memory to pressures
    unknowns     displacement components
    steps        of the contact iteration
    """

    x: np.ndarray
    pressure: np.ndarray
    seconds: np.ndarray
    unknowns: int
    steps: int

    def at(self, x: np.ndarray) -> np.ndarray:
        """Pressure [Pa] at x [m]."""
        return np.interp(x, self.x, self.pressure, left=0.0, right=0.0)

    def save(self, path: str) -> None:
        np.savez(path, **asdict(self))

    @classmethod
    def load(cls, path: str) -> "Answer":
        with np.load(path) as kept:
            found = {name: kept[name] for name in kept}
        return cls(**found | {name: int(found[name]) for name in ("unknowns", "steps")})


def gap(x: np.ndarray, radius: float, waves: np.ndarray) -> np.ndarray:
    """g0 [m] at x [m], of any shape, under R [m] and rows A_k [m], lambda_k [m], phi_k of waves."""
    x = np.asarray(x, dtype=float)
    angle = 2.0 * np.pi * x[..., None] / waves[:, 1] + waves[:, 2]
    return x**2 / (2.0 * radius) + (1.0 - np.cos(angle)) @ waves[:, 0]


def run_program(
    solve: Callable[[Task], tuple[np.ndarray, np.ndarray, int, int]], task: str, answer: str
) -> None:
    """Solve the task in one file, as often as it asks, into the other file.

    `solve` gives x, pressure, unknowns and steps.
    """
    given = Task.load(task)
    seconds = []
    for _ in range(1 + given.repeats):
        start = time.process_time()
        x, pressure, unknowns, steps = solve(given)
        seconds.append(time.process_time() - start)
    order = np.argsort(x)
    Answer(x[order], pressure[order], np.array(seconds), unknowns, steps).save(answer)
