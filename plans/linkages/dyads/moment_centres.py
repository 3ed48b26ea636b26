"""About which joint the moments of a whole RRR dyad are taken where its outer reactions would meet too flatly.

The plan of forces is closed by the parallels to AB and CB, which meet at the angle of the links. Where A and C stand
close together beside B, both links are nearly parallel. Moments of the whole group about C give the part of R_12 normal
to CA, so that the parallel to CA may take the place of that to CB, and it meets AB at the angle of the triangle ABC in
A; about A likewise at that in C. The largest of the three sines stands opposite to the longest side.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from ...boards.exact import SMALL
from ...laws import cross
from ..mechanism import Mechanism
from ..structure import Structure

TWICE = 2.0  # how much better another centre must be: it costs moments that else nobody needs


def with_moment_centres(mechanism: Mechanism, structure: Structure, values: Mapping[str, Any]) -> Mechanism:
    """Return the mechanism with a centre chosen for every RRR dyad that stands flat; itself where none does.

    Parameters
    ----------
    values : mapping of str to number
        Of a run of its construction in one position: the joints of all groups.
    """
    found = []
    for group in structure.groups:
        if group.kind == "RRR":
            A, C = (pair.point for pair in group.outer)
            centre = _centre(A, group.inner[0].point, C, values)
            found += [(group.name, centre)] if centre else []
    return replace(mechanism, centres=tuple(found)) if found else mechanism


def sines_of(a: complex, b: complex, c: complex) -> tuple[float, float, float]:
    """Return the sines of the angles of a triangle in A, B and C; NaN where two corners coincide."""
    doubled = abs(cross(b - a, c - a))
    sides = [abs(c - b), abs(a - c), abs(b - a)]
    product = sides[0] * sides[1] * sides[2]
    if not product > 0.0:
        return (float("nan"),) * 3
    first, second, third = (doubled * side / product for side in sides)
    return first, second, third


def _centre(A: str, B: str, C: str, values: Mapping[str, Any]) -> str | None:
    """Return the joint about which to take moments, None for the usual plan."""
    at_a, at_b, at_c = sines_of(*(complex(values[point]) for point in (A, B, C)))
    if at_b >= SMALL or not max(at_a, at_c) >= TWICE * at_b:
        return None
    return C if at_a >= at_c else A
