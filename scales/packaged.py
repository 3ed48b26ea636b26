"""Tables that come with the package: TOML beside the code, read once."""

from __future__ import annotations

from functools import cache
from importlib import import_module
from pathlib import Path
from typing import Any


def home(package: str) -> Path:
    """Return the folder of a package, with what lies beside its code.

    `importlib.resources` gives the same, but to import it takes half as long as Python takes to start.
    """
    return Path(str(import_module(package).__file__)).parent


@cache
def packaged(package: str, folder: str, name: str) -> dict[str, Any]:
    """Return the table `folder/name.toml` of `package`, with what subjects have of it; nobody may change it."""
    import tomllib

    files = (home(place) / folder / f"{name}.toml" for place in (package, *_ADDED))
    tables = [tomllib.loads(file.read_text("utf-8")) for n, file in enumerate(files) if n == 0 or file.exists()]
    whole = {key: value for table in tables for key, value in table.items()}
    if package not in _ADDED and len(whole) != sum(map(len, tables)):
        raise ValueError(f"{folder}/{name}.toml: what a subject adds has a key that there is")
    return whole


_ADDED: list[str] = []


def add_texts(package: str) -> None:
    """Add the `texts` and `messages` that stand in the folder of a subject, a language a file, to all there are."""
    if package not in _ADDED:
        _ADDED.append(package)
        packaged.cache_clear()
