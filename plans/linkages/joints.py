"""Joints: all links that one pin holds together. Of three and more of them any two may be called a pair.

A joint of three links counts as two pairs, and it does not matter which two of the three a task names: the structure
takes the named ones where it can, and others where only those make dyads.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass

from ...scales.errors import InputError
from .mechanism import FRAME, Pair, Prismatic, Revolute


@dataclass(frozen=True, slots=True)
class Joint:
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
        ways = [self.pair(first, second) for i, first in enumerate(own) for second in own[i + 1 :]]
        held, tree = [{number} for number in own], []
        for pair in sorted(ways, key=lambda pair: not self.names(pair)):
            parts = [part for part in held if part & {*pair.links}]
            if len(parts) == 2:
                tree.append(pair)
                held = [part for part in held if part not in parts] + [parts[0] | parts[1]]
        return list[Pair](tree)

    def ties(self, links: Collection[int], known: Sequence[int]) -> list[Pair]:
        """Return the pair that holds `links` to one of the `known`: a named one, else to the first of these."""
        here = [own for own in links if own in self.links]
        ways = [self.pair(own, other) for other in known if other in self.links for own in here]
        return list[Pair](sorted(ways, key=lambda pair: not self.names(pair))[:1])


def joints_of(pairs: Iterable[Pair]) -> tuple[Joint | Prismatic, ...]:
    """Collect revolute pairs with one letter that have links in common; prismatic pairs stay among them.

    Raises
    ------
    InputError
        When a joint of three links or more is given a pair too many.
    """
    found: list[Joint | Prismatic] = []
    for pair in pairs:
        if isinstance(pair, Prismatic):
            found.append(pair)
            continue
        one = Joint(pair.point, pair.links, (pair,))
        touching = [j for j in found if isinstance(j, Joint) and j.point == one.point and {*j.links} & {*one.links}]
        for joint in touching:
            links = dict.fromkeys((*joint.links, *one.links))
            one = Joint(one.point, tuple(links), (*joint.named, *one.named))
        place = found.index(touching[0]) if touching else len(found)
        found = [joint for joint in found if joint not in touching]
        found.insert(place, one)
    for made in found:
        if isinstance(made, Joint) and len(made.named) >= len(made.links) > 2:
            links_of = ", ".join(map(str, sorted(made.links)))
            raise InputError("joint-closed", point=made.point, links=links_of, n=len(made.links) - 1)
    return tuple(found)


def pairs_of(
    joints: Iterable[Joint | Prismatic], links: Collection[int], known: Sequence[int]
) -> tuple[tuple[Pair, ...], tuple[Pair, ...], bool]:
    """Return the pairs of `links` among themselves, those with `known` ones, and whether the task names all of them."""
    inner: list[Pair] = []
    outer: list[Pair] = []
    named = True
    for joint in joints:
        if not any(number in links for number in joint.links):
            continue
        if isinstance(joint, Joint):
            tree, ties = joint.tree(links), joint.ties(links, known)
            named = named and all(map(joint.names, (*tree, *ties)))
            inner += tree
            outer += ties
        elif {*joint.links} <= {*links}:
            inner.append(joint)
        elif {*joint.links} & {*links} and {*joint.links} & {*known}:
            outer.append(joint)
    return tuple(inner), tuple(outer), named
