"""Force plan of a triad: tangential parts from each leg alone, a normal part from moments about X, the rest closes.

The normal parts of the first two legs go through the special point X, where their lines meet. So the moments of all
loads of the group about X give the normal part of the third; then a chain of forces has two unknown ends.
"""

from __future__ import annotations

from ...board import Board
from ...names import Name, arm, moment, spelled
from ..mechanism import ZERO
from ..parts import Couples, Forces, answer, hang, moments_about
from .legs import Hinged, Leg, Sliding
from .parts import Triad


def forces(board: Board, t: Triad, loads: Forces, couples: Couples) -> None:
    """Force plan of the group: first leg, central link, third leg, second leg; parallels to AB and EC close it.

    `loads` are (force, point) and `couples` moments, by link. Inner reactions are chords of the plan.
    """
    moments: list[str] = []
    for leg in t.legs:
        moments += _alone(board, t, leg, loads[leg.number], couples[leg.number])
    moments += moments_about(board, loads[t.number], t.X)
    _third_normal(board, t, [*moments, *couples[t.number]])
    _draw(board, t, loads)
    for leg in t.legs:
        if isinstance(leg, Sliding):
            board.step("arm", _pair(leg, "h"), _pair(leg, "M"), _pair(leg, "R"))
        answer(board, t.mechanism, "R", (leg.before, leg.number), (t.number, leg.number))


def _pair(leg: Leg, kind: str, part: str = "") -> Name:
    """Return the reaction on a leg of the link before, its moment or arm."""
    return leg.mechanism.pair(kind, leg.before, leg.number, part)


def _alone(board: Board, t: Triad, leg: Leg, loads: list[tuple[str, str]], couples: list[str]) -> list[str]:
    """Find the tangential part of an outer reaction, or the couple of a guide, from moments about the inner joint.

    Returns the moments of all that is known on the leg about X.
    """
    own = moments_about(board, loads, leg.joint)
    about = moments_about(board, loads, t.X, t.X)
    match leg:
        case Hinged(span=span):
            part = _pair(leg, "R", "t")
            # R^t stands on the arm of the leg and turns about the joint against the sense in which it points
            board.calc(part.size, "moment_equation", span.length, *own, *couples)
            board.calc(part, "along", part.size, leg.across)
            board.moment(moment(part, t.X), arm(part), part, leg.end, t.X)
            return [*about, *couples, moment(part, t.X)]
        case Sliding():
            board.calc(_pair(leg, "M"), "closing_moment", ZERO, *own, *couples)
            answer(board, t.mechanism, "M", (leg.before, leg.number))
            return [*about, *couples, _pair(leg, "M")]
    raise AssertionError(leg)


def _normal(leg: Leg) -> Name:
    """Name of the part of an outer reaction along the leg's line: all of it on a slider."""
    return _pair(leg, "R", "" if isinstance(leg, Sliding) else "n")


def _third_normal(board: Board, t: Triad, moments: list[str]) -> None:
    """Find the normal part on the third leg: its moment about X balances that of all the rest."""
    third = t.legs[2]
    part, aside = _normal(third), Name(f"_arm_{_pair(third, 'R').of}")
    # a force along the line has the moment minus its size times the distance of the line to the left of X
    board.calc(aside, "across_axis", third.line, t.X, third.end)
    board.calc(part.size, "moment_equation", aside, *moments)
    board.calc(part, "along", part.size, third.line)
    board.moment(moment(part, t.X), arm(part, t.X), part, third.end, t.X)


def _draw(board: Board, t: Triad, loads: Forces) -> None:
    """Hang all that is known in a chain, close it, read the reactions."""
    first, second, third = t.legs
    plan = spelled("forces", t.name)
    own = [[force for force, _ in loads[number]] for number in (first.number, t.number, third.number, second.number)]
    parts: list[list[str]] = [
        [*_tangential(first), *own[0]],
        own[1],
        own[2],
        [*_tangential(third), _normal(third)],
        own[3],
        [*_tangential(second)],
    ]
    board.pole(f"{plan}.0")
    ends, count = [], 0
    for hung in parts:
        ends.append(hang(board, plan, hung, count))
        count += len(hung)
    parted, left, loaded, right, chained, last = ends
    closing = f"{plan}.{count + 1}"
    board.meet(closing, last, second.line, f"{plan}.0", first.line)
    board.read(_normal(first), closing, f"{plan}.0")
    board.read(_normal(second), last, closing)
    for leg, tail, tip in ((first, closing, f"{plan}.1"), (second, chained, closing), (third, loaded, right)):
        if isinstance(leg, Hinged):
            board.read(_pair(leg, "R"), tail, tip)
    for leg, tail, tip in ((first, parted, closing), (second, closing, right), (third, right, left)):
        board.read(t.mechanism.pair("R", t.number, leg.number), tail, tip)


def _tangential(leg: Leg) -> list[Name]:
    return [_pair(leg, "R", "t")] if isinstance(leg, Hinged) else []
