"""Zhukovsky's lever: the velocity plan turned by +90 degrees, all forces hung on it unturned, moments about its pole.

The sum of moments is zero exactly when the power of all forces is: sum F * v + M_i * omega + M_bal * omega_1 = 0.
"""

from __future__ import annotations

from ..board import Board
from .driver import crank_length, crank_name
from .mechanism import Mechanism


def lever(
    board: Board, mechanism: Mechanism, forces: list[tuple[str, str]], couples: list[tuple[str, str, str, str]]
) -> None:
    """Hang `forces` (name, point) and `couples` (moment, A, B, length name) on the turned plan, solve for F_bal at A.

    A couple hangs as two equal opposite forces M / l_AB at B and A, normal to AB.
    """
    driver = mechanism.driver
    forces = [(force, at) for force, at in forces if at != driver.pivot]
    board.pole("lever.p")
    points = [driver.point, *(at for _, at in forces), *(p for couple in couples for p in couple[1:3])]
    for point in dict.fromkeys(points):
        board.normal(f"lever.{point}", f"velocity.{point}")
    moments = []
    for force, at in forces:
        board.moment(f"_M_{force}_p", f"h_lever_{force}", force, f"lever.{at}", "lever.p")
        moments.append(f"_M_{force}_p")
    for moment, A, B, length in couples:
        pair = f"{moment.replace('M_', 'F_')}_couple"
        board.calc(pair, "couple", moment, length)
        board.calc(f"{pair}_{B}", "along", pair, f"n_{A}{B}")
        board.calc(f"{pair}_{A}", "opposite", f"{pair}_{B}")
        for point in (B, A):
            board.moment(
                f"_M_{pair}_{point}_p", f"h_lever_{moment}_{point}", f"{pair}_{point}", f"lever.{point}", "lever.p"
            )
            moments.append(f"_M_{pair}_{point}_p")
    # F_bal along the normal to the crank has the moment -F_bal * pa about the pole
    board.calc("F_bal", "moment_equation", f"_V_{driver.point}", *moments)
    board.calc("_F_bal", "along", "F_bal", f"n_{crank_name(mechanism)}")
    board.calc("M_bal_lever", "crank_moment", "F_bal", crank_length(mechanism))
