"""What the shell may complete: scenes, models, groups, quantities. Loaded when it asks."""

from pathlib import Path


def scenes(incomplete: str) -> list[str]:
    """Names of scenes, TOML files and folders that begin so."""
    from comparisons.scenes.files import scene_names

    return [*_beginning(scene_names(), incomplete), *_paths(incomplete)]


def maps(incomplete: str) -> list[str]:
    """The same with the names of finished maps."""
    from comparisons.studies.maps.request import FINISHED

    names = sorted(path.stem for path in FINISHED.glob("*.toml"))
    return [*_beginning(names, incomplete), *scenes(incomplete)]


def groups(incomplete: str) -> list[str]:
    """Dimensionless groups that a map may have as an axis."""
    from comparisons.studies.maps.groups import GROUPS

    return _beginning(GROUPS, incomplete)


def quantities(incomplete: str) -> list[str]:
    """Quantities that are compared."""
    from comparisons.common.quantities import QUANTITIES

    return _beginning(QUANTITIES, incomplete)


def models(incomplete: str) -> list[str]:
    """Models, and both of them."""
    from comparisons.common.model_names import HYPHENATED

    names = HYPHENATED.values()
    return _beginning([*names, ",".join(names)], incomplete)


def _beginning(names: object, incomplete: str) -> list[str]:
    return [name for name in names if name.startswith(incomplete)]


def _paths(incomplete: str) -> list[str]:
    folder = Path(incomplete).parent if not incomplete.endswith("/") else Path(incomplete)
    begin = incomplete.rpartition("/")[0]
    begin = f"{begin}/" if "/" in incomplete else ""
    found = []
    for path in sorted(folder.glob("*")) if folder.is_dir() else []:
        word = f"{begin}{path.name}"
        if path.name.startswith(".") or not word.startswith(incomplete):
            continue
        if path.is_dir():
            found.append(f"{word}/")
        elif path.suffix == ".toml":
            found.append(word)
    return found
