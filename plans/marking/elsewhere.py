"""A right plan of which points are elsewhere than they should be, by no mistake that is known: as far as lines tell.

One long vector is where it should be. From its ends lines lead on: each further point is where the line should end that
leads there, else where as many of its lines meet as lead there, the nearest such place or one that has its letter.
"""

from __future__ import annotations

import math
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import permutations

import numpy as np

from ..laws import cross
from .laying import BY, GENERATOR, SHORT, Fit, Laying
from .lines import Complex, Indices
from .ways import Shape

ANCHORS = 24  # ways to lay a plan of which it is seen how its lines lead on
MOVED = 0.5  # part of the longest line that leads to a point by which it may be elsewhere
BEGUN = 3.0  # mm from a printed pole where a plan is laid that begins there
LACKS = 0.2  # part of it, what it costs that a line lacks, or goes on beyond its point


def elsewhere(laying: Laying, shape: Shape, turn: float, pole: complex | None = None) -> Fit | None:
    """Return where a shape fits best on a sheet turned so, at its usual size, with its points where lines lead.

    If its `pole` is printed, only those count that begin there.
    """
    (laid,) = laying.lay_all([shape], turn, math.inf, usually=True)
    if pole is not None:
        here = np.abs(laid.origins - pole) <= BEGUN
        laid = laid._replace(origins=laid.origins[here], factors=laid.factors[here], nodes=laid.nodes[here])
    tails, tips = shape.tails[shape.lines], shape.tips[shape.lines]
    there = laying.lines.joined(laid.nodes[:, tails], laid.nodes[:, tips])
    right = (there * shape.weights * (np.abs(shape.spans) >= GENERATOR * shape.longest)).sum(axis=1)
    fits = dict[bytes, Fit]()
    for at in np.argsort(-right, kind="stable")[:ANCHORS].tolist():
        origin, factor = complex(laid.origins[at]), complex(laid.factors[at])
        led = _Led(laying, shape, origin, factor)
        if right[at] and led.nodes.tobytes() not in fits:
            places = np.where(led.nodes >= 0, (laying.lines.nodes[led.nodes] - origin) / factor, shape.places)
            (fit,) = laying.settled(replace(shape, places=places), np.array([origin]), np.array([factor]))
            off = float(np.abs(places - shape.places).max()) / shape.longest
            fits[led.nodes.tobytes()] = replace(fit, worth=fit.worth - off)
    return max(fits.values(), key=lambda fit: fit.worth, default=None)


@dataclass(eq=False)
class _Led:
    """The nodes of the marks of a shape to which lines lead from where it is right."""

    laying: Laying
    shape: Shape
    origin: complex
    factor: complex

    @cached_property
    def around(self) -> Mapping[int, list[int]]:
        """The marks to which lines go out from each, but for those too short to be seen."""
        shape, found = self.shape, defaultdict[int, list[int]](list)
        long = shape.lines[np.abs(shape.spans * self.factor) >= SHORT]
        for one, other in zip(shape.tails[long].tolist(), shape.tips[long].tolist(), strict=True):
            found[one].append(other)
            found[other].append(one)
        return found

    @cached_property
    def nodes(self) -> Indices:
        """The nodes, -1 where none is: those that are right and hang together, then one after the other the next."""
        right = self.laying.nodes_of(self.origin + self.factor * self.shape.places)
        joined = (
            (one, other) for one in self.around for other in self.around[one] if self._ends(right[one], right[other])
        )
        kept = np.isin(np.arange(len(right)), [*_together(joined)])
        nodes = np.where(kept, right, -1)
        while options := [way for mark in self.around if nodes[mark] < 0 for way in self._options(nodes, mark)]:
            _, mark, node = min(options)
            nodes[mark] = node
        return nodes

    def _ends(self, node: int, other: int) -> bool:
        """Whether a line from a node ends at another."""
        return node >= 0 <= other and bool(np.isin(other, self.laying.lines.joined_to(int(node))))

    def _options(self, nodes: Indices, mark: int) -> Iterator[tuple[float, int, int]]:
        """Go through the nodes that a mark may be, with what each costs, mm."""
        around, at = [other for other in self.around[mark] if nodes[other] >= 0], self.laying.lines.nodes
        if not around:
            return
        wanted = at[nodes[around]] + self.factor * (self.shape.places[mark] - self.shape.places[around])
        for node, end in zip(self.laying.nodes_of(wanted).tolist(), nodes[around].tolist(), strict=True):
            if self._ends(end, node):  # as it should be from there
                yield 0.0, mark, node
                return
        if len(around) > 1:
            yield from ((cost, mark, node) for cost, node in self._met(nodes, mark, nodes[around], wanted))
            return
        longest, places = self.shape.longest * abs(self.factor), np.array([*self._carried(nodes, mark)], complex)
        for place, node in zip(places.tolist(), self.laying.nodes_of(places).tolist(), strict=True):
            if node not in nodes and self._ends(int(nodes[around[0]]), node):
                yield longest + abs(at[node] - place), mark, node

    def _met(self, nodes: Indices, mark: int, ends: Indices, wanted: Complex) -> Iterator[tuple[float, int]]:
        """Go through the nodes where lines from several ends meet, with what each costs."""
        at, lines = self.laying.lines.nodes, self.laying.lines
        longest = float(np.abs(at[ends] - wanted).max())  # of its lines
        met = Counter(node for end in ends.tolist() for node in lines.joined_to(end).tolist())
        for node, count in met.items():
            place = complex(at[node])
            if count > 1 and node not in nodes and not _between(at[ends], place, complex(wanted[0])):
                off, named = float(np.abs(place - wanted).mean()), self._named(mark, place)
                lacks = len(ends) - count + int(lines.go_on(ends, np.full(len(ends), node)).sum())
                if named or off <= MOVED * longest:
                    yield off * (not named) + LACKS * longest * lacks, node

    def _carried(self, nodes: Indices, mark: int) -> Iterator[complex]:
        """Go through the places of a mark as it lies to two others: such are points of a link."""
        at, places = self.laying.lines.nodes, self.shape.places
        for one, other in permutations(np.flatnonzero(nodes >= 0).tolist(), 2):
            span = places[other] - places[one]
            if abs(span * self.factor) > SHORT:
                yield at[nodes[one]] + (places[mark] - places[one]) / span * (at[nodes[other]] - at[nodes[one]])

    def _named(self, mark: int, place: complex) -> bool:
        """Whether the letter of a mark stands at a place."""
        letters = self.laying.letters.get(self.shape.letters[mark], ())
        return any(abs(place - at) < BY * height for at, height in letters)


def _between(ends: Complex, place: complex, wanted: complex) -> bool:
    """Whether a place is on the line of two ends, where it should not be."""
    way = complex(ends[1] - ends[0])
    aside, right = (abs(cross(way, one - complex(ends[0]))) for one in (place, wanted))
    return bool(aside < SHORT * abs(way) <= right)


def _together(pairs: Iterable[tuple[int, int]]) -> set[int]:
    """Return the largest group of marks that pairs join."""
    groups = list[set[int]]()
    for pair in pairs:
        own = [group for group in groups if not group.isdisjoint(pair)]
        groups = [*(group for group in groups if group not in own), set(pair).union(*own)]
    return max(groups, key=len, default=set())
