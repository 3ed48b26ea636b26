"""Why a mechanism has no structure: links that hang loose, that nothing holds, or that cannot move at all.

Source: Artobolevsky, Theory of mechanisms and machines: W = 3n - 2p_1 (Chebyshev), for the whole mechanism and for any
part of it. A part of k links with p pairs among them is rigid when 3(k - 1) - 2p = 0.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable
from itertools import combinations

from ...scales.errors import InputError
from .mechanism import FRAME, Mechanism, Pair

MANY = 12  # links from which on only the smallest parts are looked through


def no_structure(mechanism: Mechanism, mobility: int, left: Collection[int] = ()) -> InputError:
    """Return why `mechanism` of this mobility has no structure; the links `left` belong to no group."""
    numbers = [link.number for link in mechanism.links]
    data = {"w": mobility, "n": len(numbers), "p": len(mechanism.pairs)}
    loose = _loose(mechanism.pairs, numbers, mechanism.driver.link)
    if loose:
        return InputError("link-loose", link=loose[0], count=_count(mechanism.pairs, loose[0]), **data)
    apart = _apart(mechanism.pairs, numbers)
    if apart:
        return InputError("links-apart", links=_listed(apart), **data)
    rigid = _rigid(mechanism.pairs, numbers)
    if rigid:
        return InputError("links-rigid", links=_listed(rigid), **data)
    key = "no-group" if mobility == 1 else "links-free" if mobility > 1 and left else "mobility"
    return InputError(key, links=_listed(left), **data)


def _count(pairs: Iterable[Pair], number: int) -> int:
    return sum(number in pair.links for pair in pairs)


def _loose(pairs: Collection[Pair], numbers: Iterable[int], driver: int) -> list[int]:
    """Return the links with fewer than two pairs; a driver needs one with the frame alone if nothing follows it."""
    return [number for number in numbers if _count(pairs, number) < 2 and number != driver]


def _apart(pairs: Collection[Pair], numbers: Iterable[int]) -> list[int]:
    """Return the links from which no way leads over pairs to the frame."""
    held, found = {FRAME}, {FRAME}
    while found:
        found = {n for pair in pairs if held & {*pair.links} for n in pair.links} - held
        held |= found
    return [number for number in numbers if number not in held]


def _rigid(pairs: Collection[Pair], numbers: Collection[int]) -> tuple[int, ...]:
    """Return the fewest links, the frame among them or not, whose pairs let them not move against one another."""
    bodies = (FRAME, *numbers)
    for size in range(2, (len(bodies) if len(bodies) <= MANY else 3) + 1):
        for part in combinations(bodies, size):
            if 3 * (size - 1) <= 2 * sum({*pair.links} <= {*part} for pair in pairs):
                return part
    return ()


def _listed(numbers: Iterable[int]) -> str:
    return ", ".join(map(str, sorted(numbers)))
