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
    """Return the table `folder/name.toml` of `package`; nobody may change it."""
    import tomllib

    return tomllib.loads((home(package) / folder / f"{name}.toml").read_text(encoding="utf-8"))
