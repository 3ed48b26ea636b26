"""Zhukovsky's lever: the velocity plan turned by +90 degrees, all forces hung on it unturned, moments about its pole.

The sum of moments is zero exactly when the power of all forces is: sum F * v + M_i * omega + M_bal * omega_1 = 0. What
balances the driver follows from it.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import partial
from typing import TypeAlias

from ..board import Board, Step
from ..names import Name, couple, lever_arm, moment, role
from .mechanism import Mechanism
from .parts import Ends, Span

Joined: TypeAlias = Span | Ends  # two points of a link


def lever(
    board: Board,
    mechanism: Mechanism,
    forces: list[tuple[str, str]],
    couples: list[tuple[str, Joined]],
    turning: list[tuple[str, str]],
) -> list[Name]:
    """Hang `forces` (name, point) and `couples` (moment, points A, B) on the turned plan; return their moments.

    A couple hangs as two equal opposite forces M / l_AB at B and A, normal to AB. Those in `turning` (moment, omega) on
    links of which no two points are known enter with their power.
    """
    driver, still = mechanism.driver, mechanism.frame_points
    forces = [(force, at) for force, at in forces if at not in still]
    board.pole("lever.p")
    points = [driver.point, *(at for _, at in forces), *(p for _, span in couples for p in (span.start, span.end))]
    for point in dict.fromkeys(point for point in points if point not in still):
        board.normal(f"lever.{point}", f"velocity.{point}")
    moments: list[Name] = []
    for force, at in forces:
        moments.append(moment(force, "p"))
        board.moment(moments[-1], lever_arm(force), force, f"lever.{at}", "lever.p")
    for turns, span in couples:
        A, B = span.start, span.end
        half = partial(couple, turns)
        board.calc(half(), "couple", turns, span.length)
        board.calc(half(B), "along", half(), span.n)
        board.calc(half(A), "opposite", half(B))
        for point in (p for p in (B, A) if p not in still):
            moments.append(moment(half(point), "p"))
            board.moment(moments[-1], lever_arm(turns, point), half(point), f"lever.{point}", "lever.p")
    for turns, omega in turning:
        moments.append(Name(f"_{turns}_p", "M", role(turns).of, "p"))
        board.calc(moments[-1], "couple_on_lever", turns, omega)
    return moments


def points_of(omega: str, steps: Iterable[Step], spans: Mapping[str, Span]) -> Joined | None:
    """Return two points with images on the plan that turn with the angular velocity `omega`, if any are known.

    They are the joints of a link that turns so, `spans` by angular velocity, or those from whose relative velocity it
    was read: a sliding block turns with its guide, and the guide by the velocity of its point under the block's pin.
    """
    made = {step.name: step for step in steps}
    while omega not in spans and omega in made and made[omega].law == "same_turning":
        omega = made[omega].operands[0]
    if omega in spans or omega not in made or made[omega].law != "turning":
        return spans.get(omega)
    vector, normal, length = made[omega].operands
    start, end = made[made[normal].operands[0]].operands[:2]
    point = role(made[vector].operands[1]).of  # the pin itself, or the point of the link under it
    return Ends(start, point if end in (point, role(point).of) else end, normal, length)
