"""The drivers: a crank about a fixed pivot, a slider on the frame. Their plans, and what balances them.

What keeps a driver moving follows from the moments of its forces, and a second time from the lever.
"""

from __future__ import annotations

from dataclasses import replace
from typing import ClassVar

from ...scales.errors import InputError
from ..board import Board
from ..names import NORMAL, Name, by_lever, mark, vector
from ..quantities import F_BAL, M_BAL
from .legs import Slide
from .mechanism import FRAME, MOMENT, ZERO, Driver, Mechanism, Prismatic, SlidingDriver
from .parts import Couples, Forces, Plan, Polygon, Span, moments_about


def driver_of(mechanism: Mechanism) -> Crank | SlidingBlock:
    """Return the constructions of the mechanism's driver.

    Raises
    ------
    InputError
        When a sliding driver has no pair with the frame, or the frame is said to be its slider.
    """
    driver = mechanism.driver
    if isinstance(driver, Driver):
        return Crank(mechanism, driver)
    for pair in mechanism.pairs:
        if isinstance(pair, Prismatic) and {*pair.links} == {FRAME, driver.link}:
            return SlidingBlock(mechanism, driver, pair)
    raise InputError("driver-guide", link=driver.link)


class Crank:
    """The crank OA between its pivot and its pin."""

    def __init__(self, mechanism: Mechanism, driver: Driver) -> None:
        self.mechanism, self.driver = mechanism, driver
        self.span = Span(mechanism.link(driver.link), driver.pivot, driver.point)
        self.spans = (self.span,)
        self.body = self.span.body if driver.acceleration else replace(self.span.body, epsilon=None)
        self.balance = M_BAL if driver.balance == MOMENT else F_BAL  # of the lever it has `_lever` behind it

    def turning_rate(self, board: Board) -> str:
        """Return the name of the angular velocity beside which another one is rounding."""
        return self.span.omega

    def position(self, board: Board) -> None:
        """Mark the pivot, lay off the crank at its angle."""
        driver, crank = self.driver, self.span
        board.place(driver.pivot, *self.mechanism.frame_points[driver.pivot])
        board.turn(crank.e, driver.angle)
        crank.measure(board)
        board.lay(driver.point, driver.pivot, crank.e, crank.length)
        crank.place(board, turned=True)

    def move(self, plan: Plan) -> None:
        """v_A = omega_1 * l_OA is normal to the crank in the sense of omega_1.

        a_A = omega_1^2 * l_OA points from A to O, and epsilon_1 * l_OA across unless the crank turns steadily.
        """
        board, driver, crank = plan.board, self.driver, self.span
        moves, pole, tip = vector(plan.symbol, crank.end), f"{plan.name}.p", mark(plan.name, crank.end)
        if plan.symbol == "V":
            board.calc(crank.omega, "signed", driver.speed, driver.sense)
            board.calc(moves.size, "circular_speed", crank.omega, crank.length)
            board.pole(pole)
            board.lay(tip, pole, crank.n, moves.size)
        else:
            normal = mark(plan.name, crank.end, NORMAL) if driver.acceleration else tip
            board.calc(moves.size, "centripetal", crank.omega, crank.length)
            board.pole(pole)
            board.back(normal, pole, crank.e, moves.size)
            if driver.acceleration:
                across = vector("a", crank.end, part="t")
                board.calc(crank.epsilon, "signed", driver.acceleration, driver.sense)
                board.calc(across.size, "circular_acceleration", crank.epsilon, crank.length)
                board.lay(tip, normal, crank.n, across.size)
                board.read(vector("a", crank.end, part="n"), pole, normal)
                board.read(across, normal, tip)
        plan.read(crank.end)
        crank.mark_others(plan)

    def forces(self, board: Board, loads: Forces, couples: Couples) -> None:
        """Balance the crank by the moments about its pivot; R_01 closes the plan of its loads.

        M_bal is a moment beside the loads; F_bal, at the crank pin along the normal to the crank, stands in the plan.
        """
        link, crank, hung = self.driver.link, self.span, [*loads[self.driver.link]]
        if self.balance == F_BAL:
            moments = moments_about(board, loads[link], crank.start, always=True)
            board.calc(F_BAL, "closing_force", crank.length, *moments, *couples[link])
            board.calc(F_BAL.size, "along", F_BAL, crank.n)
            hung.append(F_BAL.size)
        plan = Polygon(board, link)
        plan.read(self.mechanism.pair("R", FRAME, link), plan.hang(*hung), 0)
        if self.balance == M_BAL:
            moments = moments_about(board, loads[link], crank.start, always=True)
            board.calc(M_BAL, "closing_moment", *moments, *couples[link])

    def on_lever(self, board: Board, moments: list[Name]) -> None:
        """Solve the moments of the lever for a force at the crank pin, along the normal to the crank.

        On the turned plan it has the moment -F * pa about the pole.
        """
        force = F_BAL if self.balance == M_BAL else by_lever(F_BAL)
        board.calc(force, "moment_equation", vector("V", self.driver.point).size, *moments)
        board.calc(force.size, "along", force, self.span.n)
        if self.balance == M_BAL:
            board.calc(by_lever(M_BAL), "crank_moment", force, self.span.length)


class SlidingBlock:
    """A slider on the frame: P is the point that runs in the guide, u the guide's direction."""

    spans: ClassVar[tuple[Span, ...]] = ()  # it has no two joints
    balance: ClassVar[Name] = F_BAL

    def __init__(self, mechanism: Mechanism, driver: SlidingDriver, pair: Prismatic) -> None:
        self.mechanism, self.driver = mechanism, driver
        self.slide = Slide(mechanism, pair, driver.link, driver.point, {})
        self.body = self.slide.body

    def turning_rate(self, board: Board) -> str:
        """Return the name of an angular velocity beside which another one is rounding: v_P over all lengths."""
        board.calc("_reach", "reach", *dict.fromkeys(xy for xy in self.mechanism.coordinates if xy != ZERO))
        board.calc("_omega", "rate_over", vector("V", self.driver.point).size, "_reach")
        return "_omega"

    def position(self, board: Board) -> None:
        """Lay off the travel along the guide."""
        start, _, u = self.slide.path(board)
        board.lay(self.driver.point, start, u, self.driver.travel)
        self.slide.place(board)

    def move(self, plan: Plan) -> None:
        """v_P and a_P are given along the guide; the slider does not turn, and all its points move alike."""
        driver, board, moves = self.driver, plan.board, vector(plan.symbol, self.driver.point)
        board.calc(moves.size, "given", driver.speed if plan.symbol == "V" else driver.acceleration or ZERO)
        board.pole(f"{plan.name}.p")
        board.lay(mark(plan.name, driver.point), f"{plan.name}.p", self.slide.u, moves.size)
        plan.read(driver.point)
        self.body.move_points(plan)

    def forces(self, board: Board, loads: Forces, couples: Couples) -> None:
        """Balance the slider: through the ends of its loads the guide and the normal to it, F_bal along u, R_01 across.

        Moments about P give the arm of the guide's reaction.
        """
        link, u, reaction, couple = self.driver.link, self.slide.u, self.slide.outer("R"), self.slide.outer("M")
        plan = Polygon(board, link)
        last, closing = plan.hang(*loads[link]), plan.close(u, self.slide.e)
        plan.read(F_BAL.size, last, closing)
        plan.read(reaction, closing, 0)
        board.calc(F_BAL, "component", u, F_BAL.size)
        moments = moments_about(board, loads[link], self.driver.point)
        board.calc(couple, "closing_moment", ZERO, *moments, *couples[link])
        board.step("arm", self.slide.outer("h"), couple, reaction)

    def on_lever(self, board: Board, moments: list[Name]) -> None:
        """Solve the moments of the lever for a force at P along the guide: on the turned plan its moment is -F * pp."""
        board.calc(by_lever(F_BAL), "moment_equation", vector("V", self.driver.point).size, *moments)
        board.calc(by_lever(F_BAL).size, "along", by_lever(F_BAL), self.slide.u)
