"""Pictures of a run for notebooks: those of the report, as matplotlib's axes, and VTK's view."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from comparisons.common.errors import InputError
from comparisons.common.numbers import listed
from comparisons.drawing.style import collected_figures
from comparisons.judging.study import Run
from comparisons.output.page.page import PICTURES
from comparisons.output.page.pictures.stresses import COMPONENTS

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from pyvista import Plotter


def _method(name: str, words: str, first: int = 0) -> "Callable[..., list[Axes]]":
    """Draws one of PICTURES; of several the one at `place`."""

    def method(self: "Plots", place: int = first) -> "list[Axes]":
        return self._axes(name, place)

    method.__name__, method.__doc__ = name, words
    return method


@dataclass(frozen=True)
class Plots:
    """Draws what a run has found; each method returns the axes, in the order of the picture. The
    figure is `axes[0].figure`; it is one of pyplot's, so that a notebook shows it by itself. Raises
    InputError where the run does not have what is to be drawn."""

    outcome: Run

    problem = _method("problem", "The bodies to scale, and the contact close up.")
    pressure = _method("pressure", "Pressures over Hertz's, their difference, the surfaces below.")
    close_up = _method("close_up", "The same around the highest peak, with the nodes.")
    surfaces = _method("surface", "Both bodies' surfaces before and under load.")
    sections = _method("sections", "tau1 over depth: 0 under the peak, 1 under the contact's edge.")
    mesh = _method("mesh", "Mesh: 0 all, 1 under the contact, 2 under the highest pressure.", 1)
    cost = _method("cost", "The error of every solved level against its run time.")
    model_error = _method("model_error", "The half-plane's errors by source, and their tolerances.")

    def field(self, component: str = "tau1", friction: float | None = None) -> "list[Axes]":
        """A stress component below the contact by the half-plane and by the whole model, or the
        scene's own finite elements where these are it, and the difference.

        component  tau1 or txz
        friction   coefficient; the scene's first by default"""
        names = [known.name for known in COMPONENTS]
        if component not in names:
            raise InputError(f"component: is {component}; allowed is {' or '.join(names)}")
        frictions = list(self.outcome.problem.scene.load.friction)
        if friction not in (None, *frictions):
            raise InputError(f"friction: is {friction:g}; allowed is {listed(frictions)}")
        place = 0 if friction is None else frictions.index(friction)
        # drawn component by component, in each all friction coefficients
        return self._axes("fields", names.index(component) * len(frictions) + place)

    def view(self, model: str = "finite_element", array: str = "tau1") -> "Plotter":
        """A field of a model on its own points in VTK, x to the right, z down; `.show()` shows it.

        array   of `stress.vtu`: sx, sz, sy, txz, tau1, von_mises, or of finite elements such as
                difference_tau1; of several friction coefficients the first's where none is in the
                name"""
        levels = self.outcome.levels(self.outcome.deciding_friction)
        if model not in levels:
            raise InputError(f"model: is {model}; allowed is {' or '.join(levels)}")
        if self.outcome.window is None:
            raise InputError("the scene has no field; allowed is a scene with [stress]")
        import pyvista

        from comparisons.output.arrays import levels_by_folder
        from comparisons.output.field_files import CELL_TYPES, field_of

        every, shown = levels_by_folder(self.outcome).values(), levels[model]
        together = next(of for of in every if any(level is shown for level in of.values()))
        field = field_of(self.outcome, together)
        array = next((n for n in field.arrays if n.partition(" (")[0] == array), array)
        if array not in field.arrays:
            raise InputError(f"array: is {array}; allowed is {', '.join(field.arrays)}")
        cells = {CELL_TYPES[field.cells.shape[1]]: field.cells}
        grid = pyvista.UnstructuredGrid(cells, field.points)
        grid.point_data.update(field.arrays)
        plotter = pyvista.Plotter()
        title = f"{array} [{field.units[array]}]"
        plotter.add_mesh(grid, scalars=array, cmap="cividis", scalar_bar_args={"title": title})
        x, z, _ = grid.center
        plotter.camera_position = [(x, z, -grid.length), (x, z, 0.0), (0.0, -1.0, 0.0)]
        plotter.camera.parallel_projection = True
        plotter.reset_camera()
        return plotter

    def _axes(self, name: str, place: int) -> "list[Axes]":
        """Axes of one of the figures that this entry of PICTURES draws; the others are closed."""
        from matplotlib import pyplot

        with collected_figures() as drawn:
            PICTURES[name](self.outcome)
        for number, figure in enumerate(drawn):
            if number != place:
                pyplot.close(figure)
        if not 0 <= place < len(drawn):
            raise InputError("the run has no such picture; allowed is one that its report has")
        return drawn[place].axes
