"""Sections of a hoist's quantities, in the order of the student's note: what a list of them is divided into."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache

from ..calculated import calculated
from .lift_off import lifting_off, reduced
from .model import circle, extremes, lifted, printed, strength, suspended

DRAWN = "drawn"
PARTS = {
    "reduced": (reduced,),
    "resting": (lifting_off, extremes),
    "hanging": (circle, suspended, lifted),
    "strength": (strength,),
    "printed": (printed,),
}
SECTIONS = (*PARTS, DRAWN)


@cache
def _calculated() -> Mapping[str, str]:
    """Return the section of every calculated quantity."""
    return calculated(PARTS)


def section_of(name: str) -> str:
    """Return the section of a quantity, of `SECTIONS`: what is not calculated is drawn.

    >>> section_of("C_12"), section_of("t_1"), section_of("T_1"), section_of("t_1_drawn")
    ('reduced', 'resting', 'hanging', 'drawn')
    """
    return _calculated().get(name, DRAWN)


def place_of(name: str) -> int:
    """Return the place of a quantity's section among all."""
    return SECTIONS.index(section_of(name))
