"""What students of a class have got: which files, the key, or why there is nothing."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

from ...scales.errors import InputError
from ..journal import digest_of
from .student import Made, Student


@dataclass(frozen=True, slots=True)
class Outcome:
    """What a student has got: the files with digests of what they hold, the key; or what the problem is."""

    variant: str
    sheet: str
    files: Mapping[str, str]
    key: Mapping[str, float | None]
    notes: tuple[str, ...]
    problem: str

    @classmethod
    def of(cls, made: Made) -> Outcome:
        """Return what has been made, without what the files hold."""
        files = {name: digest_of(data) for name, data in made.files.items()}
        return cls(made.variant, made.sheet, files, made.key, made.notes, made.problem)

    @classmethod
    def from_json(cls, data: Mapping[str, Any]) -> Outcome:
        """Return an outcome from plain data.

        Raises
        ------
        TypeError
            The data are of something else.
        """
        if not isinstance(data["files"], dict):
            raise TypeError
        return cls(**{**data, "notes": tuple(data["notes"])})

    def to_json(self) -> dict[str, Any]:
        """Return the outcome as plain data."""
        return {item.name: getattr(self, item.name) for item in fields(self)}

    def there(self, folder: Path) -> bool:
        """Whether the files are in the folder as they were made; a problem is looked at again."""
        return not self.problem and all(self.has(folder, name) for name in self.files)

    def has(self, folder: Path, name: str) -> bool:
        """Whether one of the files is in the folder as it was made."""
        with suppress(OSError):
            return digest_of((folder / name).read_bytes()) == self.files[name]
        return False


@dataclass(frozen=True, slots=True)
class Batch:
    """The students of a class with what each has got, in the order of the roster; `warnings` are about the roster."""

    students: tuple[Student, ...]
    outcomes: tuple[Outcome, ...]
    warnings: tuple[InputError, ...] = ()

    @property
    def problems(self) -> list[str]:
        """Why students have got nothing, a line each."""
        return [outcome.problem for outcome in self.outcomes if outcome.problem]
