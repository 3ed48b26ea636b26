"""Zhukovsky's lever: the velocity plan turned by +90 degrees, all forces hung on it unturned, moments about its pole.

The sum of moments is zero exactly when the power of all forces is: sum F * v + M_i * omega + M_bal * omega_1 = 0. What
balances the driver follows from it.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TypeAlias

from ..board import Board, Step
from .mechanism import Mechanism
from .parts import Ends, Span

Joined: TypeAlias = Span | Ends  # two points of a link


def lever(
    board: Board,
    mechanism: Mechanism,
    forces: list[tuple[str, str]],
    couples: list[tuple[str, Joined]],
    turning: list[tuple[str, str]],
) -> list[str]:
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
    moments = []
    for force, at in forces:
        board.moment(f"_M_{force}_p", f"h_lever_{force}", force, f"lever.{at}", "lever.p")
        moments.append(f"_M_{force}_p")
    for moment, span in couples:
        A, B = span.start, span.end
        pair = f"{moment.replace('M_', 'F_')}_couple"
        board.calc(pair, "couple", moment, span.length)
        board.calc(f"{pair}_{B}", "along", pair, span.n)
        board.calc(f"{pair}_{A}", "opposite", f"{pair}_{B}")
        for point in (p for p in (B, A) if p not in still):
            board.moment(
                f"_M_{pair}_{point}_p", f"h_lever_{moment}_{point}", f"{pair}_{point}", f"lever.{point}", "lever.p"
            )
            moments.append(f"_M_{pair}_{point}_p")
    for moment, omega in turning:
        board.calc(f"_{moment}_p", "couple_on_lever", moment, omega)
        moments.append(f"_{moment}_p")
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
    point = made[vector].operands[1].rpartition(".")[2]  # the pin itself, or the point of the link under it
    return Ends(start, point if point.startswith(end) else end, normal, length)
