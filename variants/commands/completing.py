"""What a shell offers when TAB is pressed: tasks, variants, plans, quantities, charts, kinds of files, guides."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping
from importlib import import_module
from typing import TYPE_CHECKING, Any

import click

from ...scales.errors import KulmanError, system_language

if TYPE_CHECKING:
    from click.shell_completion import CompletionItem

Source = Callable[[click.Context], Iterable[str]]  # of what is typed so far: names, or names with what they mean
Completer = Callable[[click.Context, click.Parameter, str], "list[CompletionItem[str]]"]


def item(value: str, type: str = "plain", help: str | None = None) -> CompletionItem[str]:
    """Return one thing that is offered; click's part for shells is imported when a shell asks."""
    from click.shell_completion import CompletionItem

    return CompletionItem(value, type, help)


def files(ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem[str]]:
    """Let the shell complete a file."""
    return [item(incomplete, "dir" if param.metavar == "FOLDER" else "file")]


def completing(source: Source, with_files: bool = False) -> Completer:
    """Return what completes a name, the last one of several with commas between; also a file where that may stand."""

    def complete(ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem[str]]:
        before, comma, begun = incomplete.rpartition(",")
        try:
            names = source(ctx)
        except KulmanError:  # of a task that is not there, or has no plan: nothing can be offered
            names = ()
        told = names if isinstance(names, Mapping) else {}
        offered = [item(f"{before}{comma}{name}", help=told.get(name)) for name in names if name.startswith(begun)]
        return [*([item(incomplete, "file")] if with_files else []), *offered]

    return complete


def suffixed(module: str, package: str) -> Completer:
    """Return what completes a file: with the suffixes of a module, which `SUFFIXES` of it says; also one there is."""

    def complete(ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem[str]]:
        if not os.path.basename(incomplete):
            return files(ctx, param, incomplete)
        name, begun = os.path.splitext(incomplete)
        known: Iterable[str] = import_module(module, package).SUFFIXES
        return [item(f"{name}{suffix}") for suffix in known if suffix.startswith(begun)]

    return complete


def tasks(ctx: click.Context) -> Mapping[str, str]:
    """Return the bundled tasks with their titles."""
    from ..shelf import bundled, summary

    return {task: summary(task)["title"][system_language()] for task in bundled()}


def _task(ctx: click.Context) -> Any:
    """Return the task that stands before, in an argument; what is left unparsed where an option has no value yet."""
    from ..reader import load_task

    named = ctx.params.get("task") or ctx.params.get("tasks") or next(iter(ctx.args), "")
    return load_task(named if isinstance(named, str) else named[0])


def variants(ctx: click.Context) -> Iterable[str]:
    """Return the variants of the task."""
    return [*_task(ctx).variants]


def plans(ctx: click.Context) -> Iterable[str]:
    """Return the plans of the task."""
    plans: Iterable[str] = _task(ctx).plans
    return plans


def quantities(ctx: click.Context) -> Iterable[str]:
    """Return the quantities of the task, in order of construction."""
    from ..solution import solve

    return solve(_task(ctx))


def charts(ctx: click.Context) -> Iterable[str]:
    """Return the charts that the task can have."""
    from ..case import beside

    names: Iterable[str] = beside(_task(ctx), "charts").CHARTS
    return names


def notations(ctx: click.Context) -> Iterable[str]:
    """Return the schools whose letters are known."""
    from ...drawing.words import notations as known

    return known()


def topics(ctx: click.Context) -> Mapping[str, str]:
    """Return the guides with their headings."""
    from ..shelf import guides

    return guides(system_language())
