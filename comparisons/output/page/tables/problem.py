"""The problem in figures: what a reader needs to set it up again by hand."""

from analytic.material import Material
from analytic.surface.roughness_standard import SECTIONS, StandardRoughness
from comparisons.common.numbers import decimal, given, listed, plain, significant, with_unit
from comparisons.models.assumptions import support_text
from comparisons.output.page.tables.text import wording
from comparisons.scenes.scene import Scene
from comparisons.scenes.sections import BodySection, CoatingSection
from comparisons.scenes.surface import ProfileInfo, SceneSurface
from comparisons.studies import problem as asked
from comparisons.studies.study import Run

Rows = list[tuple[str, str]]


def problem_sheet(outcome: Run) -> list[tuple[str, Rows]]:
    """Headings, each with its rows of a name and a value."""
    surface = outcome.problem.surface
    info = surface.info
    before = "" if surface.run_in is None else " before running-in"
    return [
        ("Geometry", _geometry(outcome.problem.scene, surface)),
        *([] if info is None else [(f"Roughness{before} (ISO 21920-2)", _standard(info))]),
        ("Materials", _materials(outcome)),
        ("Load", _load(outcome)),
        ("Dimensionless groups", _groups(outcome)),
    ]


def _geometry(scene: Scene, surface: SceneSurface) -> Rows:
    rows = [("radius of relative curvature R", given(scene.roller.radius, "m"))]
    body = scene.body
    if body.thickness is None:
        rows.append(("body, thickness", "unbounded"))
    else:
        base = {"bonded": "bonded to", "frictionless": "free to slide on"}[body.base]
        rows.append(("body, thickness t", f"{given(body.thickness, 'm')}, {base} a rigid base"))
    width = "unbounded" if body.width is None else given(body.width, "m")
    rows.append(("body, width w", width))
    if surface.info is None:
        return [*rows, ("surface", "smooth")]
    place = ("place of the roller on the trace", given(surface.position, "m"))
    return [*rows, *_profile(surface.info), place]


def _profile(info: ProfileInfo) -> Rows:
    figures = info.roughness
    rows = [
        ("profile", info.source),
        ("samples, length, spacing", f"{info.samples}, {_pair_in_m(info.length, info.spacing)}"),
        ("form", str(info.form)),
        ("filter", filter_text(info)),
        ("Ra, Rq as pressed", _pair_in_m(figures.ra, figures.rq)),
        ("highest peak to deepest valley", with_unit(figures.rt, "m")),
        ("skewness, kurtosis", f"{decimal(figures.rsk, 2)}, {decimal(figures.rku, 2)}"),
    ]
    if info.place:
        rows.insert(1, ("line of the map", info.place))
    if info.bridged or info.trimmed:
        lost = f"{info.bridged} bridged, {info.trimmed} cut off at the ends"
        if info.stretch is not None:
            lost += f", the longest from {' to '.join(with_unit(v, 'm') for v in info.stretch)}"
        rows.append(("lost samples", lost))
    return rows


def filter_text(info: ProfileInfo) -> str:
    """Which waves were taken off the trace before it was pressed."""
    longer = info.cutoff and f"waves longer than {in_mm(info.cutoff)} removed"
    shorter = info.short_cutoff and f"waves shorter than {given(info.short_cutoff, 'm')} removed"
    return ", ".join(filter(None, (longer, shorter))) or "none"


def in_mm(cutoff: float) -> str:
    """A cut-off [m] as drawings give it."""
    return f"{plain(1e3 * cutoff)} mm"


def _standard(info: ProfileInfo) -> Rows:
    """The standard's parameters of the trace, pressed as it is or not."""
    found = info.standard
    if found is None:
        return [("parameters", f"none: {info.standard_why}")]
    short = "none" if found.short_cutoff is None else given(found.short_cutoff, "m")
    width = "no whole element" if found.rsm is None else with_unit(found.rsm, "m")
    return [
        ("cut-offs λc, λs", f"{in_mm(found.cutoff)}, {short}"),
        ("section lengths", sections_text(found)),
        ("Ra, Rq", _pair_in_m(found.ra, found.rq)),
        ("Rz, Rt", _pair_in_m(found.rz, found.rt)),
        ("Rsk, Rku", f"{decimal(found.rsk, 2)}, {decimal(found.rku, 2)}"),
        ("Rdq, RSm", f"{significant(found.rdq, 3)}, {width}"),
        ("unlike as pressed", standard_text(info)),
    ]


def sections_text(found: StandardRoughness) -> str:
    """How many section lengths there are, and where they are fewer than the standard's."""
    if found.sections == SECTIONS:
        return str(SECTIONS)
    few = f"{found.sections} where the standard asks for {SECTIONS}"
    return f"{few}, so that Rz is Rt" if found.sections == 1 else few


def standard_text(info: ProfileInfo) -> str:
    """Why the standard's parameters are not those of the surface as pressed, in one phrase."""
    found = info.standard
    ends = f"waves longer than {in_mm(found.cutoff)}"
    if found.short_cutoff is not None:
        ends += f" and shorter than {given(found.short_cutoff, 'm')}"
    span = with_unit(found.sections * found.cutoff, "m")
    return f"{ends} are filtered off, and the middle {span} of {with_unit(info.length, 'm')} count"


def _pair_in_m(first: float, second: float) -> str:
    return f"{with_unit(first, 'm')}, {with_unit(second, 'm')}"


def _materials(outcome: Run) -> Rows:
    problem = outcome.problem
    scene = problem.scene
    rows = [
        ("roller", "rigid" if scene.roller.rigid else elastic_text(scene.roller.material)),
        *([] if scene.roller.rigid else [("roller as a disc", support_text(scene.roller))]),
        ("body", elastic_text(scene.body.material)),
        *([] if scene.coating is None else [("coating", coating_text(scene.coating))]),
        ("combined modulus E*", with_unit(problem.modulus, "Pa")),
        ("Dundurs' β", significant(problem.dundurs_beta, 3)),
    ]
    if scene.body.hardness is not None:
        rows.append(("hardness of the body", given(scene.body.hardness, "Pa")))
    if scene.body.yield_stress is not None:
        rows.append(("body yields", yielding_text(scene.body)))
    return rows


def elastic_text(material: Material) -> str:
    """A material in one phrase."""
    return f"E = {given(material.youngs_modulus, 'Pa')}, ν = {plain(material.poissons_ratio)}"


def coating_text(coating: CoatingSection) -> str:
    """A coating in one phrase."""
    return f"{given(coating.thickness, 'm')} thick, {elastic_text(coating.material)}"


def yielding_text(body: BodySection) -> str:
    """How a body flows, in one phrase."""
    modulus = body.hardening_modulus
    harder = f", hardening by {given(modulus, 'Pa')}" if modulus else ""
    return f"at {given(body.yield_stress, 'Pa')}{harder}"


def _load(outcome: Run) -> Rows:
    scene, hertz = outcome.problem.scene, outcome.problem.hertz
    label, unit = wording()["loads"][scene.load.kind]
    rows = [(f"{label} (given)", given(scene.load.value, unit))]
    if scene.load.kind != "per_length":
        rows.append(("load per length P", with_unit(hertz.load_per_length, "N/m")))
    return [
        *rows,
        ("friction coefficient µ", listed(scene.load.friction)),
        ("Hertz half-width a", with_unit(hertz.half_width, "m")),
        ("Hertz peak pressure p₀", with_unit(hertz.peak_pressure, "Pa")),
        (
            "largest τ₁ without friction, smooth",
            f"{with_unit(hertz.tau1_max, 'Pa')} at depth {with_unit(hertz.tau1_max_depth, 'm')}",
        ),
    ]


def _groups(run: Run) -> Rows:
    groups = run.figures.of(study=asked.NAME, source=asked.SCENE)
    return [(asked.QUANTITIES[f.quantity].label, significant(f.value, 3)) for f in groups]
