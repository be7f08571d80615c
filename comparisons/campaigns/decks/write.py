"""A scene as a folder that another code solves, with how to run it and bring the answer back."""

from dataclasses import dataclass
from pathlib import Path

from comparisons.campaigns.decks import TEMPLATES
from comparisons.campaigns.decks.problem import MM, DeckProblem, deck_problem
from comparisons.common.errors import InputError
from comparisons.common.files import check_writable, publish
from comparisons.models.problem import Problem, problem_of
from comparisons.output.page.html import rendered
from comparisons.scenes.scene import Scene

FILES = ("README.md", "answer.toml", "job.inp", "mesh.inp", "solve.py", "mesh.npz")
CODES = {"calculix": "CalculiX", "abaqus": "Abaqus", "fenicsx": "FEniCSx"}
MOST_LEVEL = 8


@dataclass(frozen=True)
class WrittenDeck:
    """Where a deck is, and how large it is."""

    folder: Path
    code: str
    deck: DeckProblem

    @property
    def nodes(self) -> int:
        return sum(len(body.points) for body in self.deck.bodies.values())

    def as_dict(self) -> dict:
        """For JSON; lengths [m]."""
        found = {"folder": str(self.folder), "code": self.code, "nodes": self.nodes}
        files = sorted(name for name in FILES if (self.folder / name).exists())
        return found | {"files": files, "edge": self.deck.edge / MM}


def write_deck(scene: Scene, code: str, out: Path, level: int = 1) -> WrittenDeck:
    """Write the deck of a scene for one of CODES to the folder `out`.

    level  of the scene's own refinement, from 1, whose elements the contact gets
    Raises InputError for another code or level and a folder that cannot be written, SceneError for
    a scene that decks of this code do not describe."""
    if code not in CODES:
        raise InputError(f"--for: is {code}; allowed is one of {', '.join(CODES)}")
    if not 1 <= level <= MOST_LEVEL:
        raise InputError(f"--level: is {level}; allowed is 1 to {MOST_LEVEL}")
    check_writable(out, FILES)
    problem = _problem(scene)
    deck = deck_problem(problem, problem.pitches[0] / 2.0 ** (level - 1))
    given = {"code": code, "name": CODES[code], "deck": deck, "scene": scene, "folder": out}
    words = {n: rendered(TEMPLATES / f"{n}.j2", **given) for n in ("README.md", "answer.toml")}
    publish(out, _files(deck, code) | words, FILES)
    return WrittenDeck(out, code, deck)


def _files(deck: DeckProblem, code: str) -> dict[str, str | bytes]:
    if code == "fenicsx":
        from comparisons.campaigns.decks.fenicsx import fenicsx_files

        return fenicsx_files(deck)
    from comparisons.campaigns.decks.keywords import keyword_files

    return keyword_files(deck, code)


def _problem(scene: Scene) -> Problem:
    if scene.load.kind != "approach":
        return problem_of(scene)
    from comparisons.common.progress import no_progress
    from comparisons.models.finite_element.level import problem_of_approach

    return problem_of_approach(scene, no_progress)
