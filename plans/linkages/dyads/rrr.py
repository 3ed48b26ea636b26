"""The dyad of the first kind, RRR: two links with three revolute pairs, such as a connecting rod and a rocker.

A and C are the outer pairs, B the inner one. Determinant of all its problems: the sine of the angle between AB and CB,
zero when A, B, C stand in line.

Source: Artobolevsky, Theory of mechanisms and machines; Kinytskyi, the same (class II, kind 1).
"""

from __future__ import annotations

from dataclasses import dataclass

from ...board import Board
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
        first, second = (span.body(f"omega_{span.link.number}", f"epsilon_{span.link.number}") for span in self.spans)
        return first, second

    def about(self, span: Span) -> str:
        """Letters of B's motion about the start of a link: `BA`, or `B` alone about a pivot of the frame, absolute.

        Where both outer pairs are such pivots, the group stands still, and only the second is left out.
        """
        absolute = span.start in self.mechanism.frame_points and (
            span == self.spans[1] or self.C not in self.mechanism.frame_points
        )
        return self.B if absolute else self.B + span.start

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
    board.read(f"V_{d.about(AB)}", a, b)
    board.read(f"V_{d.about(CB)}", c, b)
    board.read(f"V_{d.B}", "velocity.p", b)
    for span in d.spans:
        move_link(board, d.mechanism, span, "velocity")
    for span in d.spans:
        board.calc(f"omega_{span.link.number}", "turning", f"V_{d.about(span)}", span.n, span.length)


def acceleration(board: Board, d: Dyad) -> None:
    """From a' and c' the normal parts, through their ends the normals to AB and CB: b'."""
    AB, CB = d.spans
    b, ends = f"acceleration.{d.B}", []
    for span in d.spans:
        start, end = d.mechanism.mark("acceleration", span.start), f"acceleration.n_{d.B}{span.start}"
        part = f"a_{d.about(span)}_n"
        board.calc(f"_{part}", "normal_part", f"V_{d.about(span)}", span.length)
        board.back(end, start, span.e, f"_{part}")
        board.read(part, start, end)
        ends.append(end)
    board.meet(b, ends[0], AB.n, ends[1], CB.n)
    for span, end in zip(d.spans, ends, strict=True):
        board.read(f"a_{d.about(span)}_t", end, b)
        board.read(f"a_{d.about(span)}", d.mechanism.mark("acceleration", span.start), b)
    board.read(f"a_{d.B}", "acceleration.p", b)
    for span in d.spans:
        move_link(board, d.mechanism, span, "acceleration")
    for span in d.spans:
        board.calc(f"epsilon_{span.link.number}", "turning", f"a_{d.about(span)}_t", span.n, span.length)


def forces(board: Board, d: Dyad, loads: Forces, couples: Couples) -> None:
    """Force plan of the group: R_12^t, loads of both links, R_43^t; the normal parts along AB and CB close it.

    The tangential parts follow from the moments of each link about B; the inner reaction is a chord of the plan. Where
    AB and CB are nearly parallel, moments of the whole group give a line that meets one of them better.
    """
    plan, index = f"forces_{d.name}", d.mechanism.index
    (i, m), (j, k) = d.before, (link.number for link in d.links)
    for span, before in zip(d.spans, d.before, strict=True):
        number = span.link.number
        moments = moments_about(board, loads[number], number, d.B)
        # R^t stands on the arm of the link and turns about B against the sense in which it points along the normal
        board.calc(f"_R_{index(before, number)}_t", "moment_equation", span.length, *moments, *couples[number])

    AB, CB = d.spans
    part = _across(board, d, loads, couples)
    board.pole(f"{plan}.0")
    board.lay(f"{plan}.1", f"{plan}.0", AB.n, f"_R_{index(i, j)}_t")
    board.read(f"R_{index(i, j)}_t", f"{plan}.0", f"{plan}.1")
    count = len(loads[j]) + len(loads[k]) + 1
    parted = hang(board, plan, [force for force, _ in loads[j]], 1)
    chained = hang(board, plan, [force for force, _ in loads[k]], 1 + len(loads[j]))
    last, closing = f"{plan}.{count + 1}", f"{plan}.{count + 2}"
    board.lay(last, chained, CB.n, f"_R_{index(m, k)}_t")
    board.read(f"R_{index(m, k)}_t", chained, last)
    _close(board, d, (chained, last, closing), part)
    board.read(f"R_{index(i, j)}_n", closing, f"{plan}.0")
    board.read(f"R_{index(i, j)}", closing, f"{plan}.1")
    board.read(f"R_{index(m, k)}_n", last, closing)
    board.read(f"R_{index(m, k)}", chained, closing)
    board.read(f"R_{index(k, j)}", parted, closing)
    answer(board, d.mechanism, "R", (i, j), (k, j), (m, k))


def _across(board: Board, d: Dyad, loads: Forces, couples: Couples) -> str | None:
    """Find the part of an outer reaction normal to CA from moments of the whole group about the other outer pair.

    Returns the name of the part, None where no such moments are wanted.
    """
    centre = dict(d.mechanism.centres).get(d.name)
    if centre is None:
        return None
    joint, span, before = (d.A, d.spans[0], d.before[0]) if centre == d.C else (d.C, d.spans[1], d.before[1])
    length = f"_l_{centre}{joint}"
    board.measure(length, centre, joint)
    board.direction(f"e_{d.name}", centre, joint, length)
    board.normal(f"n_{d.name}", f"e_{d.name}")
    numbers = [link.number for link in d.links]
    moments = [m for n in numbers for m in moments_about(board, loads[n], n, centre, f"h_{{0}}_{centre}")]
    part = f"R_{d.mechanism.index(before, span.link.number)}_m"
    board.calc(f"_{part}", "moment_equation", length, *moments, *(c for n in numbers for c in couples[n]))
    return part


def _close(board: Board, d: Dyad, marks: tuple[str, str, str], part: str | None) -> None:
    """Mark where two lines close the chain: the parallels to AB and CB, or one of them and that to CA.

    `marks` are the ends of the chained loads, of the whole chain, and the closing point.
    """
    (AB, CB), (chained, last, closing), plan = d.spans, marks, f"forces_{d.name}"
    if part is None:
        board.meet(closing, last, CB.e, f"{plan}.0", AB.e)
        return
    beside = f"{plan}.{int(closing.rpartition('.')[2]) + 1}"
    # the part turns about the centre in the sense in which it points along the normal; it is laid off at the loads
    if dict(d.mechanism.centres)[d.name] == d.C:
        board.lay(beside, f"{plan}.1", f"n_{d.name}", f"_{part}")
        board.read(part, beside, f"{plan}.1")
        board.meet(closing, beside, f"e_{d.name}", f"{plan}.0", AB.e)
    else:
        board.back(beside, chained, f"n_{d.name}", f"_{part}")
        board.read(part, chained, beside)
        board.meet(closing, last, CB.e, beside, f"e_{d.name}")
