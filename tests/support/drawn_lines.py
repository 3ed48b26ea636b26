"""Bare lines of sheets, as a student's CAD would hold them: no names, distorted at random; mistakes drawn in them."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np

from kulman import sheet, solve
from kulman.drawing.shapes import Arc, Arrow, Group, Line, Polyline, Shape, Vector, sides_of
from kulman.plans.hands.shaky import paper_of, preset
from kulman.plans.marking.key import Key, answer_key
from kulman.plans.marking.lines import Drawn, Letter
from kulman.plans.marking.ways import _changed_edges, edges_of
from kulman.plans.mistakes.book import Book, Signature, book
from kulman.plans.names import POINT, role

APART = 20.0  # mm between pages
PAST = 10.0  # mm by which construction lines run on
SPLIT, DOUBLED, LEAST = 0.4, 0.3, 5.0  # parts of the lines; mm
Segment = tuple[complex, complex, str, bool]  # with the view in which it is drawn, and whether it is an arrow
Place = tuple[complex, complex]
Text = tuple[str, complex, str]  # a letter, where it stands, and in which view
HEIGHT = 3.5  # mm of letters


@dataclass(frozen=True, slots=True)
class Bare:
    """All lines of a sheet; `vectors` are those of plans, by plan and quantity."""

    segments: tuple[Segment, ...]
    vectors: dict[tuple[str, str], Place]
    key: Key
    book: Book


@cache
def bare(task: str, variant: str | None = None) -> Bare:
    """Return the lines of the sheet of a variant, its pages side by side."""
    drawn, solved = sheet(task, variant), solve(task, variant).solved
    segments, vectors, left = list[Segment](), dict[tuple[str, str], Place](), 0.0
    for page in drawn.pages:
        for shape, views in _shapes(page.shapes, ()):
            view = views[0] if views else ""
            match shape:
                case Line() | Polyline() | Arc():
                    segments += [(a + left, b + left, view, False) for a, b in sides_of(shape)]
                case Vector(tail=tail, tip=tip) | Arrow(tail=tail, tip=tip):
                    segments.append((tail + left, tip + left, view, True))
            scale = drawn.scales.get(view)
            if isinstance(shape, Vector) and scale is not None and math.isclose(shape.mu, scale.mu):
                vectors[view, shape.quantity] = (shape.tail + left, shape.tip + left)
        left += page.width + APART
    paper = paper_of(solved, {scale.symbol: scale.mu for scale in drawn.scales.values()})
    key = answer_key(paper, preset("normal").tolerance)
    return Bare(tuple(segments), vectors, key, book(key))


def _shapes(shapes: tuple[Shape, ...], views: tuple[str, ...]) -> Iterator[tuple[Shape, tuple[str, ...]]]:
    for shape in shapes:
        if isinstance(shape, Group):
            yield from _shapes(shape.shapes, (*views, shape.name) if shape.role == "view" else views)
        else:
            yield shape, views


@dataclass(frozen=True, slots=True)
class Distorted:
    """A drawing, and where each view of it has been put."""

    drawn: Drawn
    moved: dict[str, complex]
    turn: complex
    shift: complex
    times: float

    def place(self, point: complex, view: str) -> complex:
        """Return where a point of a view is."""
        return (point + self.moved[view]) * self.turn * self.times + self.shift


def distorted(
    segments: tuple[Segment, ...],
    random: Any,
    noise: float = 0.1,
    stray: int = 200,
    times: float = 1.0,
    arrowheads: bool = True,
    letters: Iterable[Text] = (),
) -> Distorted:
    """Turn a sheet by 90 degrees, shift it and its views, split and double lines, add stray ones, draw badly."""
    views = sorted({view for _, _, view, _ in segments})
    moved = {view: complex(*random.uniform(-3.0, 3.0, 2)) if view else 0j for view in views}
    lines, pointed = [], []
    for a, b, view, arrow in segments:
        a, b = a + moved[view], b + moved[view]
        split = abs(b - a) > LEAST and random.random() < SPLIT
        middle = a + (b - a) * random.uniform(0.2, 0.8)
        lines += [(a, middle), (middle, b)] if split else [(a, b)]
        pointed += [False, arrow] if split else [arrow]
        if random.random() < DOUBLED:
            lines.append((a, b) if random.random() < 0.5 else (b, a))
            pointed.append(False)
    ends = np.array(lines)
    low, high = complex(ends.real.min(), ends.imag.min()), complex(ends.real.max(), ends.imag.max())
    begin = random.uniform(low.real, high.real, stray) + 1j * random.uniform(low.imag, high.imag, stray)
    end = begin + random.uniform(3.0, 120.0, stray) * np.exp(1j * random.uniform(0.0, math.tau, stray))
    ends = np.concatenate((ends, np.stack((begin, end), -1)))
    order = random.permutation(len(ends))
    ends = ends[order]
    arrows = np.flatnonzero(np.append(pointed, np.zeros(stray, bool))[order]) if arrowheads else np.zeros(0, np.intp)
    off = noise * np.sqrt(random.uniform(0.0, 1.0, ends.shape)) * np.exp(1j * random.uniform(0.0, math.tau, ends.shape))
    turn, shift = 1j, complex(*random.uniform(-200.0, 200.0, 2))
    ends = ends * turn * times + shift + off
    texts = tuple(Letter(text, (at + moved[view]) * turn * times + shift, HEIGHT * times) for text, at, view in letters)
    return Distorted(Drawn(ends[:, 0], ends[:, 1], texts, arrows), moved, turn, shift, times)


def with_mistake(
    sheet: Bare, wrong: Signature, random: Any
) -> tuple[tuple[Segment, ...], dict[str, tuple[str, Place]]]:
    """Return the lines of a sheet whose plans are drawn with a rule broken, and the vectors: plan, tail and tip."""
    paper, program = sheet.key.paper, wrong.broken.program
    lines = [line for line in sheet.segments if line[2] not in paper.program.plans]
    vectors: dict[str, tuple[str, Place]] = {}
    for plan in paper.program.plans:
        places = [place for (view, _), place in sheet.vectors.items() if view == plan]
        if not places or plan == "position":
            continue
        pole, mu = places[0][0] + complex(*random.uniform(-20.0, 20.0, 2)), paper.mus[plan]
        at = {n: pole + x / mu for n, x in wrong.values.items() if isinstance(x, complex) and cmath.isfinite(x)}
        own = [
            (s.name if s.verb == "read" else s.operands[1], s) for s in program.on(plan) if s.verb in ("read", "chain")
        ]
        for name, step in own:
            tail, tip = step.operands if step.verb == "read" else (step.operands[0], step.name)
            if tail in at and tip in at and abs(at[tip] - at[tail]) > 1e-6:
                lines.append((at[tail], at[tip], plan, True))
                vectors.setdefault(name, (plan, (at[tail], at[tip])))
        for step in program.on(plan):
            for start in step.operands[::2] if step.verb == "meet" else ():
                if abs(way := at[step.name] - at[start]) > 1e-6:
                    lines.append((at[start], at[step.name] + PAST * way / abs(way), plan, False))
    return tuple(lines), vectors


def lettered(sheet: Bare, wrong: Signature, vectors: Mapping[str, tuple[str, Place]], random: Any) -> Iterator[Text]:
    """Go through the letters at the points of velocity and acceleration plans drawn with a rule broken."""
    seen = set[str]()
    for plan in ("velocity", "acceleration"):
        for name, tail, tip in _changed_edges(edges_of(sheet.key.paper.program, plan), wrong.broken.program, plan):
            if name in vectors and vectors[name][0] == plan:
                for mark, at in zip((tail, tip), vectors[name][1], strict=True):
                    if mark not in seen and role(mark).kind == POINT:
                        seen.add(mark)
                        away = random.uniform(0.8, 1.5) * HEIGHT * np.exp(1j * random.uniform(0.0, math.tau))
                        yield role(mark).of.lower(), at + complex(away), plan
