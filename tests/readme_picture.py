"""The README's picture: the report's overview of a run. This command makes it again:

.venv/bin/python -m tests.readme_picture
"""

from pathlib import Path
from tempfile import TemporaryDirectory

from comparisons.drawing.style import collected_figures
from comparisons.figures.quantity import MODELS
from comparisons.output.page.pictures.answer import overview

PICTURE = Path(__file__).parents[1] / "comparisons/docs/ground-unrun.png"
WIDTH = 8.35  # inches
PIXELS = 192  # to the inch: twice what 800 pixels across need


def remake(scene: str = "ground-unrun", path: Path = PICTURE) -> None:
    """Run a scene and write its picture."""
    from comparisons.runs.run import run
    from comparisons.scenes.scene import Scene

    with TemporaryDirectory() as folder:
        outcome = run(Scene.read(scene), Path(folder) / "out", MODELS)
    with collected_figures() as drawn:
        overview(outcome, WIDTH)
    drawn[0].savefig(path, dpi=PIXELS, pil_kwargs={"optimize": True})


if __name__ == "__main__":
    remake()
