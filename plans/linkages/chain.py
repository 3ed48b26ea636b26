"""The whole chain for a mechanism: which constructions, on which plans, in order of attachment and back.

The drivers begin it: a crank about a fixed pivot, a slider on the frame. What keeps a driver moving follows from the
moments of its forces, and a second time from the lever.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from importlib import import_module
from typing import ClassVar

from ...scales.errors import InputError
from ...scales.kept import Kept
from ..board import Board, Program, RecordingBoard, Step, with_needs
from ..names import NORMAL, Name, by_lever, couple, lever_arm, mark, moment, role, spelled, vector
from ..quantities import F_BAL, M_BAL
from . import compound
from .legs import AssurGroup, Slide
from .loads import Moving, hung, lay_loads, needs_stroke
from .mechanism import FRAME, MOMENT, ZERO, Driver, Mechanism, Prismatic, SlidingDriver
from .parts import SYMBOLS, Bodies, Body, Couples, Forces, Plan, Polygon, Span, moments_about
from .structure import KINDS, TRIAD, Structure, analyse

NEEDS: dict[str, tuple[str, ...]] = {  # all plans in order of construction, with those they are built on
    **dict.fromkeys(("structure", "position"), ()),
    **dict.fromkeys(("dead", "velocity"), ("position",)),
    "acceleration": ("velocity",),
    **dict.fromkeys(("compound", "forces", "lever", "cycle"), ("acceleration",)),
}
PLANS = tuple(NEEDS)
USUAL = tuple(plan for plan in PLANS if plan not in ("dead", "compound", "cycle"))  # without a word on which are wanted
_CONSTRUCTED = Kept[tuple[Structure, Program]](16)
_BODIES = Kept[Bodies](16)
Ends = tuple[str, str, str, str]  # two points that turn together, the normal to their line, their distance
# modules with the groups of each kind, and their classes, which a mechanism without such a group does without
CONSTRUCTIONS = {kind: ("dyads", kind) for kind in KINDS} | {TRIAD: ("triad", "Triad")}


class _Crank:
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


class _SlidingBlock:
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


def construct(mechanism: Mechanism, plans: Iterable[str] = USUAL) -> tuple[Structure, Program]:
    """Find the structure and record the construction of `plans` (and of the plans they need).

    Raises InputError: when the mechanism has no structure of known groups, or a name stands for two things.
    """
    structure, board, plans = analyse(mechanism), RecordingBoard(), with_needs(plans, NEEDS)
    for opposite, length in mechanism.opposites.items():
        board.calc(opposite, "opposite", length)
    driver, groups, bodies = named(mechanism, structure)
    if "position" in plans:
        driver.position(board)
        for point, place in mechanism.frame_points.items():
            board.place(point, *place)
        for group in groups:
            group.position(board)
    for name in (name for name in SYMBOLS if name in plans):
        plan = Plan(board, mechanism, name)
        driver.move(plan)
        for group in groups:
            group.move(plan)
    if "compound" in plans:
        compound.compound(board, compound.couplers(mechanism, groups, bodies))
    if "forces" in plans or "lever" in plans:
        _statics(board, plans, driver, groups, bodies)
    program = Program(board.steps)
    for name in sorted(mechanism.givens.intersection(program.names)):
        raise InputError("name-twice", name=name)
    return structure, program


def constructed(mechanism: Mechanism, plans: Iterable[str] = USUAL) -> tuple[Structure, Program]:
    """Return what `construct` finds; kept, for a class has one mechanism with many values."""
    wanted = tuple(plans)
    return _CONSTRUCTED.get((mechanism.written, wanted), lambda: construct(mechanism, wanted))


def _statics(
    board: RecordingBoard,
    plans: Collection[str],
    driver: _Crank | _SlidingBlock,
    groups: Sequence[AssurGroup],
    bodies: Bodies,
) -> None:
    """Lay down the loads; plans of forces, the lever, and their difference, as far as they are wanted."""
    mechanism = driver.mechanism
    spans = {span.number: span for part in (driver, *groups) for span in part.spans}
    resisting = any(couple.sense is None for couple in mechanism.couples) or needs_stroke(mechanism)
    turning = driver.turning_rate(board) if resisting else ZERO
    lay_loads(board, Moving(mechanism, bodies, spans, vector("V", mechanism.driver.point).size, turning))
    if "forces" in plans:
        _forces(board, driver, groups, bodies)
    if "lever" in plans:
        driver.on_lever(board, _lever(board, mechanism, spans, bodies))
    if "forces" in plans and "lever" in plans:
        board.calc(spelled("delta", driver.balance), "difference", by_lever(driver.balance), driver.balance)


def hinged(mechanism: Mechanism, structure: Structure) -> tuple[compound.Coupler, ...]:
    """Return the couplers whose motion the plan `compound` splits."""
    return compound.couplers(mechanism, *named(mechanism, structure)[1:])


def moving_bodies(mechanism: Mechanism, structure: Structure) -> Bodies:
    """Return how every moving link is known: a direction that turns with it, its angular velocity, by number."""
    return _BODIES.get(mechanism.written, lambda: named(mechanism, structure)[2])


def named(
    mechanism: Mechanism, structure: Structure
) -> tuple[_Crank | _SlidingBlock, tuple[AssurGroup, ...], dict[int, Body]]:
    """Name the parts of the driver and of all groups, each for those attached to it."""
    for group in structure.groups:
        if group.kind not in CONSTRUCTIONS:
            raise InputError("no-construction", kind=group.kind, links=", ".join(map(str, group.links)))
    driver = _driver_of(mechanism)
    bodies = {mechanism.driver.link: driver.body}
    groups: list[AssurGroup] = []
    for group in structure.groups:
        module, kind = CONSTRUCTIONS[group.kind]
        groups.append(getattr(import_module(f".{module}", __package__), kind)(mechanism, group, bodies))
        bodies |= {body.link.number: body for body in groups[-1].bodies}
    for span in (span for part in (driver, *groups) for span in part.spans):
        if span.link.points[span.start] == span.link.points[span.end]:  # by the form of the mechanism
            raise InputError("joints-coincide", link=span.number, first=span.start, second=span.end)
    return driver, tuple(groups), bodies


def _driver_of(mechanism: Mechanism) -> _Crank | _SlidingBlock:
    """Return the constructions of the mechanism's driver.

    Raises InputError: when a sliding driver has no pair with the frame, or the frame is said to be its slider.
    """
    driver = mechanism.driver
    if isinstance(driver, Driver):
        return _Crank(mechanism, driver)
    for pair in mechanism.pairs:
        if isinstance(pair, Prismatic) and {*pair.links} == {FRAME, driver.link}:
            return _SlidingBlock(mechanism, driver, pair)
    raise InputError("driver-guide", link=driver.link)


def _forces(
    board: RecordingBoard, driver: _Crank | _SlidingBlock, groups: Sequence[AssurGroup], bodies: Bodies
) -> None:
    """Solve the groups from the last to the first, pass each reaction on to the link it acts on, balance the driver."""
    forces, couples = hung(driver.mechanism, bodies)
    reactions: Forces = {link: {} for link in forces}
    for group in reversed(groups):
        for body in group.bodies:
            forces[body.link.number] |= reactions[body.link.number]
        group.forces(board, forces, couples)
        for force, link, point, moment_beside in group.passed:
            if link != FRAME:
                reactions[link][force] = point
                couples[link] += [moment_beside] if moment_beside else []
    first = driver.body.link.number
    forces[first] = reactions[first] | forces[first]
    driver.forces(board, forces, couples)


def _lever(board: RecordingBoard, mechanism: Mechanism, spans: Mapping[int, Span], bodies: Bodies) -> list[Name]:
    """Hang all forces on the lever, and the couples: as pairs of forces where two points are known, else as powers.

    Returns their moments.
    """
    forces, couples = hung(mechanism, bodies)
    ends: dict[int, Ends] = {number: (span.start, span.end, span.n, span.length) for number, span in spans.items()}
    by_rate = {omega: both for number, both in ends.items() if (omega := bodies[number].omega)}
    pairs = [(couple, both) for number, both in ends.items() for couple in couples[number]]
    turning = []
    for number, omega in ((n, bodies[n].omega) for n in couples if n not in spans):
        points = _points_of(omega, board.steps, by_rate) if omega else None
        pairs += [(couple, points) for couple in couples[number] if points]
        turning += [(couple, omega) for couple in couples[number] if omega and not points]
    moving = [(force, at) for link in forces.values() for force, at in link.items() if at not in mechanism.frame_points]
    moments = _on_lever(board, mechanism, moving, pairs)
    for turns, omega in turning:
        moments.append(Name(f"_{turns}_p", "M", role(turns).of, "p"))
        board.calc(moments[-1], "couple_on_lever", turns, omega)
    return moments


def _on_lever(
    board: Board, mechanism: Mechanism, forces: list[tuple[str, str]], couples: list[tuple[str, Ends]]
) -> list[Name]:
    """Hang `forces` (name, point) and `couples` (moment, points A, B) on the turned plan; return their moments.

    A couple hangs as two equal opposite forces M / l_AB at B and A, normal to AB.
    """
    still = mechanism.frame_points
    board.pole("lever.p")
    points = [mechanism.driver.point, *(at for _, at in forces), *(p for _, both in couples for p in both[:2])]
    for point in dict.fromkeys(point for point in points if point not in still):
        board.normal(f"lever.{point}", f"velocity.{point}")
    moments: list[Name] = []
    for force, at in forces:
        moments.append(moment(force, "p"))
        board.moment(moments[-1], lever_arm(force), force, f"lever.{at}", "lever.p")
    for turns, (A, B, n, length) in couples:
        half = partial(couple, turns)
        board.calc(half(), "couple", turns, length)
        board.calc(half(B), "along", half(), n)
        board.calc(half(A), "opposite", half(B))
        for point in (p for p in (B, A) if p not in still):
            moments.append(moment(half(point), "p"))
            board.moment(moments[-1], lever_arm(turns, point), half(point), f"lever.{point}", "lever.p")
    return moments


def _points_of(omega: str, steps: Iterable[Step], known: Mapping[str, Ends]) -> Ends | None:
    """Return two points with images on the plan that turn with the angular velocity `omega`, if any are known.

    They are the joints of a link that turns so, or those from whose relative velocity it was read: a sliding block
    turns with its guide, and the guide by the velocity of its point under the block's pin.
    """
    made = {step.name: step for step in steps}
    while omega not in known and omega in made and made[omega].law == "same_turning":
        omega = made[omega].operands[0]
    if omega in known or omega not in made or made[omega].law != "turning":
        return known.get(omega)
    vector, normal, length = made[omega].operands
    start, end = made[made[normal].operands[0]].operands[:2]
    point = role(made[vector].operands[1]).of  # the pin itself, or the point of the link under it
    return start, point if end in (point, role(point).of) else end, normal, length
