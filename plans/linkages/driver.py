"""The driver: a crank about a fixed pivot. Position, velocity, acceleration, force plan and balancing moment."""

from __future__ import annotations

from ..board import Board
from .mechanism import Mechanism
from .parts import Body, Couples, Forces, Span, hang, measure_link, moments_about, move_link, place_link


def position(board: Board, mechanism: Mechanism) -> None:
    """Mark the pivot, lay off the crank at its angle."""
    driver, crank = mechanism.driver, span(mechanism)
    board.place(driver.pivot, *pivot_place(mechanism))
    board.turn(crank.e, driver.angle)
    measure_link(board, crank)
    board.lay(driver.point, driver.pivot, crank.e, crank.length)
    place_link(board, crank, turned=True)


def velocity(board: Board, mechanism: Mechanism) -> None:
    """v_A = omega_1 * l_OA is normal to the crank in the sense of omega_1."""
    driver, crank = mechanism.driver, span(mechanism)
    omega = f"omega_{driver.link}"
    board.calc(omega, "signed", driver.speed, driver.sense)
    board.calc(f"_V_{driver.point}", "circular_speed", omega, crank.length)
    board.pole("velocity.p")
    board.lay(f"velocity.{driver.point}", "velocity.p", crank.n, f"_V_{driver.point}")
    board.read(f"V_{driver.point}", "velocity.p", f"velocity.{driver.point}")
    move_link(board, mechanism, crank, "velocity")


def acceleration(board: Board, mechanism: Mechanism) -> None:
    """a_A = omega_1^2 * l_OA points from A to O, and epsilon_1 * l_OA across unless the crank turns steadily."""
    driver, crank = mechanism.driver, span(mechanism)
    tip = f"acceleration.{driver.point}"
    normal = "acceleration.n_" + driver.point if driver.acceleration else tip
    board.calc(f"_a_{driver.point}", "centripetal", f"omega_{driver.link}", crank.length)
    board.pole("acceleration.p")
    board.back(normal, "acceleration.p", crank.e, f"_a_{driver.point}")
    if driver.acceleration:
        epsilon = f"epsilon_{driver.link}"
        board.calc(epsilon, "signed", driver.acceleration, driver.sense)
        board.calc(f"_a_{driver.point}_t", "circular_acceleration", epsilon, crank.length)
        board.lay(tip, normal, crank.n, f"_a_{driver.point}_t")
        board.read(f"a_{driver.point}_n", "acceleration.p", normal)
        board.read(f"a_{driver.point}_t", normal, tip)
    board.read(f"a_{driver.point}", "acceleration.p", tip)
    move_link(board, mechanism, crank, "acceleration")


def forces(board: Board, mechanism: Mechanism, loads: Forces, couples: Couples) -> None:
    """Balance the crank: R_01 closes its force plan, M_bal its moments about the pivot.

    `loads` are (force, point) by link, on the crank: reactions of the groups attached to it, inertia force and loads.
    """
    driver = mechanism.driver
    plan, hung = f"forces_{driver.link}", loads[driver.link]
    board.pole(f"{plan}.0")
    board.read(f"R_0{driver.link}", hang(board, plan, [force for force, _ in hung]), f"{plan}.0")
    moments = moments_about(board, hung, driver.link, driver.pivot, always=True)
    board.calc("M_bal", "closing_moment", *moments, *couples[driver.link])


def span(mechanism: Mechanism) -> Span:
    """Return the crank between its pivot and its pin."""
    driver = mechanism.driver
    return Span(mechanism.link(driver.link), driver.pivot, driver.point)


def body(mechanism: Mechanism) -> Body:
    """Return the crank for the links attached to it."""
    driver = mechanism.driver
    epsilon = f"epsilon_{driver.link}" if driver.acceleration else None
    return span(mechanism).body(f"omega_{driver.link}", epsilon)


def crank_name(mechanism: Mechanism) -> str:
    """Return the crank by its ends, `OA`."""
    return span(mechanism).name


def crank_length(mechanism: Mechanism) -> str:
    """Return the name of the crank's length."""
    return span(mechanism).length


def pivot_place(mechanism: Mechanism) -> tuple[str, str]:
    """Return the names of the pivot's coordinates on the frame."""
    return mechanism.frame_points[mechanism.driver.pivot]
