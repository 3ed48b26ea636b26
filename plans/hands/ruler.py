"""The ruler: the construction in which what is read is a whole number of half millimetres, and all else follows.

What is laid off is so long as it is calculated. What is shorter than a millimetre is read in a detail drawn larger, so
exactly.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from typing import Any

from ...scales.numbers import rounded
from ..boards.exact import ExactBoard
from ..laws import dot
from ..names import role
from .shaky import Paper

GRADUATION = 0.5  # mm between the marks of a ruler
SHORT = 1.0  # mm
READ = ("read", "measure", "distance")
WRITTEN = ("V", "a", "omega", "epsilon", "F", "M", "R", "G", "P", "m", "J")  # kinds of quantities
DIGITS = 4  # with which they are written down; balancing ones, which are compared, have one more
BALANCING = ("bal", "bal_lever")
LAID = ("lay", "back", "chain")


def read_by_ruler(mm: float) -> float:
    """Return a length on paper as it is read, mm."""
    return round(mm / GRADUATION) * GRADUATION if mm >= SHORT else mm


class RulerBoard(ExactBoard):
    """One position whose vectors, distances and arms are read off paper with a ruler."""

    def __init__(self, paper: Paper) -> None:
        super().__init__(paper.givens)
        self._mus = paper.mus
        self._steps = {step.name: step for step in paper.program}

    def operation(self, verb: str, law: str) -> Callable[..., Any]:
        """Return what does a step, with the ruler where it measures."""
        exact = super().operation(verb, law)
        if verb == "direction":
            return self._along
        if verb == "moment":
            return partial(self._by_arm, exact)
        if verb in READ:
            return partial(self._by_ruler, exact)
        return partial(self._rounded, exact) if verb == "calc" else exact

    def _rounded(self, found: Callable[..., Any], *operands: Any) -> Any:
        """Go on with the digits of a quantity that one writes down."""
        value, name = found(*operands), role(self._name)
        size = self._sqrt(dot(value, value))
        if name.kind == "arm":  # of a reaction about a point, measured before its size is known
            return value * self._share(size, self._operands[-1])
        if name.kind not in WRITTEN or not 0.0 < size < math.inf:
            return value
        decimals = DIGITS + (name.of in BALANCING) - 1 - math.floor(math.log10(size))
        return value * (rounded(size, decimals) / size)

    def _along(self, start: Any, end: Any, _: Any) -> Any:
        """Return the direction of a line, which is as it is drawn however long the line is read to be."""
        between = self._read(start, end)
        return between * (1.0 / self._sqrt(dot(between, between)))

    def _by_ruler(self, exact: Callable[..., Any], start: Any, end: Any) -> Any:
        """Read a vector, which keeps its direction, or a distance; what was laid off is known."""
        found, (first, second) = exact(start, end), self._operands
        step = self._steps.get(second)
        laid = step is not None and step.verb in LAID and step.operands[0] == first
        if laid or all(role(mark).hidden for mark in (first, second)):
            return found
        return found * self._share(self._sqrt(dot(found, found)), first)

    def _by_arm(self, exact: Callable[..., Any], force: Any, at: Any, about: Any) -> Any:
        """Read the arm of a force about a point."""
        moment, size = exact(force, at, about), self._sqrt(dot(force, force))
        return moment * self._share(abs(moment) / size, self._operands[2]) if size > 0.0 else moment

    def _share(self, length: float, mark: str) -> float:
        """Return by what a length on the plan of a mark is to be multiplied."""
        mm = length / self._mus[role(mark).plan]
        return read_by_ruler(mm) / mm if mm >= SHORT else 1.0
