"""The driver that slides on the frame, such as a piston. Its plans, and the force along the guide that balances it.

P is the point that runs in the guide, u the guide's direction.
"""

from __future__ import annotations

from ...scales.errors import InputError
from ..board import Board
from ..names import Name, by_lever, spelled, vector
from ..quantities import F_BAL
from .guides import Slide, place_slide, running_line, slide_of
from .mechanism import FRAME, ZERO, Mechanism, Prismatic, SlidingDriver
from .parts import Body, Couples, Forces, Span, hang, moments_about, move_points, normal_of


def position(board: Board, mechanism: Mechanism) -> None:
    """Lay off the travel along the guide."""
    driver, slide = slider_of(mechanism), slide_on_frame(mechanism)
    board.lay(driver.point, running_line(board, slide), slide.u, driver.travel)
    place_slide(board, slide)


def velocity(board: Board, mechanism: Mechanism) -> None:
    """v_P is given along the guide; the slider does not turn, and all its points move alike."""
    driver, slide = slider_of(mechanism), slide_on_frame(mechanism)
    board.calc(vector("V", driver.point).size, "given", driver.speed)
    board.pole("velocity.p")
    board.lay(f"velocity.{driver.point}", "velocity.p", slide.u, vector("V", driver.point).size)
    board.read(vector("V", driver.point), "velocity.p", f"velocity.{driver.point}")
    move_points(board, mechanism, slide.body, "velocity", (driver.point,))


def acceleration(board: Board, mechanism: Mechanism) -> None:
    """a_P is given along the guide, zero unless the slider speeds up."""
    driver, slide = slider_of(mechanism), slide_on_frame(mechanism)
    board.calc(vector("a", driver.point).size, "given", driver.acceleration or ZERO)
    board.pole("acceleration.p")
    board.lay(f"acceleration.{driver.point}", "acceleration.p", slide.u, vector("a", driver.point).size)
    board.read(vector("a", driver.point), "acceleration.p", f"acceleration.{driver.point}")
    move_points(board, mechanism, slide.body, "acceleration", (driver.point,))


def forces(board: Board, mechanism: Mechanism, loads: Forces, couples: Couples) -> None:
    """Balance the slider: through the ends of its loads the guide and the normal to it, F_bal along u and R_01 across.

    Moments about P give the arm of the guide's reaction.
    """
    driver, u = slider_of(mechanism), slide_on_frame(mechanism).u
    link, hung = driver.link, loads[driver.link]
    plan = spelled("forces", link)
    reaction, couple, arm = (mechanism.pair(kind, FRAME, link) for kind in ("R", "M", "h"))
    board.pole(f"{plan}.0")
    last, closing = hang(board, plan, [force for force, _ in hung]), f"{plan}.{len(hung) + 1}"
    board.meet(closing, last, u, f"{plan}.0", normal_of(u))
    board.read(F_BAL.size, last, closing)
    board.read(reaction, closing, f"{plan}.0")
    board.calc(F_BAL, "component", u, F_BAL.size)
    moments = moments_about(board, hung, driver.point)
    board.calc(couple, "closing_moment", ZERO, *moments, *couples[link])
    board.step("arm", arm, couple, reaction)


def on_lever(board: Board, mechanism: Mechanism, moments: list[Name]) -> None:
    """Solve the moments of the lever for a force at P along the guide: on the turned plan its moment is -F * pp."""
    driver = slider_of(mechanism)
    board.calc(by_lever(F_BAL), "moment_equation", vector("V", driver.point).size, *moments)
    board.calc(by_lever(F_BAL).size, "along", by_lever(F_BAL), slide_on_frame(mechanism).u)


def balance(mechanism: Mechanism) -> Name:
    """Return the name of what balances the driver."""
    return F_BAL


def turning_rate(board: Board, mechanism: Mechanism) -> str:
    """Return the name of an angular velocity beside which another one is rounding: v_P over all lengths together."""
    driver = slider_of(mechanism)
    places = (xy for link in mechanism.links for place in link.points.values() for xy in place)
    names = dict.fromkeys(xy for xy in places if xy != ZERO)
    board.calc("_reach", "reach", *names)
    board.calc("_omega", "rate_over", vector("V", driver.point).size, "_reach")
    return "_omega"


def slider_of(mechanism: Mechanism) -> SlidingDriver:
    """Return the driver as the slider that it is."""
    driver = mechanism.driver
    assert isinstance(driver, SlidingDriver)
    return driver


def slide_on_frame(mechanism: Mechanism) -> Slide:
    """Return how the driver slides on the frame.

    Raises
    ------
    InputError
        When there is no such pair, or the frame is said to be its slider.
    """
    driver = slider_of(mechanism)
    for pair in mechanism.pairs:
        if isinstance(pair, Prismatic) and {*pair.links} == {FRAME, driver.link}:
            return slide_of(mechanism, pair, driver.link, driver.point, {})
    raise InputError("driver-guide", link=driver.link)


def spans(mechanism: Mechanism) -> tuple[Span, ...]:
    """Return no link with two joints."""
    return ()


def body(mechanism: Mechanism) -> Body:
    """Return the slider for the links attached to it."""
    return slide_on_frame(mechanism).body
