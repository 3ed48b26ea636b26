"""Structure of a mechanism: mobility W, and Assur groups in order of attachment to the driver; or why there is none.

A joint of three links counts as two pairs, and it does not matter which two of the three a task names: the structure
takes the named ones where it can, and others where only those make dyads.

Source: Artobolevsky, Theory of mechanisms and machines: W = 3n - 2p_1 - p_2 (Chebyshev), for the whole mechanism and
for any part of it: a part of k links with p pairs among them is rigid when 3(k - 1) - 2p = 0. A group has W = 0 and
cannot be split into smaller ones. Kinds of class II groups: 1 RRR, 2 RRP, 3 RPR, 4 PRP, 5 RPP.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import combinations

from ...scales.errors import InputError
from .mechanism import FRAME, Mechanism, Pair, Prismatic, Revolute

TRIAD = "III"
KINDS = ("RRR", "RRP", "RPR", "PRP", "RPP")
MANY = 12  # links from which on only the smallest rigid parts are looked for


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


@dataclass(frozen=True, slots=True)
class _Joint:
    """The links on one pin, and the revolute pairs that the task names of them."""

    point: str
    links: tuple[int, ...]
    named: tuple[Revolute, ...]

    def pair(self, first: int, second: int) -> Revolute:
        """Return the pair of two of its links; place and branch are those of the joint, whichever pair states them."""
        own = [pair for pair in self.named if {*pair.links} == {first, second}]
        at = next((pair.at for pair in self.named if pair.at), None) if FRAME in (first, second) else None
        branch = next((pair.branch for pair in (*own, *self.named) if pair.branch), None)
        return Revolute(self.point, own[0].links if own else (first, second), at, branch)

    def names(self, pair: Pair) -> bool:
        """Whether the task names this pair."""
        return any({*pair.links} == {*named.links} for named in self.named)

    def tree(self, links: Collection[int]) -> list[Pair]:
        """Return the pairs that hold `links` together, one less than there are links, named ones first."""
        own = [number for number in self.links if number in links]
        held, tree = [{number} for number in own], list[Pair]()
        for pair in self._named_first(combinations(own, 2)):
            parts = [part for part in held if part & {*pair.links}]
            if len(parts) == 2:
                tree.append(pair)
                held = [part for part in held if part not in parts] + [parts[0] | parts[1]]
        return tree

    def ties(self, links: Collection[int], known: Sequence[int]) -> list[Pair]:
        """Return the pair that holds `links` to one of the `known`: a named one, else to the first of these."""
        here = [own for own in links if own in self.links]
        ways = ((own, other) for other in known if other in self.links for own in here)
        return [*self._named_first(ways)[:1]]

    def _named_first(self, ways: Iterable[tuple[int, int]]) -> list[Revolute]:
        return sorted((self.pair(*way) for way in ways), key=lambda pair: not self.names(pair))


def _joints_of(pairs: Iterable[Pair]) -> tuple[_Joint | Prismatic, ...]:
    """Collect revolute pairs with one letter that have links in common; prismatic pairs stay among them.

    Raises InputError: when a joint of three links or more is given a pair too many.
    """
    joints: list[_Joint | Prismatic] = []
    for pair in pairs:
        if isinstance(pair, Prismatic):
            joints.append(pair)
            continue
        one = _Joint(pair.point, pair.links, (pair,))
        touching = [j for j in joints if isinstance(j, _Joint) and j.point == one.point and {*j.links} & {*one.links}]
        place = joints.index(touching[0]) if touching else len(joints)
        for joint in touching:
            joints.remove(joint)
            one = _Joint(one.point, tuple(dict.fromkeys((*joint.links, *one.links))), (*joint.named, *one.named))
        joints.insert(place, one)
    for made in joints:
        if isinstance(made, _Joint) and len(made.named) >= len(made.links) > 2:
            raise InputError("joint-closed", point=made.point, links=listed(made.links), n=len(made.links) - 1)
    return tuple(joints)


def _pairs_of(
    joints: Iterable[_Joint | Prismatic], links: Collection[int], known: Sequence[int]
) -> tuple[tuple[Pair, ...], tuple[Pair, ...], bool]:
    """Return the pairs of `links` among themselves, those with `known` ones, and whether the task names all of them."""
    inner, outer, named = list[Pair](), list[Pair](), True
    for joint in (joint for joint in joints if {*joint.links} & {*links}):
        if isinstance(joint, _Joint):
            tree, ties = joint.tree(links), joint.ties(links, known)
            named = named and all(map(joint.names, (*tree, *ties)))
            inner += tree
            outer += ties
        elif {*joint.links} <= {*links}:
            inner.append(joint)
        elif {*joint.links} & {*known}:
            outer.append(joint)
    return tuple(inner), tuple(outer), named


def analyse(mechanism: Mechanism) -> Structure:
    """Count the mobility and split the mechanism into its Assur groups.

    Raises InputError: when W is not 1, links are left that form no group, or a joint has a pair too many.
    """
    joints = _joints_of(mechanism.pairs)
    moving, lower = len(mechanism.links), len(mechanism.pairs)
    mobility = 3 * moving - 2 * lower
    if mobility != 1 and moving > MANY:
        raise _no_structure(mechanism, mobility)
    known = [FRAME, mechanism.driver.link]
    left = [link.number for link in mechanism.links if link.number not in known]
    groups: list[Group] = []
    while left and (group := next(_groups(joints, known, left), None)):
        groups.append(replace(group, name=mechanism.index(*group.links)))
        known += group.links
        left = [number for number in left if number not in group.links]
    if mobility != 1 or left:
        raise _no_structure(mechanism, mobility, left)
    return Structure(moving, lower, 0, mobility, mechanism.driver.link, tuple(groups))


def _groups(joints: tuple[_Joint | Prismatic, ...], known: list[int], left: list[int]) -> Iterator[Group]:
    """Smallest sets of unknown links with 3/2 pairs a link, of equal ones first those with pairs that the task names.

    Of a joint that leads on to another unknown link, that link is no part of the group: it is attached later.
    """
    for size in range(2, len(left) + 1, 2):
        found = []
        for links in combinations(left, size):
            inner, outer, named = _pairs_of(joints, links, known)
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
        kind = "".join("R" if isinstance(pair, Revolute) else "P" for pair in pairs)
        if kind in KINDS:
            return Group((first, second), inner, (pairs[0], pairs[2]), kind)
    raise InputError("no-revolute", links=listed(links))


def _no_structure(mechanism: Mechanism, mobility: int, left: Collection[int] = ()) -> InputError:
    """Return why `mechanism` of this mobility has no structure; the links `left` belong to no group."""
    numbers = [link.number for link in mechanism.links]
    data = {"w": mobility, "n": len(numbers), "p": len(mechanism.pairs)}
    for number in numbers:  # a driver needs one pair with the frame alone if nothing follows it
        count = sum(number in pair.links for pair in mechanism.pairs)
        if count < 2 and number != mechanism.driver.link:
            return InputError("link-loose", link=number, count=count, **data)
    held, reached = {FRAME}, {FRAME}  # links to which a way leads over pairs from the frame
    while reached:
        reached = {n for pair in mechanism.pairs if held & {*pair.links} for n in pair.links} - held
        held |= reached
    if apart := {*numbers} - held:
        return InputError("links-apart", links=listed(apart), **data)
    rigid = _rigid(mechanism.pairs, numbers)
    if rigid:
        return InputError("links-rigid", links=listed(rigid), **data)
    key = "no-group" if mobility == 1 else "links-free" if mobility > 1 and left else "mobility"
    return InputError(key, links=listed(left), **data)


def _rigid(pairs: Collection[Pair], numbers: Collection[int]) -> tuple[int, ...]:
    """Return the fewest links, the frame among them or not, whose pairs let them not move against one another."""
    bodies = (FRAME, *numbers)
    for size in range(2, (len(bodies) if len(bodies) <= MANY else 3) + 1):
        for part in combinations(bodies, size):
            if 3 * (size - 1) <= 2 * sum({*pair.links} <= {*part} for pair in pairs):
                return part
    return ()


def listed(numbers: Iterable[int]) -> str:
    """Return numbers of links in order, with commas."""
    return ", ".join(map(str, sorted(numbers)))
