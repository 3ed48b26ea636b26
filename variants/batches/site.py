"""A site of pages that move: one for each variant of some tasks, with an index, for a department's server."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from html import escape
from importlib.resources import files
from pathlib import Path
from typing import NamedTuple

from ...drawing.writers import folder_for, slug, write_whole
from ...scales.errors import InputError, KulmanError
from ...scales.packaged import packaged
from ..case import Request
from ..crew import Advance, shared_out
from ..reader import load_task
from ..sheets import page_of
from ..shelf import bundled
from ..task import AnyTask, Task

MOST = 1000  # pages of a site: at 150 kB each they are 150 MB at most
INDEX = "index.html"


class _Item(NamedTuple):
    """A page of a site: its task, its variant, where it stands from the index."""

    task: Task
    variant: str
    place: str


@dataclass(frozen=True, slots=True)
class _Site:
    """A site that has been written: its index, how many pages it has, and why some variants have none, a line each."""

    index: Path
    pages: int
    problems: tuple[str, ...]


def site(
    folder: str | os.PathLike[str],
    tasks: Sequence[AnyTask] = (),
    *,
    lang: str = "uk",
    jobs: int | None = None,
    advance: Advance = lambda done, whole: None,
) -> _Site:
    """Write a page for every variant of some tasks into a folder, and an index that leads to them.

    Every page is written whole and at last the index, which lists what has been written; pages of the same name are
    replaced, other files stay.

    Parameters
    ----------
    folder : str or PathLike
        It is made where it is missing. A task has a folder in it.
    tasks : sequence of str, PathLike or Task
        Ids or task files; all that are bundled where none is said.
    lang : {"uk", "ru", "en"}
        Language of pages and index.
    jobs : int, optional
        Processes; by default as many as there are cores.
    advance : callable
        Told how many more pages are done, and of how many.

    Raises
    ------
    InputError
        As `load_task`; more than 1000 pages; a folder that cannot be made, a file that cannot be written.
    """
    items = _items([load_task(task) for task in tasks or bundled()])
    if len(items) > MOST:
        raise InputError("site-pages", n=len(items), most=MOST)
    root, words = folder_for(folder), packaged(__package__, "texts", lang)
    for place in dict.fromkeys(Path(item.place).parent for item in items):
        folder_for(root / place)
    problems: dict[int, str] = {}
    begin = partial(_begin, root, lang)
    for done in shared_out(begin, items, jobs or os.cpu_count() or 1, alike=lambda item: item.task.id):
        for at, problem in done:
            if problem is None or problem:
                problems[at] = problem or words["site.died"]
        advance(len(done), len(items))
    made = [(item, problems.get(at, "")) for at, item in enumerate(items)]
    write_whole(root / INDEX, _index(made, lang).encode("utf-8"))
    said = tuple(f"{item.task.id} {item.variant}: {problem}" for item, problem in made if problem)
    return _Site(root / INDEX, len(items) - len(said), said)


def _items(tasks: Sequence[Task]) -> list[_Item]:
    """Return the pages of tasks; of names that would be one file each has a number."""
    items, taken = list[_Item](), set[str]()

    def free(name: str) -> str:
        found, number = name, 1
        while found.casefold() in taken:
            number += 1
            found = f"{name}-{number}"
        taken.add(found.casefold())
        return found

    for task in tasks:
        folder = free(slug(task.id))
        items += [_Item(task, name, free(f"{folder}/{slug(name)}") + ".html") for name in task.variants]
    return items


def _begin(root: Path, lang: str) -> Callable[[_Item], str]:
    """Return what writes a page, and says why there is none."""

    def make(item: _Item) -> str:
        try:
            page = page_of(Request(item.task, item.variant, language=lang).case())
        except KulmanError as error:
            return error.text(lang)
        write_whole(root / item.place, page.encode("utf-8"))
        return ""

    return make


def _index(made: Sequence[tuple[_Item, str]], lang: str) -> str:
    """Return the page that leads to all others."""
    words, parts = packaged(__package__, "texts", lang), list[str]()
    for task in dict.fromkeys(item.task.id for item, _ in made):
        own = [(item, problem) for item, problem in made if item.task.id == task]
        links = "".join(
            f"<li>{escape(item.variant)}: {escape(problem)}</li>"
            if problem
            else f'<li><a href="{escape(item.place)}">{escape(item.variant)}</a></li>'
            for item, problem in own
        )
        title = escape(own[0][0].task.title[lang])
        parts.append(f"<section><h2>{title}</h2><p>{escape(task)}</p><ul>{links}</ul></section>")
    text = files("kulman.drawing.moving").joinpath("site.html").read_text("utf-8")
    said = {"lang": lang, "title": words["site.title"], "about": words["site.about"], "tasks": "\n".join(parts)}
    for key, part in said.items():
        text = text.replace(f"{{{{{key}}}}}", part)
    return text
