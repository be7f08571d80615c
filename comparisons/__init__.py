"""Scene in, figures out: what notebooks and scripts need, each loaded when it is used first.

    import crosscheck

where it is installed, which is this package: `import comparisons as crosscheck` in any case.

A scene is read, made of tables as TOML has them, and changed; texts carry units, numbers are SI.

>>> steel = {"youngs_modulus": "207 GPa", "poissons_ratio": 0.3}
>>> scene = crosscheck.Scene.of({
...     "title": "Steel on steel",
...     "roller": {"radius": "8.2 mm", **steel},
...     "body": steel,
...     "load": {"hertz_peak_pressure": "1 GPa", "friction": [0.0, 0.1]},
...     "stress": {"points": [60, 20]},
... })
>>> sliding = scene.changed("load.friction", 0.2)
>>> sliding.load.friction
(0.2,)

It is solved by one model or by both; each figure has its uncertainty, and a verdict where it is
judged. Nothing is written unless a folder is given.

>>> run = crosscheck.run(scene, models="half-plane")
>>> peak = run.figure("peak_pressure", "half-plane", friction=0.1)
>>> round(peak.value / 1e9, 4), peak.verdict
(1.0, None)

A run prints in ten lines; in a notebook the tables of the command line are shown.

>>> print(run)  # doctest: +ELLIPSIS
Steel on steel
How wrong the half-plane may be here is not known: only the half-plane model was run.
NOT COMPARED  Peak pressure 1.000 GPa, ...

`run.figures` are all of them, `run.figures.rows` records of them, `run.plot` draws.

>>> axes = run.plot.pressure()
>>> axes[0].get_ylabel()
'p/p₀'
>>> [round(f.value, 3) for f in run.figures.of(quantity="contact_ratio")]
[1.0, 1.0]"""

import sys
import warnings
from importlib import import_module
from importlib.machinery import ModuleSpec, PathFinder
from pathlib import Path

# By name, the module that has it.
FACE = "run sweep map cost verify stability deck read rerun table compare"
PUBLIC = {"Scene": "comparisons.scenes.scene", **dict.fromkeys(FACE.split(), "comparisons.api")}
__all__ = list(PUBLIC)
ROOT = str(Path(__file__).resolve().parents[1])


class OwnPackages:
    """Finds the packages beside this one there, whatever lies before them on the path under their
    names: the folder of a user's script, which is first, may hold a module `fem` of his own."""

    NAMES = ("analytic", "meshes", "fem")

    @classmethod
    def find_spec(cls, name: str, path: object = None, target: object = None) -> ModuleSpec | None:
        return PathFinder.find_spec(name, [ROOT]) if path is None and name in cls.NAMES else None

    @classmethod
    def install(cls) -> None:
        """Raises ImportError where the process has imported another module of such a name already;
        warns of one that can no longer be."""
        for name in cls.NAMES:
            ours, loaded = cls.find_spec(name).origin, sys.modules.get(name)
            spec = PathFinder.find_spec(name) if loaded is None else loaded.__spec__
            if spec is None or spec.origin is None or Path(spec.origin).samefile(ours):
                continue
            clash = f"{spec.origin}: crosscheck has a package {name} too"
            if loaded is not None:
                raise ImportError(f"{clash}, and a process cannot have both: rename yours")
            warnings.warn(f"{clash}, which `import {name}` now gives", stacklevel=3)
        sys.meta_path.insert(0, cls)


OwnPackages.install()


def __dir__() -> list[str]:
    return __all__


def __getattr__(name: str) -> object:
    if name not in PUBLIC:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(PUBLIC[name]), name)
