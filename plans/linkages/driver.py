"""The driver: a crank about a fixed pivot. Position, velocity, acceleration, force plan and what balances it."""

from __future__ import annotations

from ..board import Board
from ..names import NORMAL, Name, by_lever, mark, rate, spelled, vector
from ..quantities import F_BAL, M_BAL
from .mechanism import FORCE, FRAME, MOMENT, Driver, Mechanism
from .parts import Body, Couples, Forces, Span, hang, measure_link, moments_about, move_link, place_link


def position(board: Board, mechanism: Mechanism) -> None:
    """Mark the pivot, lay off the crank at its angle."""
    driver, crank = crank_of(mechanism), span(mechanism)
    board.place(driver.pivot, *pivot_place(mechanism))
    board.turn(crank.e, driver.angle)
    measure_link(board, crank)
    board.lay(driver.point, driver.pivot, crank.e, crank.length)
    place_link(board, crank, turned=True)


def velocity(board: Board, mechanism: Mechanism) -> None:
    """v_A = omega_1 * l_OA is normal to the crank in the sense of omega_1."""
    driver, crank = crank_of(mechanism), span(mechanism)
    board.calc(crank.omega, "signed", driver.speed, driver.sense)
    board.calc(vector("V", driver.point).size, "circular_speed", crank.omega, crank.length)
    board.pole("velocity.p")
    board.lay(f"velocity.{driver.point}", "velocity.p", crank.n, vector("V", driver.point).size)
    board.read(vector("V", driver.point), "velocity.p", f"velocity.{driver.point}")
    move_link(board, mechanism, crank, "velocity")


def acceleration(board: Board, mechanism: Mechanism) -> None:
    """a_A = omega_1^2 * l_OA points from A to O, and epsilon_1 * l_OA across unless the crank turns steadily."""
    driver, crank = crank_of(mechanism), span(mechanism)
    tip = mark("acceleration", driver.point)
    normal = mark("acceleration", driver.point, NORMAL) if driver.acceleration else tip
    board.calc(vector("a", driver.point).size, "centripetal", crank.omega, crank.length)
    board.pole("acceleration.p")
    board.back(normal, "acceleration.p", crank.e, vector("a", driver.point).size)
    if driver.acceleration:
        board.calc(crank.epsilon, "signed", driver.acceleration, driver.sense)
        board.calc(vector("a", driver.point, part="t").size, "circular_acceleration", crank.epsilon, crank.length)
        board.lay(tip, normal, crank.n, vector("a", driver.point, part="t").size)
        board.read(vector("a", driver.point, part="n"), "acceleration.p", normal)
        board.read(vector("a", driver.point, part="t"), normal, tip)
    board.read(vector("a", driver.point), "acceleration.p", tip)
    move_link(board, mechanism, crank, "acceleration")


def forces(board: Board, mechanism: Mechanism, loads: Forces, couples: Couples) -> None:
    """Balance the crank: what balances it follows from the moments about its pivot, R_01 closes its force plan.

    `loads` are (force, point) by link, on the crank: reactions of the groups attached to it, inertia force and loads.
    """
    {MOMENT: _by_moment, FORCE: _by_force}[crank_of(mechanism).balance](board, mechanism, loads, couples)


def _by_moment(board: Board, mechanism: Mechanism, loads: Forces, couples: Couples) -> None:
    """R_01 closes the plan of the loads; M_bal is a moment beside them."""
    driver = crank_of(mechanism)
    plan, hung = spelled("forces", driver.link), loads[driver.link]
    board.pole(f"{plan}.0")
    board.read(mechanism.pair("R", FRAME, driver.link), hang(board, plan, [force for force, _ in hung]), f"{plan}.0")
    moments = moments_about(board, hung, driver.pivot, always=True)
    board.calc(M_BAL, "closing_moment", *moments, *couples[driver.link])


def _by_force(board: Board, mechanism: Mechanism, loads: Forces, couples: Couples) -> None:
    """F_bal at the crank pin, along the normal to the crank, stands in the plan before R_01 closes it."""
    driver, crank = crank_of(mechanism), span(mechanism)
    plan, hung = spelled("forces", driver.link), loads[driver.link]
    moments = moments_about(board, hung, driver.pivot, always=True)
    board.calc(F_BAL, "closing_force", crank.length, *moments, *couples[driver.link])
    board.calc(F_BAL.size, "along", F_BAL, crank.n)
    board.pole(f"{plan}.0")
    board.read(
        mechanism.pair("R", FRAME, driver.link),
        hang(board, plan, [*(force for force, _ in hung), F_BAL.size]),
        f"{plan}.0",
    )


def on_lever(board: Board, mechanism: Mechanism, moments: list[Name]) -> None:
    """Solve the moments of the lever for a force at the crank pin, along the normal to the crank.

    On the turned plan it has the moment -F * pa about the pole.
    """
    driver, crank = crank_of(mechanism), span(mechanism)
    force = F_BAL if driver.balance == MOMENT else by_lever(F_BAL)
    board.calc(force, "moment_equation", vector("V", driver.point).size, *moments)
    board.calc(force.size, "along", force, crank.n)
    if driver.balance == MOMENT:
        board.calc(by_lever(M_BAL), "crank_moment", force, crank.length)


def balance(mechanism: Mechanism) -> Name:
    """Return the name of what balances the driver: of the lever it has `_lever` behind it."""
    return M_BAL if crank_of(mechanism).balance == MOMENT else F_BAL


def turning_rate(board: Board, mechanism: Mechanism) -> str:
    """Return the name of the angular velocity beside which another one is rounding."""
    return rate("omega", mechanism.driver.link)


def crank_of(mechanism: Mechanism) -> Driver:
    """Return the driver as the crank that it is."""
    driver = mechanism.driver
    assert isinstance(driver, Driver)
    return driver


def span(mechanism: Mechanism) -> Span:
    """Return the crank between its pivot and its pin."""
    driver = crank_of(mechanism)
    return Span(mechanism.link(driver.link), driver.pivot, driver.point)


def spans(mechanism: Mechanism) -> tuple[Span, ...]:
    """Return the driver's links with two joints."""
    return (span(mechanism),)


def body(mechanism: Mechanism) -> Body:
    """Return the crank for the links attached to it."""
    crank = span(mechanism)
    return crank.body(crank.omega, crank.epsilon if crank_of(mechanism).acceleration else None)


def pivot_place(mechanism: Mechanism) -> tuple[str, str]:
    """Return the names of the pivot's coordinates on the frame."""
    return mechanism.frame_points[crank_of(mechanism).pivot]
