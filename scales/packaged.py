"""Tables that come with the package: TOML beside the code, read once."""

from __future__ import annotations

from functools import cache
from typing import Any


@cache
def packaged(package: str, folder: str, name: str) -> dict[str, Any]:
    """Return the table `folder/name.toml` of `package`; nobody may change it."""
    import tomllib
    from importlib.resources import files

    return tomllib.loads(files(package).joinpath(folder, f"{name}.toml").read_text(encoding="utf-8"))
