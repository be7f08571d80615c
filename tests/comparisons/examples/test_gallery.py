"""The gallery is of runs: every shipped scene is on it as its file has it, and one is run anew."""

import pytest

from comparisons.examples import gallery
from comparisons.scenes.files import scene_names

PAGE = (gallery.DOCS / "gallery.md").read_text(encoding="utf-8")
PICTURES = gallery.DOCS / "gallery"


def cards(page: str) -> dict[str, list[str]]:
    """Paragraphs of each scene by its name."""
    parts = page.partition('<div class="grid cards" markdown>')[2].split("\n-   ![")[1:]
    return {part.partition(":")[0]: part.split("\n\n") for part in parts}


@pytest.mark.parametrize("scene", gallery.SCENES, ids=lambda scene: scene.stem)
def test_scenes_stand_there_as_their_files_have_them(scene):
    shown = "\n\n".join(cards(PAGE)[scene.stem]).replace("\n    ", "\n")
    assert f"```toml\n{scene.read_text(encoding='utf-8').strip()}\n```" in shown


def test_every_scene_has_its_card_and_pictures_are_small():
    assert list(cards(PAGE)) == scene_names() == sorted(p.stem for p in PICTURES.iterdir())
    assert sum(path.stat().st_size for path in PICTURES.iterdir()) < 0.5e6


def test_a_run_makes_the_card_that_is_shown(tmp_path, monkeypatch, undrawn):
    """All but the numbers of the sentence, whose last digits are the machine's."""
    monkeypatch.setattr(gallery, "SCENES", [s for s in gallery.SCENES if s.stem == "smooth"])
    gallery.main(["--runs", str(tmp_path / "runs"), "--out", str(tmp_path)])
    [made], shown = (
        cards((tmp_path / "gallery.md").read_text(encoding="utf-8")).values(),
        cards(PAGE)["smooth"],
    )
    assert made[:3] + made[4:7] == shown[:3] + shown[4:7]
    assert (tmp_path / "gallery/smooth.png").read_bytes().startswith(b"\x89PNG")
    again = gallery.run_of("smooth", tmp_path / "runs")
    assert again.result["within_words"] in made[3]
