"""A scene: what is asked, as its file has it, checked, in SI, frozen.

What a file leaves out and what follows from the rest stands in the sections as well. Where the
surface is needed (the trace, the position of the roller on it) see `comparisons.scenes.surface`.
A study has its section in a module of `comparisons.scenes.studies`, of the section's name.
What is wrong is one line: "file: section.field: problem; allowed is …"."""

import copy
import os
import re
import shlex
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from importlib import import_module
from pathlib import Path
from pkgutil import iter_modules
from typing import Self

from pydantic import PrivateAttr, ValidationError, create_model

import comparisons.scenes.studies as of_studies
from comparisons.common.cache import types_in
from comparisons.common.errors import InputError, SceneError
from comparisons.common.units import Dimension, describe
from comparisons.scenes.fields import (
    Number,
    SceneSection,
    Text,
    file_fields,
    notes_in,
    optional,
    plain,
)
from comparisons.scenes.files import find_scene, name_of, read_toml, value_of
from comparisons.scenes.finite_element import FiniteElementSection
from comparisons.scenes.profile import ProfileSection
from comparisons.scenes.running_in import RunningInSection
from comparisons.scenes.schema.messages import scene_error
from comparisons.scenes.sections import (
    LINEAR,
    OF_STRESS,
    BodySection,
    BudgetSection,
    CoatingSection,
    ElasticSection,
    LoadSection,
    ResolutionSection,
    RollerSection,
    StressSection,
    ToleranceSection,
)

# Of options, beside "load", whichever it is.
SHORT = {"position": "load.position", "friction": "load.friction"}
FIELD = re.compile(r"[\w-]+(\.[\w-]+){0,3}", re.ASCII)


@dataclass(frozen=True)
class Origin:
    """Origin of a scene."""

    name: str = "scene"  # of the file, without its ending
    folder: Path = Path(".")  # that paths in it count from
    source: str = "scene"  # what messages call it
    settings: tuple[str, ...] = ()  # FIELD=VALUE, that were set beside the file
    command: tuple[str, ...] = ()  # words of the command that asks for it; none from Python


class SceneBase(SceneSection):
    """The sections that every scene may have, and how a scene is read, checked and changed."""

    title: Text | None = optional("what the scene shows: heads tables and report")
    roller: RollerSection
    body: BodySection
    coating: CoatingSection | None = None
    profile: ProfileSection | None = None
    load: LoadSection
    running_in: RunningInSection | None = None
    stress: StressSection | None = None
    tolerance: ToleranceSection = ToleranceSection()
    finite_element: FiniteElementSection = FiniteElementSection()
    resolution: ResolutionSection = ResolutionSection()
    budget: BudgetSection = BudgetSection()

    _written: dict = PrivateAttr(default_factory=dict)
    _origin: Origin = PrivateAttr(default=Origin())

    @classmethod
    def read(cls, name_or_path: str | os.PathLike) -> Self:
        """The scene in a file, or of a name that comes with the project.
        Raises SceneError, one line, for anything that is wrong with the file or what it says."""
        path = find_scene(name_or_path)
        # messages call it as it was asked for: that is how to ask for it again
        origin = Origin(name_of(path), path.parent, os.fspath(name_or_path))
        return cls.of(read_toml(path), origin)

    @classmethod
    def of(cls, tables: Mapping, origin: Origin = Origin()) -> Self:
        """The scene that `tables`, as TOML has them, describe. Raises SceneError as `read` does."""
        try:
            checked = cls.model_validate(tables)
        except ValidationError as error:
            raise scene_error(cls, error, tables, origin.source) from error
        follows = {name: section.completed(checked) for name, section in checked.sections()}
        scene = checked.model_copy(update={"title": checked.title or origin.name, **follows})
        scene._written, scene._origin = copy.deepcopy(dict(tables)), origin
        return scene

    def changed(self, fields: str | Mapping[str, object], value: object = None) -> Self:
        """The scene with another value of a field such as "load.friction", or of several by name,
        checked as a file is; None takes one away, and one kind of load another. What was not given
        follows again."""
        tables = self.written
        pairs = fields if isinstance(fields, Mapping) else {fields: value}
        for name, value in pairs.items():
            *path, last = name.split(".")
            table = tables
            for part in path:
                table = table.setdefault(part, {})
                if not isinstance(table, dict):
                    problem = f"{name}: {part} is no table; allowed is a scene's field"
                    raise SceneError(f"{self.source}: {problem}")
            table[last] = value
            if value is None:
                del table[last]
            elif path == ["load"] and last in LoadSection.KINDS:
                for kind in {*LoadSection.KINDS} - {last}:
                    if f"load.{kind}" not in pairs:
                        table.pop(kind, None)
        return self.of(tables, self._origin)

    def unchecked(self, fields: Mapping[str, object]) -> Self:
        """The scene with other values of fields, by name, as they are; nothing follows."""
        update: dict[str, object] = {}
        for name, value in fields.items():
            section, _, field = name.partition(".")
            if field:
                table = update.get(section, getattr(self, section))
                value = table.model_copy(update={field: value})
            update[section] = value
        return self.model_copy(update=update)

    def __repr__(self) -> str:
        """The title, and a line for each section that was given, as it was."""
        sections = ((n, table) for n, table in self._written.items() if isinstance(table, Mapping))
        lines = (
            f"{name:<14} " + ", ".join(f"{field} {_shown(value)}" for field, value in table.items())
            for name, table in sections
        )
        return "\n".join([str(self.title), *lines])

    __str__ = __repr__

    @property
    def written(self) -> dict:
        """The tables as they were given; paths in them count from `folder`."""
        return copy.deepcopy(self._written)

    @property
    def name(self) -> str:
        return self._origin.name

    @property
    def folder(self) -> Path:
        return self._origin.folder

    @property
    def source(self) -> str:
        return self._origin.source

    @property
    def command(self) -> tuple[str, ...]:
        return self._origin.command

    @property
    def named(self) -> str:
        """Scene as a command names it: the file, and what is set beside it."""
        settings = (word for text in self._origin.settings for word in ("--set", text))
        return shlex.join((self.source, *settings))

    @property
    def tables(self) -> dict:
        """The scene as a file would have it, for JSON and TOML: SI numbers, what follows written
        out, no None. Reading it gives the same scene."""
        tables = plain(self)
        if self.stress is None:  # defaults that have nothing to judge
            for name in OF_STRESS:
                tables["tolerance"].pop(name, None)
        return tables

    @property
    def periodic(self) -> bool:
        """Whether the surface repeats, under a flat body."""
        return self.profile is not None and bool(self.profile.periodic)

    @property
    def elastic_sections(self) -> dict[str, ElasticSection]:
        """The `body`, the `coating` and the elastic `roller`, those that there are."""
        bodies = {name: getattr(self, name) for name in ("body", "coating", "roller")}
        return {n: part for n, part in bodies.items() if part is not None and part.material}

    @property
    def linear(self) -> bool:
        """Whether linear elasticity is the question: no strain is finite."""
        return self.body.law == LINEAR

    @property
    def asks_elastic(self) -> bool:
        """Whether the question is of elastic bodies, wherever these may flow."""
        plastic = self.finite_element.plastic
        return plastic is False or (self.linear and plastic is None)

    @property
    def smooth_body(self) -> str:
        """Name of the body that presses."""
        return "flat body" if self.periodic else "roller"

    @property
    def tolerances(self) -> dict[str, float]:
        """Relative, by compared quantity; others are not judged."""
        return {name: value for name, value in self.tolerance if value is not None}

    def sections(self) -> Iterator[tuple[str, SceneSection]]:
        """The sections that the scene has, but for those of which there may be several."""
        return ((name, part) for name, part in self if isinstance(part, SceneSection))

    def broken_rules(self) -> Iterator[tuple[str, str]]:
        for _, section in self.sections():
            yield from section.misfits(self)
        body, load, coating = self.body, self.load, self.coating
        laws = {name: section.law for name, section in self.elastic_sections.items()}
        for name, law in laws.items():
            if LINEAR in laws.values() and law != LINEAR:
                known = "is missing" if law is None else f'is "{law}"'
                every = 'allowed is "linear" of all elastic bodies (run --law linear), or of none'
                yield f"{name}.law", f"{known} beside a linear one; {every}"
        if coating and body.thickness is not None and coating.thickness >= body.thickness:
            thick = f"is {coating.thickness:g} m on a body of {body.thickness:g} m"
            yield "coating.thickness", f"{thick}; allowed is less, the body's thickness contains it"
        if body.base == "frictionless" and body.width is not None and max(load.friction) > 0.0:
            held = 'allowed is friction = 0, base = "bonded" or no width'
            slides = f"is {max(load.friction):g} on a body of finite width on a frictionless base"
            yield "load.friction", f"{slides}, which nothing would hold; {held}"


def _sections_of_studies() -> dict[str, tuple[object, None]]:
    """SECTION, or none, of each module of `comparisons.scenes.studies`, by the module's name."""
    names = sorted(module.name for module in iter_modules(of_studies.__path__))
    modules = {name: import_module(f"{of_studies.__name__}.{name}") for name in names}
    return {name: (module.SECTION | None, None) for name, module in modules.items()}


# Every scene that is read: with the sections of the studies.
Scene = create_model(
    "Scene", __base__=SceneBase, __module__=SceneBase.__module__, **_sections_of_studies()
)


def _shown(value: object) -> str:
    """A field's value in a line: of long lists the first entries."""
    if isinstance(value, list | tuple):
        return ", ".join(map(str, value[:3])) + (", …" if len(value) > 3 else "")
    return str(value)


def sections_of(scene: type[SceneBase]) -> dict[str, type[SceneSection]]:
    """The sections that a file may have, by name; of such as [answers.NAME] that of any name."""
    return {
        name: kind
        for name, info in scene.model_fields.items()
        for kind in types_in(info.annotation)
        if issubclass(kind, SceneSection)
    }


def dimension_of(field: str) -> Dimension | None:
    """Dimension of the numbers of "table.field"; None where they have not one dimension."""
    table, _, name = field.partition(".")
    section = sections_of(Scene).get(table)
    info = None if section is None else file_fields(section).get(name)
    notes = () if info is None else (*info.metadata, *notes_in(info.annotation))
    return next((note.dimension for note in notes if isinstance(note, Number)), None)


def assignments(option: str, texts: Sequence[str], scene: Scene, allowed: str) -> dict[str, str]:
    """Texts after "FIELD=" in each value of a command's option, by the field's whole name.
    Raises InputError for what is no such thing, and for a field that is given twice."""
    given: dict[str, str] = {}
    for text in texts:
        short, _, value = text.partition("=")
        name = SHORT.get(short.strip(), short.strip())
        name = f"load.{scene.load.kind}" if name == "load" else name
        if not FIELD.fullmatch(name) or not value.strip():
            raise InputError(
                f"{option}: is {describe(text)}; allowed is {allowed}, with FIELD as in "
                "body.youngs_modulus, or load, friction or position"
            )
        if name in given:
            raise InputError(f"{option}: {name} is given twice; allowed is every field once")
        given[name] = value.strip()
    return given


def settings_of(scene: Scene, settings: Sequence[str]) -> dict[str, object]:
    """Values by field of settings FIELD=VALUE. Raises InputError for anything else."""
    fields = assignments("--set", settings, scene, "FIELD=VALUE")
    return {name: value_of(text) for name, text in fields.items()}


def with_settings(scene: Scene, settings: Sequence[str], command: Sequence[str] = ()) -> Scene:
    """The scene with other values of fields, each FIELD=VALUE, checked as a file is.

    command  words of the command that asks for it
    Raises InputError for what is no such thing, SceneError where the scene is none then."""
    changed, origin = scene.changed(settings_of(scene, settings)), scene._origin
    settings = (*origin.settings, *settings)
    changed._origin = replace(origin, settings=settings, command=tuple(command))
    return changed


def with_tolerance(scene: Scene, tolerance: float | str) -> Scene:
    """The scene with one relative tolerance, such as 0.05 or "5%", for all that it judges.
    Raises SceneError unless it is above 0 and below 1."""
    return scene.changed("tolerance", dict.fromkeys(scene.tables["tolerance"], tolerance))


def with_law(scene: Scene, law: str) -> Scene:
    """The scene with one law of elasticity of all its elastic bodies.
    Raises SceneError for a law that needs constants, or is none."""
    bodies = scene.elastic_sections
    fields = {f"{name}.law": law for name in bodies}
    written = (name for name in bodies if "murnaghan" in scene.written[name])
    return scene.changed(fields | dict.fromkeys(f"{name}.murnaghan" for name in written))
