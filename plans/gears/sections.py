"""Sections of a gear pair's quantities, in the order of the student's note: what a list of them is divided into."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache

from ..calculated import calculated
from ..names import role
from .geometry import SIZES

# of the calculated quantities, each the steps of one part of the geometry
CALCULATED = ("sizes", "centres", "auxiliary", "quality", "engagement", "measures")
DRAWN, SLIDING = "drawn", "sliding"
SECTIONS = (*CALCULATED, DRAWN, SLIDING)
FOUND = ("x_1", "x_2")  # where others are given
OF_DIAGRAMS = ("PW", "mu_rho", "mu_theta")


@cache
def _calculated() -> Mapping[str, str]:
    """Return the section of every calculated quantity."""
    parts = {section: (part,) for section, part in zip(CALCULATED, SIZES, strict=True)}
    return dict.fromkeys(FOUND, CALCULATED[0]) | calculated(parts)


def section_of(name: str) -> str:
    """Return the section of a quantity, of `SECTIONS`: what is not calculated is drawn, and of sliding what has points.

    >>> section_of("d_a1"), section_of("g_alpha_drawn"), section_of("theta_12_03")
    ('sizes', 'drawn', 'sliding')
    """
    known = _calculated().get(name)
    if known is not None:
        return known
    return SLIDING if role(name).kind in ("y", "theta") or name in OF_DIAGRAMS else DRAWN


def place_of(name: str) -> int:
    """Return the place of a quantity's section among all."""
    return SECTIONS.index(section_of(name))
