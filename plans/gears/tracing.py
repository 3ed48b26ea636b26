"""Curves in a plane on which a function is zero, and where two of them cross.

Places are complex numbers. A function takes an array of them and returns real numbers, NaN where it is not defined.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..laws import cross

Array = NDArray[np.float64]
Places = NDArray[Any]  # complex
Function = Callable[[Any], Array]
Edge = int  # number of an edge of the grid
CHORDS = 14  # rounds, of which ten suffice
STILL = 1e-12  # part of an edge by which a place may still move when it has been found
NEWTON = 6  # steps, from places that are crossings of chords
MISSED = 0.5  # part of a chord by which two may miss each other
SAME = 1e-9  # places nearer than this are one
STEP = 1e-6  # of a difference quotient
ZERO = 1e-11  # what is left of both functions where two curves cross


def grid(low: complex, high: complex, cells: int) -> Places:
    """Return the places of a grid of `cells` times `cells`, shape (cells + 1, cells + 1): rows along the abscissa."""
    x, y = np.linspace(low.real, high.real, cells + 1), np.linspace(low.imag, high.imag, cells + 1)
    places: Places = x[:, np.newaxis] + 1j * y
    return places


def traced(function: Function, low: complex, high: complex, cells: int, known: Array | None = None) -> list[Places]:
    """Return the pieces of the curve in a window, longest first: each a run of places on it, closed if it is a loop.

    Every place is on an edge of the grid, put to the last digits there. `known` are the function's values on the grid.
    """
    places = grid(low, high, cells)
    values = function(places) if known is None else known
    numbers = np.arange(places.size).reshape(places.shape)
    on_edge: dict[Edge, complex] = {}
    for begin, end, beyond in (
        (np.s_[:-1, :], np.s_[1:, :], 0),
        (np.s_[:, :-1], np.s_[:, 1:], places.size),
    ):
        change = (values[begin] >= 0.0) != (values[end] >= 0.0)
        change &= np.isfinite(values[begin]) & np.isfinite(values[end])
        zeros = _zeros(function, places[begin][change], places[end][change])
        on_edge |= zip((numbers[begin][change] + beyond).tolist(), zeros.tolist(), strict=True)
    links = _links(on_edge.keys(), values)
    runs = (np.array([on_edge[edge] for edge in run]) for run in _runs(links))
    return sorted(runs, key=len, reverse=True)


def _zeros(function: Function, first: Places, last: Places) -> Places:
    """Return places between `first` and `last` at which the function changes its sign, by the Illinois rule.

    Chords are drawn between values of different sign; a value that stays is halved, so that both ends come near.
    """
    if not first.size:
        return first
    edges, old, new = np.abs(last - first), function(first), function(last)
    for _ in range(CHORDS):
        slope = new - old
        part = np.where(slope == 0.0, 0.0, new / np.where(slope == 0.0, 1.0, slope))
        middle = last - part * (last - first)
        value = function(middle)
        other = (value >= 0.0) != (new >= 0.0)
        first, old = np.where(other, last, first), np.where(other, new, 0.5 * old)
        still = np.abs(middle - last) <= STILL * edges
        last, new = middle, value
        if still.all():
            break
    return last


def _links(edges: Iterable[Edge], values: Array) -> dict[Edge, list[Edge]]:
    """Return which edges with zeros are neighbours on the curve: those of one cell, where it has two.

    Edges along the abscissa have the number of their first node, those along the ordinate begin after all of these. Of
    a cell with four zeros the mean of its corners tells which of them belong together.
    """
    rows, size = values.shape[1], values.size
    known, links = set(edges), {edge: list[Edge]() for edge in edges}
    cells = {edge % size for edge in known} | {edge - 1 for edge in known if edge < size}
    cells |= {edge - size - rows for edge in known if edge >= size}
    for n in sorted(cells):
        i, j = divmod(n, rows)
        if n < 0 or i + 1 >= values.shape[0] or j + 1 >= rows:
            continue
        crossed = [edge for edge in (n, size + n + rows, n + 1, size + n) if edge in known]  # all round
        if len(crossed) == 4 and (values[i : i + 2, j : j + 2].mean() >= 0.0) != (values[i, j] >= 0.0):
            crossed = crossed[1:] + crossed[:1]
        for a, b in zip(crossed[::2], crossed[1::2], strict=False):
            links[a].append(b)
            links[b].append(a)
    return links


def _runs(links: dict[Edge, list[Edge]]) -> Iterator[list[Edge]]:
    """Go through runs of linked edges: first those with ends, then loops, which end where they begin."""
    left = {edge: list(neighbours) for edge, neighbours in links.items()}
    ends = [edge for edge, neighbours in links.items() if len(neighbours) == 1]
    for start in (*ends, *links):
        if not left[start]:
            continue
        run = [start]
        while left[run[-1]]:
            following = left[run[-1]].pop()
            left[following].remove(run[-1])
            run.append(following)
        yield run


def near_crossings(first: Iterable[Places], second: Iterable[Places]) -> Places:
    """Return the places where chords of two curves cross, those that only just miss each other among them."""
    found = [_chords_cross(one, other) for one in first for other in second]
    return np.concatenate(found) if found else np.zeros(0, complex)


def _chords_cross(one: Places, other: Places) -> Places:
    p, u = (part[:, np.newaxis] + 0.0 * other[np.newaxis, 1:] for part in (one[:-1], np.diff(one)))
    q, w = (part[np.newaxis, :] + 0.0 * one[1:, np.newaxis] for part in (other[:-1], np.diff(other)))
    with np.errstate(divide="ignore", invalid="ignore"):
        sine = cross(u, w)
        along, across = cross(q - p, w) / sine, cross(q - p, u) / sine
    hit = (np.abs(along - 0.5) <= 0.5 + MISSED) & (np.abs(across - 0.5) <= 0.5 + MISSED)
    return np.asarray(p[hit] + u[hit] * along[hit])


def crossings(both: Callable[[Any], tuple[Array, Array]], starts: Places, reach: float) -> Places:
    """Return the places, each once, where two functions are zero, from starts not farther from them than `reach`.

    Newton's steps, from all starts at once; those that lead nowhere are left out.
    """
    places = starts.astype(complex)
    around = np.array([0.0, STEP, -STEP, 1j * STEP, -1j * STEP])
    for _ in range(NEWTON):
        f, g = both(places[:, np.newaxis] + around)
        (f_x, f_y), (g_x, g_y) = (((h[:, 1] - h[:, 2]), (h[:, 3] - h[:, 4])) for h in (f, g))
        determinant = f_x * g_y - f_y * g_x
        with np.errstate(divide="ignore", invalid="ignore"):
            x, y = (f[:, 0] * g_y - g[:, 0] * f_y) / determinant, (g[:, 0] * f_x - f[:, 0] * g_x) / determinant
        places = places - 2.0 * STEP * (x + 1j * y)
        near = np.abs(places - starts) <= reach  # also leaves out what is undefined
        places, starts = places[near], starts[near]
    f, g = both(places)
    found: list[complex] = []
    for place in places[(np.abs(f) < ZERO) & (np.abs(g) < ZERO)].tolist():
        if all(abs(place - other) > SAME for other in found):
            found.append(place)
    return np.array(found, complex)
