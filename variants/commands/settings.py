"""What a user always says, written once in `kulman.toml` of their home: the usual values of options."""

from __future__ import annotations

import os
import sys
import tomllib
from collections.abc import Callable
from pathlib import Path

from ...scales.choices import PROFILES
from ...scales.errors import LANGUAGES, InputError
from ...scales.names import unknown
from ...scales.numbers import SHOWN, quote

PLACE = "KULMAN_CONFIG"  # names another file; none where it is empty
NORMS = ("gost", "iso")
# by key: the parameter of commands that it is the usual value of
KEYS = ("name", "group", "teacher", "department", "work", "language", "norm", "notation", "profile")
PARAMETERS = {key: key for key in KEYS} | {"name": "student", "language": "lang"}


def _notations() -> tuple[str, ...]:
    from ...drawing.words import notations

    return notations()


_CHOICES: dict[str, Callable[[], tuple[str, ...]]] = {
    "language": lambda: LANGUAGES,
    "norm": lambda: NORMS,
    "notation": _notations,
    "profile": lambda: PROFILES,
}


def _settings_file() -> Path | None:
    """Return where the settings are looked for: `KULMAN_CONFIG`, else `kulman.toml` in the system's folder for them."""
    named = os.environ.get(PLACE)
    if named is not None:
        return Path(named) if named else None
    folder = os.environ.get("APPDATA" if sys.platform == "win32" else "XDG_CONFIG_HOME", "")
    if os.path.isabs(folder):
        return Path(folder) / "kulman.toml"
    home = os.path.expanduser("~")
    return Path(home) / ".config" / "kulman.toml" if os.path.isabs(home) else None


def settings() -> dict[str, str]:
    """Return the usual values of parameters; none where there is no file.

    Raises
    ------
    InputError
        The file cannot be read, or keys of it, which are all named, are none of `PARAMETERS` or have no value that they
        can have.
    """
    file = _settings_file()
    if file is None:
        return {}
    shown, text = quote(file, SHOWN), ""
    if not file.exists():
        if os.environ.get(PLACE):
            raise InputError("file-missing", file=f"{PLACE}: {shown}")
        return {}
    try:
        if not file.is_file():
            raise InputError("file-not-regular", file=shown)
        text = file.read_bytes().decode("utf-8-sig").replace("\r\n", "\n")
        raw = tomllib.loads(text)
    except OSError:
        raise InputError("file-unreadable", file=shown) from None
    except UnicodeDecodeError:
        raise InputError("settings-encoding", file=shown) from None
    except (tomllib.TOMLDecodeError, RecursionError) as problem:
        from ..reader import syntax_fault

        raise syntax_fault(text, shown, str(problem)) from None
    values, faults = {}, {}
    for key, given in raw.items():
        try:
            values[PARAMETERS.get(key, key)] = _value(key, given)
        except InputError as refused:
            faults[key] = refused
    if faults:
        from ..checks.basics import Checker, Places

        checker = Checker(shown, Places(text))
        for key, fault in faults.items():
            checker.fault((key,), fault)
        raise InputError(
            "settings-faults", faults=[fault for _, _, fault in sorted(checker.faults, key=lambda one: one[:2])]
        )
    return {name: value for name, value in values.items() if value}


def _value(key: str, given: object) -> str:
    """Return the value of a key, checked."""
    if key not in PARAMETERS:
        raise unknown("key-unknown", key, PARAMETERS)
    if not isinstance(given, str):
        raise InputError("type-text")
    if key not in _CHOICES or not given.strip():
        return given.strip()
    value = given.strip().lower()
    if value not in (known := _CHOICES[key]()):
        raise unknown("choice-unknown", given.strip(), known)
    return value
