"""The answers over a blank, in a layer of their own that a file opens without."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace

from ..layers import Layer
from ..page import Page
from ..shapes import Group, Shape

ANSWER = "#0072B2"  # what the teacher's hand adds is blue


def keyed(page: Page, whole: Iterable[Group]) -> Page:
    """Return a begun page with a hidden layer of what `whole`, the views that stand there, have beyond it."""
    shown = {shape.name: shape for shape in page.shapes if isinstance(shape, Group) and shape.role == "view"}
    answers = (replace(view, shapes=tuple(_beyond(view, shown[view.name]))) for view in whole)
    hidden = (replace(view, layer=Layer.KEY.value) for view in answers if view.shapes)
    return replace(page, shapes=(*page.shapes, *hidden))


def _beyond(whole: Group, begun: Group) -> Iterator[Shape]:
    """Go through what a group has and its begun twin has not, in the teacher's colour."""
    shown = set(begun.shapes)
    twins = {(part.role, part.name): part for part in begun.shapes if isinstance(part, Group)}
    for part in whole.shapes:
        if part in shown:
            continue
        if isinstance(part, Group) and (twin := twins.get((part.role, part.name))) is not None:
            yield replace(part, shapes=tuple(_beyond(part, twin)))
        else:
            yield _inked(part)


def _inked(shape: Shape) -> Shape:
    if isinstance(shape, Group):
        return replace(shape, shapes=tuple(map(_inked, shape.shapes)))
    return replace(shape, colour=ANSWER)
