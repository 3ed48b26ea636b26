"""Structure of a mechanism: mobility W, and Assur groups in order of attachment to the driver.

Source: Artobolevsky, Theory of mechanisms and machines: W = 3n - 2p_1 - p_2 (Chebyshev); a group has W = 0 and cannot
be split into smaller ones. Kinds of class II groups: 1 RRR, 2 RRP, 3 RPR, 4 PRP, 5 RPP.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import combinations

from ...scales.errors import InputError
from ..names import Name, scale_factor
from .joints import Joint, joints_of, pairs_of
from .mechanism import FRAME, Mechanism, Pair, Prismatic, Revolute
from .mobility import MANY, no_structure

TRIAD = "III"
KINDS = ("RRR", "RRP", "RPR", "PRP", "RPP")


@dataclass(frozen=True, slots=True)
class Group:
    """An Assur group: its links, its pairs within, its pairs with what came before.

    For a dyad `links` is (first, second), `inner` has one pair, `outer` that of the first link and that of the second,
    in the order of the letters of `kind`. A triad has its links by number, its pairs by the numbers of the legs.
    """

    links: tuple[int, ...]
    inner: tuple[Pair, ...]
    outer: tuple[Pair, ...]
    kind: str
    name: str = ""  # its links as a word: `23`, `12_13` (see `Mechanism.index`)

    @property
    def group_class(self) -> int:
        """Class by Artobolevsky: II for a dyad, III for a triad, IV for a closed contour of four links."""
        return 2 if len(self.links) == 2 else 4 if self.kind == "IV" else 3

    @property
    def order(self) -> int:
        """Order: the number of outer pairs."""
        return len(self.outer)

    @property
    def view(self) -> int | None:
        """Kind 1 to 5 of a class II group; of a triad its order, 3."""
        return self.order if self.kind == TRIAD else KINDS.index(self.kind) + 1 if self.kind in KINDS else None

    @property
    def central(self) -> int:
        """The link of a triad that its three inner pairs have in common."""
        return next(number for number in self.links if all(number in pair.links for pair in self.inner))

    @property
    def legs(self) -> tuple[int, ...]:
        """The other links of a triad."""
        return tuple(number for number in self.links if number != self.central)

    @property
    def joints(self) -> tuple[str, ...]:
        """Letters of its inner pairs."""
        return tuple(pair.point for pair in self.inner)

    def pin(self, pair: Pair) -> str:
        """Return the joint about which the moment of a pair's reaction is taken: its own, or the slider's."""
        if isinstance(pair, Revolute):
            return pair.point
        pins = [other for other in (*self.inner, *self.outer) if isinstance(other, Revolute)]
        own = (pin for number in pair.links if number in self.links for pin in pins if number in pin.links)
        return next(own, pins[0] if pins else pair).point

    @property
    def before(self) -> tuple[int, ...]:
        """The links before it to which its outer pairs join it."""
        return tuple(next(n for n in pair.links if n not in self.links) for pair in self.outer)


@dataclass(frozen=True, slots=True)
class Structure:
    """Numbers of the mobility formula and the groups in order of attachment."""

    moving: int
    lower: int
    higher: int
    mobility: int
    driver: int
    groups: tuple[Group, ...]

    @property
    def parts(self) -> dict[str, tuple[int, ...]]:
        """Links of the driver and of each group, by the name that its forces go by."""
        return {str(self.driver): (self.driver,), **{group.name: group.links for group in self.groups}}

    @property
    def scale_symbols(self) -> tuple[Name, ...]:
        """Symbols of the scale factors of its plans; the driver and each group have one for their forces."""
        forces = (scale_factor("F", part, links) for part, links in self.parts.items())
        return *map(scale_factor, ("l", "V", "a")), *forces


def letter(pair: Pair) -> str:
    """Return R for a revolute pair, P for a prismatic one."""
    return "R" if isinstance(pair, Revolute) else "P"


def analyse(mechanism: Mechanism) -> Structure:
    """Count the mobility and split the mechanism into its Assur groups.

    Raises
    ------
    InputError
        When W is not 1, links are left that form no group, or a joint has a pair too many.
    """
    joints = joints_of(mechanism.pairs)
    moving, lower = len(mechanism.links), len(mechanism.pairs)
    mobility = 3 * moving - 2 * lower
    if mobility != 1 and moving > MANY:
        raise no_structure(mechanism, mobility)
    known = [FRAME, mechanism.driver.link]
    left = [link.number for link in mechanism.links if link.number not in known]
    groups: list[Group] = []
    while left and (group := next(_groups(joints, known, left), None)):
        groups.append(replace(group, name=mechanism.index(*group.links)))
        known += group.links
        left = [number for number in left if number not in group.links]
    if mobility != 1 or left:
        raise no_structure(mechanism, mobility, left)
    return Structure(moving, lower, 0, mobility, mechanism.driver.link, tuple(groups))


def _groups(joints: tuple[Joint | Prismatic, ...], known: list[int], left: list[int]) -> Iterator[Group]:
    """Smallest sets of unknown links with 3/2 pairs a link, of equal ones first those with pairs that the task names.

    Of a joint that leads on to another unknown link, that link is no part of the group: it is attached later.
    """
    for size in range(2, len(left) + 1, 2):
        found = []
        for links in combinations(left, size):
            inner, outer, named = pairs_of(joints, links, known)
            if 2 * (len(inner) + len(outer)) == 3 * size and len({_within(p, links) for p in outer}) == len(outer) > 1:
                found.append((named, links, inner, outer))
        for _, links, inner, outer in sorted(found, key=lambda one: not one[0]):
            yield _dyad(links, inner, outer) if size == 2 else _of_four(links, inner, outer)


def _of_four(links: tuple[int, ...], inner: tuple[Pair, ...], outer: tuple[Pair, ...]) -> Group:
    """Tell III, a triad, from IV, a closed contour of four links, and from larger groups, `?`."""
    links, size = tuple(sorted(links)), (len(links), len(outer))
    centres = [number for number in links if all(number in pair.links for pair in inner)]
    if size != (4, 3) or not centres:
        return Group(links, inner, outer, "IV" if size == (4, 2) else "?")
    legs = [number for number in links if number != centres[0]]
    by_leg = [next(pair for pair in pairs if number in pair.links) for pairs in (inner, outer) for number in legs]
    return Group(links, tuple(by_leg[:3]), tuple(by_leg[3:]), TRIAD)


def _within(pair: Pair, links: tuple[int, ...]) -> int:
    return next(number for number in pair.links if number in links)


def _dyad(links: tuple[int, ...], inner: tuple[Pair, ...], outer: tuple[Pair, ...]) -> Group:
    """Order the two links so that the letters read as one of the five kinds; by number where both orders do."""
    links = tuple(sorted(links))
    by_link = {_within(pair, links): pair for pair in outer}
    for first, second in (links, links[::-1]):
        pairs = (by_link[first], inner[0], by_link[second])
        kind = "".join(map(letter, pairs))
        if kind in KINDS:
            return Group((first, second), inner, (pairs[0], pairs[2]), kind)
    raise InputError("no-revolute", links=", ".join(map(str, links)))
