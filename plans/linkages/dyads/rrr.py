"""The dyad of the first kind, RRR: two links with three revolute pairs, such as a connecting rod and a rocker.

A and C are the outer pairs, B the inner one. Determinant of all its problems: the sine of the angle between AB and CB,
zero when A, B, C stand in line.

Source: Artobolevsky, Theory of mechanisms and machines; Kinytskyi, the same (class II, kind 1).
"""

from __future__ import annotations

from dataclasses import dataclass

from ...board import Board
from ...names import NORMAL, Name, between, mark, spelled, vector
from ..mechanism import Link, Mechanism, Revolute
from ..parts import (
    Bodies,
    Body,
    Couples,
    Forces,
    Passed,
    Span,
    answer,
    hang,
    measure_link,
    moments_about,
    move_link,
    passed_on,
    place_link,
)
from ..structure import Group


@dataclass(frozen=True, slots=True)
class Dyad:
    """The names that the constructions of one RRR dyad use."""

    mechanism: Mechanism
    name: str
    links: tuple[Link, Link]
    A: str
    B: str
    C: str
    before: tuple[int, int]  # the links that carry A and C
    branch: str

    @property
    def spans(self) -> tuple[Span, Span]:
        """The links between their pairs, AB and CB."""
        return Span(self.links[0], self.A, self.B), Span(self.links[1], self.C, self.B)

    @property
    def bodies(self) -> tuple[Body, Body]:
        """The links for those attached to them."""
        first, second = (span.body(span.omega, span.epsilon) for span in self.spans)
        return first, second

    def about(self, span: Span) -> tuple[str, str]:
        """Letters of B's motion about the start of a link: B and A, or B alone about a pivot of the frame, absolute.

        Where both outer pairs are such pivots, the group stands still, and only the second is left out.
        """
        absolute = span.start in self.mechanism.frame_points and (
            span == self.spans[1] or self.C not in self.mechanism.frame_points
        )
        return self.B, "" if absolute else span.start

    def passed(self) -> tuple[Passed, ...]:
        """Reactions on the links before."""
        return tuple(
            passed_on(self.mechanism, span.link.number, before, span.start)
            for span, before in zip(self.spans, self.before, strict=True)
        )


def dyad(mechanism: Mechanism, group: Group, bodies: Bodies) -> Dyad:
    """Name the parts of an RRR group."""
    links = (mechanism.link(group.links[0]), mechanism.link(group.links[1]))
    inner, (first, second) = group.inner[0], group.before
    branch = inner.branch if isinstance(inner, Revolute) and inner.branch else "one"
    A, C = (pair.point for pair in group.outer)
    return Dyad(mechanism, group.name, links, A, inner.point, C, (first, second), branch)


def position(board: Board, d: Dyad) -> None:
    """B is where the arc of radius AB about A crosses the arc of radius CB about C."""
    AB, CB = d.spans
    for span in d.spans:
        measure_link(board, span)
    board.arcs(d.B, d.A, AB.length, d.C, CB.length, d.branch)
    for span in d.spans:
        place_link(board, span)


def velocity(board: Board, d: Dyad) -> None:
    """Through a the normal to AB, through c the normal to CB: b. Other points by similarity."""
    AB, CB = d.spans
    a, c, b = (d.mechanism.mark("velocity", joint) for joint in (d.A, d.C, d.B))
    board.meet(b, a, AB.n, c, CB.n)
    board.read(vector("V", *d.about(AB)), a, b)
    board.read(vector("V", *d.about(CB)), c, b)
    board.read(vector("V", d.B), "velocity.p", b)
    for span in d.spans:
        move_link(board, d.mechanism, span, "velocity")
    for span in d.spans:
        board.calc(span.omega, "turning", vector("V", *d.about(span)), span.n, span.length)


def acceleration(board: Board, d: Dyad) -> None:
    """From a' and c' the normal parts, through their ends the normals to AB and CB: b'."""
    AB, CB = d.spans
    b, ends = mark("acceleration", d.B), []
    for span in d.spans:
        start, end = d.mechanism.mark("acceleration", span.start), mark("acceleration", d.B, NORMAL, span.start)
        part = vector("a", *d.about(span), "n")
        board.calc(part.size, "normal_part", vector("V", *d.about(span)), span.length)
        board.back(end, start, span.e, part.size)
        board.read(part, start, end)
        ends.append(end)
    board.meet(b, ends[0], AB.n, ends[1], CB.n)
    for span, end in zip(d.spans, ends, strict=True):
        board.read(vector("a", *d.about(span), "t"), end, b)
        board.read(vector("a", *d.about(span)), d.mechanism.mark("acceleration", span.start), b)
    board.read(vector("a", d.B), "acceleration.p", b)
    for span in d.spans:
        move_link(board, d.mechanism, span, "acceleration")
    for span in d.spans:
        board.calc(span.epsilon, "turning", vector("a", *d.about(span), "t"), span.n, span.length)


def forces(board: Board, d: Dyad, loads: Forces, couples: Couples) -> None:
    """Force plan of the group: R_12^t, loads of both links, R_43^t; the normal parts along AB and CB close it.

    The tangential parts follow from the moments of each link about B; the inner reaction is a chord of the plan. Where
    AB and CB are nearly parallel, moments of the whole group give a line that meets one of them better.
    """
    plan, pair = spelled("forces", d.name), d.mechanism.pair
    (i, m), (j, k) = d.before, (link.number for link in d.links)
    for span, before in zip(d.spans, d.before, strict=True):
        number = span.link.number
        moments = moments_about(board, loads[number], d.B)
        # R^t stands on the arm of the link and turns about B against the sense in which it points along the normal
        board.calc(pair("R", before, number, "t").size, "moment_equation", span.length, *moments, *couples[number])

    AB, CB = d.spans
    part = _across(board, d, loads, couples)
    board.pole(f"{plan}.0")
    board.lay(f"{plan}.1", f"{plan}.0", AB.n, pair("R", i, j, "t").size)
    board.read(pair("R", i, j, "t"), f"{plan}.0", f"{plan}.1")
    count = len(loads[j]) + len(loads[k]) + 1
    parted = hang(board, plan, [force for force, _ in loads[j]], 1)
    chained = hang(board, plan, [force for force, _ in loads[k]], 1 + len(loads[j]))
    last, closing, beside = (f"{plan}.{count + more}" for more in (1, 2, 3))
    board.lay(last, chained, CB.n, pair("R", m, k, "t").size)
    board.read(pair("R", m, k, "t"), chained, last)
    _close(board, d, (chained, last, closing, beside), part)
    board.read(pair("R", i, j, "n"), closing, f"{plan}.0")
    board.read(pair("R", i, j), closing, f"{plan}.1")
    board.read(pair("R", m, k, "n"), last, closing)
    board.read(pair("R", m, k), chained, closing)
    board.read(pair("R", k, j), parted, closing)
    answer(board, d.mechanism, "R", (i, j), (k, j), (m, k))


def _across(board: Board, d: Dyad, loads: Forces, couples: Couples) -> Name | None:
    """Find the part of an outer reaction normal to CA from moments of the whole group about the other outer pair.

    Returns the name of the part, None where no such moments are wanted.
    """
    centre = dict(d.mechanism.centres).get(d.name)
    if centre is None:
        return None
    joint, span, before = (d.A, d.spans[0], d.before[0]) if centre == d.C else (d.C, d.spans[1], d.before[1])
    length, e, n = between("l", centre, joint).size, spelled("e", d.name), spelled("n", d.name)
    board.measure(length, centre, joint)
    board.direction(e, centre, joint, length)
    board.normal(n, e)
    numbers = [link.number for link in d.links]
    moments = [m for n in numbers for m in moments_about(board, loads[n], centre, centre)]
    part = d.mechanism.pair("R", before, span.link.number, "m")
    board.calc(part.size, "moment_equation", length, *moments, *(c for n in numbers for c in couples[n]))
    return part


def _close(board: Board, d: Dyad, marks: tuple[str, str, str, str], part: Name | None) -> None:
    """Mark where two lines close the chain: the parallels to AB and CB, or one of them and that to CA.

    `marks` are the ends of the chained loads, of the whole chain, the closing point, and one beside it.
    """
    (AB, CB), (chained, last, closing, beside), plan = d.spans, marks, spelled("forces", d.name)
    if part is None:
        board.meet(closing, last, CB.e, f"{plan}.0", AB.e)
        return
    # the part turns about the centre in the sense in which it points along the normal; it is laid off at the loads
    if dict(d.mechanism.centres)[d.name] == d.C:
        board.lay(beside, f"{plan}.1", spelled("n", d.name), part.size)
        board.read(part, beside, f"{plan}.1")
        board.meet(closing, beside, spelled("e", d.name), f"{plan}.0", AB.e)
    else:
        board.back(beside, chained, spelled("n", d.name), part.size)
        board.read(part, chained, beside)
        board.meet(closing, last, CB.e, beside, spelled("e", d.name))
