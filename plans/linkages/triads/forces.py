"""Force plan of a triad: tangential parts from each leg alone, a normal part from moments about X, the rest closes.

The normal parts of the first two legs go through the special point X, where their lines meet. So the moments of all
loads of the group about X give the normal part of the third; then a chain of forces has two unknown ends.
"""

from __future__ import annotations

from ...board import Board
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
    moments += moments_about(board, loads[t.number], t.number, t.X)
    _third_normal(board, t, [*moments, *couples[t.number]])
    _draw(board, t, loads)
    for leg in t.legs:
        if isinstance(leg, Sliding):
            board.step("arm", f"h_{_pair(leg)}", f"M_{_pair(leg)}", f"R_{_pair(leg)}")
        answer(board, t.mechanism, "R", (leg.before, leg.number), (t.number, leg.number))


def _pair(leg: Leg) -> str:
    """Indices of the reaction on a leg of the link before: `12`."""
    return leg.mechanism.index(leg.before, leg.number)


def _alone(board: Board, t: Triad, leg: Leg, loads: list[tuple[str, str]], couples: list[str]) -> list[str]:
    """Find the tangential part of an outer reaction, or the couple of a guide, from moments about the inner joint.

    Returns the moments of all that is known on the leg about X.
    """
    own = moments_about(board, loads, leg.number, leg.joint)
    about = moments_about(board, loads, leg.number, t.X, f"h_{{0}}_{t.X}")
    match leg:
        case Hinged(span=span):
            part = f"R_{_pair(leg)}_t"
            # R^t stands on the arm of the leg and turns about the joint against the sense in which it points
            board.calc(f"_{part}", "moment_equation", span.length, *own, *couples)
            board.calc(part, "along", f"_{part}", leg.across)
            board.moment(f"_M_{part}_{t.X}", f"h_{_pair(leg)}_t", part, leg.end, t.X)
            return [*about, *couples, f"_M_{part}_{t.X}"]
        case Sliding():
            board.calc(f"M_{_pair(leg)}", "closing_moment", ZERO, *own, *couples)
            answer(board, t.mechanism, "M", (leg.before, leg.number))
            return [*about, *couples, f"M_{_pair(leg)}"]
    raise AssertionError(leg)


def _normal(leg: Leg) -> str:
    """Name of the part of an outer reaction along the leg's line: all of it on a slider."""
    return f"R_{_pair(leg)}" if isinstance(leg, Sliding) else f"R_{_pair(leg)}_n"


def _third_normal(board: Board, t: Triad, moments: list[str]) -> None:
    """Find the normal part on the third leg: its moment about X balances that of all the rest."""
    third = t.legs[2]
    part, arm = _normal(third), f"_arm_{_pair(third)}"
    # a force along the line has the moment minus its size times the distance of the line to the left of X
    board.calc(arm, "across_axis", third.line, t.X, third.end)
    board.calc(f"_{part}", "moment_equation", arm, *moments)
    board.calc(part, "along", f"_{part}", third.line)
    board.moment(f"_M_{part}_{t.X}", f"h_{part.removeprefix('R_')}_{t.X}", part, third.end, t.X)


def _draw(board: Board, t: Triad, loads: Forces) -> None:
    """Hang all that is known in a chain, close it, read the reactions."""
    first, second, third = t.legs
    plan = f"forces_{t.name}"
    own = [[force for force, _ in loads[number]] for number in (first.number, t.number, third.number, second.number)]
    parts = [
        [*_tangential(first), *own[0]],
        own[1],
        own[2],
        [*_tangential(third), _normal(third)],
        own[3],
        _tangential(second),
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
            board.read(f"R_{_pair(leg)}", tail, tip)
    board.read(f"R_{t.mechanism.index(t.number, first.number)}", parted, closing)
    board.read(f"R_{t.mechanism.index(t.number, second.number)}", closing, right)
    board.read(f"R_{t.mechanism.index(t.number, third.number)}", right, left)


def _tangential(leg: Leg) -> list[str]:
    return [f"R_{_pair(leg)}_t"] if isinstance(leg, Hinged) else []
