"""The problem in figures: what a reader needs to set it up again by hand."""

from analytic.material import Material
from analytic.surface.roughness_standard import SECTIONS
from comparisons.common.numbers import as_written, listed, plain, significant, with_unit
from comparisons.drawing.blocks import Heading, Names, TextTable
from comparisons.drawing.curves import hertz_text
from comparisons.drawing.tables import facts_of, figure_table
from comparisons.judging.study import Run
from comparisons.models.assumptions import support_text, yielding_text
from comparisons.models.problem import Problem
from comparisons.scenes.scene import Scene
from comparisons.scenes.sections import BodySection, CoatingSection, ElasticSection
from comparisons.scenes.surface import ProfileInfo, SceneSurface
from comparisons.studies import problem as asked

LOADS = {  # by kind: in words, and the unit
    "per_length": ("load per length", "N/m"),
    "hertz_peak_pressure": ("Hertz peak pressure", "Pa"),
    "mean_pressure": ("mean pressure", "Pa"),
    "approach": ("approach", "m"),
}
STANDARD = "ISO 21920-2"
COATING, HARDNESS, YIELD = "coating", "hardness of the body", "body yields"  # names of rows
Rows = list[tuple[str, str]]


def problem_sheet(run: Run) -> dict[str, Rows]:
    """Rows of a name and a value, by their headings."""
    problem, surface = run.problem, run.problem.surface
    return {
        "Geometry": _geometry(problem.scene, surface),
        "Materials": _materials(problem),
        "Load": _load(run),
        "Dimensionless groups": _figures(run, asked.SCENE),
    }


def problem_items(run: Run) -> list[Heading | Names | TextTable]:
    """Tables of the problem for the page, with the surface's roughness."""
    geometry, *others = [(Heading(name), Names(rows)) for name, rows in problem_sheet(run).items()]
    info, roughness = run.problem.surface.info, ()
    if info is not None:
        before = "" if run.problem.surface.run_in is None else "The standard's: before running-in"
        table = figure_table(asked.figures_of_surface(info), asked.QUANTITIES, before)
        roughness = Heading("Roughness"), table, Names(roughness_notes(info))
    return [item for items in (geometry, roughness, *others) for item in items]


def facts(run: Run) -> Names:
    """Bodies, surface and load in a few rows."""
    problem, scene, info = run.problem, run.problem.scene, run.problem.surface.info
    roller = "rigid" if scene.roller.rigid else solid_text(scene.roller)
    radius = "" if scene.periodic else f"R = {as_written(scene.roller.radius, 'm')}, "
    rows = [(scene.smooth_body, radius + roller), ("body", solid_text(scene.body))]
    rows += [row for row in _materials(problem) if row[0] in (COATING, HARDNESS, YIELD)]
    rough = f"{info.source}: {surface_text(problem.surface)}" if info else "smooth"
    rows += [("surface", rough), ("load", hertz_text(problem))]
    return Names([*rows, ("friction", listed(scene.load.friction))])


def surface_text(surface: SceneSurface) -> str:
    """Roughness as pressed, and what a drawing would say of the trace, before it was run in."""
    text = f"Ra {with_unit(surface.info.roughness.ra, 'm')} as pressed"
    if (standard := surface.info.standard) is not None:
        before = "" if surface.run_in is None else "before running-in "
        ra, cutoff = with_unit(standard.ra, "m"), in_mm(standard.cutoff)
        text += f", {before}{ra} at the cut-off {cutoff}"
    return text


def _geometry(scene: Scene, surface: SceneSurface) -> Rows:
    rows = [("smooth body", "flat")]
    if not scene.periodic:
        rows = [("radius of relative curvature R", as_written(scene.roller.radius, "m"))]
    rows.append(("body, size", size_text(scene.body)))
    if scene.periodic:
        rows.append(("surface repeats after", with_unit(surface.profile.length, "m")))
    if surface.info is None:
        return [*rows, ("surface", "smooth")]
    rows += _profile(surface.info)
    if not scene.periodic:
        rows.append(("position of the roller on the trace", as_written(surface.position, "m")))
    return rows


def size_text(body: BodySection) -> str:
    """A body's thickness, support and width in one phrase."""
    width = "" if body.width is None else f", {as_written(body.width, 'm')} wide"
    if body.thickness is None:
        return f"unbounded in depth{width}" if width else "unbounded (half-plane)"
    base = {"bonded": "bonded to", "frictionless": "free to slide on"}[body.base]
    return f"{as_written(body.thickness, 'm')} thick, {base} a rigid base{width}"


def _profile(info: ProfileInfo) -> Rows:
    length, spacing = (with_unit(size, "m") for size in (info.length, info.spacing))
    long, short = info.cutoff, info.short_cutoff
    removed = [f"waves longer than {in_mm(long)} removed"] if long else []
    removed += [f"waves shorter than {as_written(short, 'm')} removed"] if short else []
    rows = [
        ("profile", info.source),
        ("samples, length, spacing", f"{info.samples}, {length}, {spacing}"),
        ("form", str(info.form)),
        ("filter", ", ".join(removed) or "none"),
    ]
    if info.place:
        rows.insert(1, ("line of the map", info.place))
    if info.bridged or info.trimmed:
        lost = f"{info.bridged} bridged, {info.trimmed} cut off at the ends"
        if info.stretch is not None:
            lost += f", the longest from {' to '.join(with_unit(v, 'm') for v in info.stretch)}"
        rows.append(("lost samples", lost))
    return rows


def in_mm(cutoff: float) -> str:
    """A cut-off [m] as drawings give it."""
    return f"{plain(1e3 * cutoff)} mm"


def roughness_notes(info: ProfileInfo) -> Rows:
    """Notes on both columns of the roughness."""
    off = "" if info.form.kind == "none" else f" without its {info.form.kind}"
    pressed = ("as pressed", f"the whole trace{off}")
    if info.standard is None:
        return [pressed, (STANDARD, f"none: {info.standard_why}")]
    count = info.standard.sections
    said = str(count) if count == SECTIONS else f"{count} where the standard asks for {SECTIONS}"
    sections = ("section lengths", f"{said}, so that Rz is Rt" if count == 1 else said)
    return [pressed, (STANDARD, standard_text(info)), sections]


def standard_text(info: ProfileInfo) -> str:
    """Why the standard's parameters are not those of the surface as pressed, in one phrase."""
    standard = info.standard
    ends = f"waves longer than {in_mm(standard.cutoff)}"
    if standard.short_cutoff is not None:
        ends += f" and shorter than {as_written(standard.short_cutoff, 'm')}"
    span = with_unit(standard.sections * standard.cutoff, "m")
    return f"{ends} are filtered off, and the middle {span} of {with_unit(info.length, 'm')} count"


def _materials(problem: Problem) -> Rows:
    scene = problem.scene
    has_disc = not (scene.roller.rigid or scene.periodic)
    rows = [
        (scene.smooth_body, "rigid" if scene.roller.rigid else solid_text(scene.roller)),
        *([("roller as a disc", support_text(scene.roller))] if has_disc else []),
        ("body", solid_text(scene.body)),
        *([] if scene.coating is None else [(COATING, coating_text(scene.coating))]),
        *([("combined modulus E*", with_unit(problem.modulus, "Pa"))] if scene.periodic else []),
        ("Dundurs' β", significant(problem.dundurs_beta, 3)),
    ]
    if scene.body.hardness is not None:
        rows.append((HARDNESS, as_written(scene.body.hardness, "Pa")))
    if scene.body.yield_stress is not None:
        rows.append((YIELD, yielding_text(scene.body)))
    return rows


def solid_text(section: ElasticSection) -> str:
    """The solid that a body is named after, and its constants."""
    return ": ".join(filter(None, (section.solid, elastic_text(section.material))))


def elastic_text(material: Material) -> str:
    """A material in one phrase; those of a library are computed, and have no end of digits."""
    modulus, ratio = (
        float(f"{value:.4g}") for value in (material.youngs_modulus, material.poissons_ratio)
    )
    return f"E = {as_written(modulus, 'Pa')}, ν = {plain(ratio)}"


def coating_text(coating: CoatingSection) -> str:
    """A coating in one phrase."""
    return f"{as_written(coating.thickness, 'm')} thick, {solid_text(coating)}"


def _load(run: Run) -> Rows:
    scene, hertz = run.problem.scene, run.problem.hertz
    label, unit = LOADS[scene.load.kind]
    rows = [(f"{label} (given)", as_written(scene.load.value, unit))]
    if scene.load.kind != "per_length":
        rows.append(("load per length P", with_unit(hertz.load_per_length, "N/m")))
    rows.append(("friction coefficient µ", listed(scene.load.friction)))
    if scene.periodic:
        rows.append(("period 2a", with_unit(2.0 * hertz.half_width, "m")))
        return [*rows, ("mean pressure p₀", with_unit(scene.load.value, "Pa"))]
    return rows + _figures(run, asked.HERTZ)


def _figures(run: Run, source: str) -> Rows:
    known = run.figures.of(study=asked.NAME, source=source)
    return facts_of(known, asked.QUANTITIES, {source: ""})
