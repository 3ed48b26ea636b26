"""The driver: a crank about a fixed pivot. Position, velocity, acceleration, force plan and balancing moment."""

from __future__ import annotations

from collections.abc import Iterator

from ...scales.errors import InputError
from ..board import Board
from .mechanism import ZERO, Mechanism, Revolute


def position(board: Board, mechanism: Mechanism) -> None:
    """Mark the pivot, lay off the crank at its angle."""
    driver = mechanism.driver
    crank = crank_name(mechanism)
    board.place(driver.pivot, *pivot_place(mechanism))
    board.turn(f"e_{crank}", driver.angle)
    board.normal(f"n_{crank}", f"e_{crank}")
    board.lay(driver.point, driver.pivot, f"e_{crank}", crank_length(mechanism))
    for point, x in _other_points(mechanism):
        board.divide(point, driver.pivot, driver.point, x, crank_length(mechanism))


def velocity(board: Board, mechanism: Mechanism) -> None:
    """v_A = omega_1 * l_OA is normal to the crank in the sense of omega_1."""
    driver, length = mechanism.driver, crank_length(mechanism)
    omega = f"omega_{driver.link}"
    board.calc(omega, "signed", driver.speed, driver.sense)
    board.calc(f"_V_{driver.point}", "circular_speed", omega, length)
    board.pole("velocity.p")
    board.lay(f"velocity.{driver.point}", "velocity.p", f"n_{crank_name(mechanism)}", f"_V_{driver.point}")
    board.read(f"V_{driver.point}", "velocity.p", f"velocity.{driver.point}")
    _similar(board, mechanism, "velocity", "V")


def acceleration(board: Board, mechanism: Mechanism) -> None:
    """a_A = omega_1^2 * l_OA points from A to O, the crank turning steadily."""
    driver, crank = mechanism.driver, crank_name(mechanism)
    board.calc(f"_a_{driver.point}", "centripetal", f"omega_{driver.link}", crank_length(mechanism))
    board.pole("acceleration.p")
    board.back(f"acceleration.{driver.point}", "acceleration.p", f"e_{crank}", f"_a_{driver.point}")
    board.read(f"a_{driver.point}", "acceleration.p", f"acceleration.{driver.point}")
    _similar(board, mechanism, "acceleration", "a")


def _similar(board: Board, mechanism: Mechanism, plan: str, symbol: str) -> None:
    for point, x in _other_points(mechanism):
        pole, end = f"{plan}.p", f"{plan}.{mechanism.driver.point}"
        board.divide(f"{plan}.{point}", pole, end, x, crank_length(mechanism))
        board.read(f"{symbol}_{point}", pole, f"{plan}.{point}")


def _other_points(mechanism: Mechanism) -> Iterator[tuple[str, str]]:
    """Go through the crank's points beside its pivot and its pin: (point, distance from the pivot)."""
    driver = mechanism.driver
    points = mechanism.link(driver.link).points
    if points[driver.pivot] != (ZERO, ZERO) or any(y != ZERO for _, y in points.values()):
        raise InputError("bent-link", link=driver.link)
    return ((point, x) for point, (x, _) in points.items() if point not in (driver.pivot, driver.point))


def forces(board: Board, mechanism: Mechanism, hung: tuple[tuple[str, str], ...]) -> None:
    """Balance the crank: R_01 closes its force plan, M_bal its moments about the pivot.

    `hung` are (force on the crank, its point): reactions of the groups attached to it, inertia force and loads.
    """
    driver = mechanism.driver
    plan = f"forces_{driver.link}"
    board.pole(f"{plan}.0")
    for i, (force, _) in enumerate(hung):
        board.chain(f"{plan}.{i + 1}", f"{plan}.{i}", force)
    board.read(f"R_0{driver.link}", f"{plan}.{len(hung)}", f"{plan}.0")
    moments = []
    for force, at in hung:
        arm = f"h_{driver.link}" if force == f"F_i{driver.link}" else f"h_{force.removeprefix('R_')}"
        board.moment(f"_M_{force}_{driver.pivot}", arm, force, at, driver.pivot)
        moments.append(f"_M_{force}_{driver.pivot}")
    board.calc("M_bal", "closing_moment", *moments)


def crank_name(mechanism: Mechanism) -> str:
    """Return the crank by its ends, `OA`."""
    return mechanism.driver.pivot + mechanism.driver.point


def crank_length(mechanism: Mechanism) -> str:
    """Return the name of the crank's length."""
    return mechanism.link(mechanism.driver.link).points[mechanism.driver.point][0]


def pivot_place(mechanism: Mechanism) -> tuple[str, str]:
    """Return the names of the pivot's coordinates on the frame."""
    pivot = mechanism.driver.pivot
    at = next(p.at for p in mechanism.pairs if isinstance(p, Revolute) and p.point == pivot)
    assert at is not None
    return at
