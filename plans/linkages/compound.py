"""Compound motion of a hinged coupler: it rotates with the link that carries its hinge, and about that hinge.

Link AB hangs at A on link OA, which turns about the pivot O of the frame. Transport motion: AB rotates with OA about O
at omega_e, epsilon_e; relative motion: AB rotates about A at omega_r, epsilon_r. Then v = v^e + v^r, and
a = a^rn + a^en + a^et + a^k + a^rt with the acceleration of Coriolis a^k = 2 omega_e x v^r, for every point of AB.

Each point has two plans of its own, drawn at the point itself: `V_at_B` and `a_at_B`.

Source: Bertyaev and others, Mechanics: course works with Mathcad, section 4.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import partial
from typing import NamedTuple

from ..board import Board, Program
from ..names import Name, between, mark, pole, rate, role, spelled, vector
from .dyads import RRP, RRR
from .legs import AssurGroup
from .mechanism import FRAME, ZERO, Mechanism, Revolute
from .parts import Bodies, Body, Span

VELOCITY, ACCELERATION = "V_at", "a_at"  # kinds of plans
TOTAL = "total"  # the whole as compound motion gives it
COMPOUND = {"V": ("e", "r"), "a": ("rn", "en", "et", "k", "rt")}  # parts of a vector in the order of their polygon


class _Closing(NamedTuple):
    """What is known of the absolute motion of the coupler's end: a straight guide, or a circle about a fixed pivot."""

    direction: str  # along which its velocity lies
    normal: Name | None  # its normal acceleration on the circle


class Coupler:
    """A link between two joints that hangs on the link `carrier`, which turns about a pivot of the frame.

    `letters` are those of its points without the hinge; a point of two couplers takes the link's number, too. `closing`
    is None where the other outer pair of its group moves.
    """

    def __init__(self, span: Span, carrier: Body, letters: Mapping[str, str], closing: _Closing | None) -> None:
        self.span, self.number, self.letters, self.closing = span, span.number, letters, closing
        self.hinge = span.start  # the joint about which it turns relative to the carrier
        self.carrier, self.pivot = carrier.link, carrier.pin  # and the joint about which the carrier turns
        # the transport rotation, whose acceleration is `zero` where the carrier turns steadily
        self.omega_e, self.epsilon_e = str(carrier.omega), carrier.epsilon or ZERO
        self.centre = rate("P", span.number)  # instant centre of velocities


def couplers(mechanism: Mechanism, groups: Iterable[AssurGroup], bodies: Bodies) -> tuple[Coupler, ...]:
    """Return all links with two joints that hang on a turning link, in order of attachment."""
    found: list[Coupler] = []
    taken: set[str] = set()
    pinned = {n for p in mechanism.pairs if isinstance(p, Revolute) and FRAME in p.links for n in p.links}
    turning = [body for n, body in bodies.items() if n in pinned and body.pin in mechanism.frame_points and body.omega]
    for group, span in [(of, span) for of in groups for span in of.spans]:
        carrying = (body for body in turning if body.link is not span.link and span.start in body.link.points)
        if (carrier := next((body for body in carrying if body.pin != span.start), None)) is None:
            continue
        points = (span.end, *span.others)
        letters = {p: mechanism.letter_on(p, span.number) if p in taken else p for p in points}
        taken.update(points)
        found.append(Coupler(span, carrier, letters, _closing(mechanism, group, span)))
    return tuple(found)


def _closing(mechanism: Mechanism, group: AssurGroup, span: Span) -> _Closing | None:
    match group:
        case RRR(legs=(first, second)):
            other = second if span is first else first
            if other.start in mechanism.frame_points:
                return _Closing(other.n, vector("a", *other.about(group.B), "n"))
        case RRP(legs=(_, slide)) if slide.known is None:
            return _Closing(slide.u, None)
    return None


def compound(board: Board, found: Iterable[Coupler]) -> None:
    """Split the motion of every hinged coupler, and mark its instant centre."""
    found = tuple(found)
    for coupler in found:
        _velocities(board, coupler)
        # P is where both rotations cancel, OP * omega_e = -AP * omega_r: it divides OA in the ratio omega_r : omega
        P, number = coupler.centre, coupler.number
        board.calc(f"_{P}_part", "part_of", rate("omega", number, "r"), rate("omega", number))
        board.divide(P, coupler.pivot, coupler.hinge, f"_{P}_part", "one")
        for end in (coupler.hinge, coupler.pivot):
            board.distance(between("l", end, f"P{number}"), end, P)
    for coupler in found:
        _accelerations(board, coupler)


def _velocities(board: Board, c: Coupler) -> None:
    """v^e = omega_e x OB is normal to OB, v^r normal to AB: it is closed by the line on which v_B lies.

    Where that is not known, and for other points than the end, omega_r = omega - omega_e gives v^r = omega_r x AB.
    """
    omega_r = rate("omega", c.number, "r")
    if c.closing is None:
        board.calc(omega_r, "excess", rate("omega", c.number), c.omega_e)
    for point, letter in c.letters.items():
        plan = spelled(VELOCITY, letter)
        start, e, tip = pole(plan), mark(plan, "e"), mark(plan, letter)
        board.distance(between("l", c.pivot, point), c.pivot, point)
        board.read(f"_from_{c.pivot}_{point}", c.pivot, point)
        board.calc(vector("V", letter, part="e"), "transport_speed", c.omega_e, f"_from_{c.pivot}_{point}")
        board.pole(start)
        board.chain(e, start, vector("V", letter, part="e"))
        if point == c.span.end and c.closing is not None:
            board.meet(tip, e, c.span.n, start, c.closing.direction)
            board.read(vector("V", letter, part="r"), e, tip)
            board.calc(omega_r, "turning", vector("V", letter, part="r"), c.span.n, c.span.length)
        else:
            board.read(f"_from_{c.hinge}_{point}", c.hinge, point)
            board.calc(vector("V", letter, part="r"), "transport_speed", omega_r, f"_from_{c.hinge}_{point}")
            board.chain(tip, e, vector("V", letter, part="r"))
        board.read(vector("V", letter, part=TOTAL).size, start, tip)


def _accelerations(board: Board, c: Coupler) -> None:
    """The chain a^rn (B to A), a^en (B to O), a^et (normal to OB), a^k (v^r turned in the sense of omega_e), a^rt.

    For the end a^rt is the line normal to AB; the normal part of the absolute acceleration, towards its pivot, and the
    line of the tangential part, or the parallel to the guide, close the figure.
    """
    omega_r, epsilon_r = rate("omega", c.number, "r"), rate("epsilon", c.number, "r")
    if c.closing is None:
        board.calc(epsilon_r, "excess", rate("epsilon", c.number), c.epsilon_e)
    for point, letter in c.letters.items():
        plan, a = spelled(ACCELERATION, letter), partial(vector, "a", letter, "")
        arm_e, arm_r = f"_from_{c.pivot}_{point}", f"_from_{c.hinge}_{point}"
        board.read(arm_r, c.hinge, point)
        board.calc(a("rn"), "transport_normal", omega_r, arm_r)
        board.calc(a("en"), "transport_normal", c.omega_e, arm_e)
        board.calc(a("et"), "transport_tangential", c.epsilon_e, arm_e)
        board.calc(a("k"), "coriolis", c.omega_e, vector("V", letter, part="r"))
        last, tip = pole(plan), mark(plan, letter)
        board.pole(last)
        for part in COMPOUND["a"][:-1]:
            board.chain(mark(plan, part), last, a(part))
            last = mark(plan, part)
        if point == c.span.end and c.closing is not None:
            _close(board, c, c.closing, plan, letter)
            board.read(a("rt"), last, tip)
            board.calc(epsilon_r, "turning", a("rt"), c.span.n, c.span.length)
        else:
            board.calc(a("rt"), "transport_tangential", epsilon_r, arm_r)
            board.chain(tip, last, a("rt"))
        board.read(a(TOTAL).size, pole(plan), tip)


def _close(board: Board, c: Coupler, closing: _Closing, plan: str, letter: str) -> None:
    """Meet the normal to AB with the line on which the end of the absolute acceleration lies."""
    start = pole(plan)
    if closing.normal is not None:
        board.chain(mark(plan, "n"), start, closing.normal)
        start = mark(plan, "n")
    board.meet(mark(plan, letter), mark(plan, "k"), c.span.n, start, closing.direction)


def found_here(program: Program) -> frozenset[str]:
    """Return the quantities that compound motion alone finds: parts of vectors, and relative rates."""
    here = [step for step in program if step.plan.kind in (VELOCITY, ACCELERATION)]
    hung = {step.operands[1] for step in here if step.verb == "chain"} | {s.name for s in here if s.verb == "read"}
    elsewhere = {step.name for step in program if step.verb == "read" and step not in here}
    return frozenset(hung - elsewhere) | {step.name for step in program if is_relative(step.name)}


def is_relative(name: str) -> bool:
    """Whether a quantity is the rate of a relative turning."""
    return role(name).kind in ("omega", "epsilon") and role(name).part == "r"
