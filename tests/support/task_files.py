"""Task files with other words in them."""

from __future__ import annotations

from kulman.variants.reader import read_text
from kulman.variants.task import Task


def with_changes(text: str, *changes: tuple[str, str]) -> str:
    """Return a file's text with other words at the first place of each."""
    for old, new in changes:
        assert old in text
        text = text.replace(old, new, 1)
    return text


def task_of(text: str) -> Task:
    """Return the task that a text without faults says."""
    task, faults = read_text(text, "t.toml")
    assert not faults
    assert task is not None
    return task
