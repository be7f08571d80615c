"""Files of scenes: where they are, what they say as TOML; the shipped scenes."""

import os
import re
import shlex
import tomllib
from contextlib import suppress
from pathlib import Path

from comparisons.common.errors import SceneError, nearest, one_line

SCENES = Path(__file__).parent / "library"
BENCHMARKS = SCENES / "benchmarks"
LARGEST_FILE = 2**20  # bytes; a scene has a few hundred
ALIKE = 0.8  # difflib's ratio of a name that may be meant
LONGEST_NAME = 256  # characters of a name that is repeated
MOST_PARTS = 32  # of a dotted key; a scene has two, and the time of reading grows by their square
STRINGS = re.compile(
    r'"""(?:\\.|[^\\])*?"""|'
    r"'''.*?'''|"
    r'"(?:\\.|[^"\\\n])*+"|'
    r"'[^'\n]*+'|#[^\n]*+",
    re.DOTALL,
)
# as tomllib says it
TABLE_TWICE = re.compile(r"Cannot declare \('(.*?)',?\) twice")
LONG_KEY = re.compile(rf"(?<![\w.-])(?:[\w-]++[ \t]*+\.[ \t]*+){{{MOST_PARTS}}}")


def scene_names() -> list[str]:
    """The scenes that come with the project."""
    return sorted(path.stem for path in SCENES.glob("*.toml"))


def benchmark_names() -> list[str]:
    """Shipped scenes with what is published of them."""
    return sorted(path.stem for path in BENCHMARKS.glob("*.toml"))


def scene_titles(benchmarks: bool = False) -> dict[str, str]:
    """Name and title of every scene that comes with the project, or of every benchmark."""
    names = benchmark_names() if benchmarks else scene_names()
    return {name: read_toml(find_scene(name))["title"] for name in names}


def find_scene(name_or_path: str | os.PathLike) -> Path:
    """The file of a scene, named by its path or by the name of one that comes with the project.
    A name wins over a file that is called the same; "./name" means the file. Raises SceneError
    if there is neither, with the nearest name and the names there are."""
    name = os.fspath(name_or_path)
    if not name:
        raise SceneError("the scene has no name; allowed is a scene's file or name")
    names, benchmarks = scene_names(), benchmark_names()
    if name in (*names, *benchmarks):
        return (SCENES if name in names else BENCHMARKS) / f"{name}.toml"
    if os.path.lexists(name):
        return Path(name)
    path = Path(name)
    beside = path.with_suffix(".toml")
    others = [other.name for other in path.parent.glob("*.toml")]
    alike = beside.name if os.path.lexists(beside) else nearest(path.name, others, ALIKE)
    if alike is not None:
        there = f"there is no such file, but {path.with_name(alike)}"
        raise SceneError(f"{name}: {there}; allowed is a scene's file or name")
    if path.suffix or os.path.dirname(name):
        raise SceneError(f"{name}: there is no such file; allowed is a scene's file or name")
    near, every = nearest(name, [*names, *benchmarks]), ", ".join(names)
    why = "is neither a file nor a scene; the nearest scene is"
    shown = name if len(name) < LONGEST_NAME else f"{name[:40]}…"
    raise SceneError(f"{shown}: {why} {near}, all are {every}")


def name_of(path: Path) -> str:
    """Name of a scene in a file: the file's without its ending, as printable text."""
    stem = path.stem.encode("utf-8", "surrogateescape").decode("utf-8", "replace")
    return one_line(stem).strip(". ") or "scene"


def read_toml(path: Path) -> dict:
    """The tables of a TOML file. Raises SceneError if it cannot be read as TOML or is empty."""

    def wrong(problem: str) -> SceneError:
        return SceneError(f"{path}: {problem}")

    def no_toml(problem: str) -> SceneError:
        if path.suffix == ".toml":
            return wrong(problem)
        trace = shlex.quote(str(path))
        return wrong(f"is no scene; of a measured trace `crosscheck init {trace}` makes one")

    try:
        size = path.stat().st_size
        if not path.is_file():
            kind = "a directory" if path.is_dir() else "not a regular file"
            raise wrong(f"is {kind}; allowed is a TOML file")
        if size > LARGEST_FILE:
            raise no_toml(f"has {size} bytes; allowed are {LARGEST_FILE} for a scene")
        text = path.read_bytes().decode("utf-8-sig")
        if LONG_KEY.search(STRINGS.sub("s", text)):
            raise wrong(
                f"has a key of more than {MOST_PARTS} parts; allowed are a section's and one"
            )
        tables = tomllib.loads(text)
    except SceneError:
        raise
    except OSError as error:
        raise wrong(f"cannot be read: {error.strerror}; allowed is a TOML file") from error
    except UnicodeDecodeError as error:
        place = f"byte {error.start} is not UTF-8"
        raise no_toml(f"is not text ({place}); allowed is a TOML file") from error
    except tomllib.TOMLDecodeError as error:
        said = TABLE_TWICE.sub(r"[\1] is given twice", str(error)).replace("', '", ".")
        said = said.replace("Cannot overwrite a value", "a field is given twice")
        raise no_toml(f"is not TOML: {said}") from error
    except (RecursionError, ValueError) as error:
        raise wrong(f"is beyond what TOML may hold: {error}") from error
    if not tables:
        raise wrong("is empty; allowed are sections, at least [roller], [body], [load]")
    return tables


def value_of(text: str) -> object:
    """The value that a text stands for after "FIELD=": as TOML has it, or else the text itself, as
    a quantity with its unit and a word need no quotation marks."""
    with suppress(ValueError, RecursionError):
        tables = tomllib.loads(f"value = {text}")
        if list(tables) == ["value"]:
            return tables["value"]
    for kind in (int, float) if text.isascii() else ():
        with suppress(ValueError):  # .5 and 5. are no numbers of TOML
            return kind(text)
    return text.strip()
