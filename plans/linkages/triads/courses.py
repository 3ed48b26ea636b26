"""One course on which groups of class III are followed: the position plan that is asked for again and again."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...board import Program, RecordingBoard, Step
from ...boards.arrays import ArrayBoard
from ...boards.batch import FEW, batch
from ...boards.exact import run
from ...boards.template import ASTRAY, CLOSED, FOLDED
from ...laws import TURN
from ...names import role
from ..chain import construct
from ..mechanism import Driver, Mechanism, start_names
from ..parts import local_mark

Array = NDArray[np.float64]
Places = NDArray[np.intp]
Poses = dict[str, Array]  # near_x, near_y, near_c, near_s of every central link, by name

CRANK_GRID = math.radians(5.0)
SLIDE_GRID = 1.0 / 16.0  # of a central link's length
LEAST = 2.0**-30  # part of a step of the grid: shorter steps lead nowhere
SURE = 0.25  # second correction over the first up to which Newton's method surely stays on its branch
SETTLING = 6  # runs of the position plan that lay a template down from its rough start
FAR = 0.75  # how far it may move from there: in its sizes, and as the sine of its turn
SAME = 1e-6  # part of its size, and angle, up to which a link lies as before
AT = "_followed_at"
PARTS = ("place", "turn", "determinant", "apart", "doubt", "missing")


@dataclass(frozen=True, slots=True, eq=False)
class State:
    """Where the driver is, how the central links lie there, and the signs of their determinants, shape (N,) each."""

    at: Array
    poses: Poses
    signs: dict[int, Array]

    def take(self, which: Any) -> State:
        """Return part of the positions, by a mask or by places."""
        poses = {name: array[which] for name, array in self.poses.items()}
        return State(self.at[which], poses, {number: array[which] for number, array in self.signs.items()})

    def put(self, places: Places, other: State) -> None:
        """Write the positions of another state into some places."""
        self.at[places] = other.at
        for name, array in self.poses.items():
            array[places] = other.poses[name]
        for number, array in self.signs.items():
            array[places] = other.signs[number]


def joined(states: Sequence[State]) -> State:
    """Return several states as one."""
    first = states[0]
    return State(
        np.concatenate([state.at for state in states]),
        {name: np.concatenate([state.poses[name] for state in states]) for name in first.poses},
        {number: np.concatenate([state.signs[number] for state in states]) for number in first.signs},
    )


class Course:
    """The position plan of a mechanism up to the last of some groups of class III, whose central links are `numbers`.

    `count` is the number of mechanisms: one, unless `values` has arrays for their dimensions.
    """

    def __init__(self, mechanism: Mechanism, values: Mapping[str, Any], numbers: Sequence[int]) -> None:
        driver = mechanism.driver
        own = replace(driver, angle=AT) if isinstance(driver, Driver) else replace(driver, travel=AT)
        self._mechanism = replace(mechanism, driver=own, loads=(), couples=())
        self.numbers = tuple(numbers)
        program = construct(self._mechanism, ("position",))[1]
        templates = {step.operands[1]: step for step in reversed(program.which(("template",)))}
        self._first = {n: templates[start_names(n)[0]] for n in numbers}
        extra = [
            Step(f"template_{part}", f"_{part}_{n}", step.operands[1:])
            for n, step in self._first.items()
            for part in PARTS
        ]
        self._wanted = [step.name for step in extra]
        self._program = Program((*program.steps, *extra)).needed_for(self._wanted)
        self._rough = self._starting()
        needed = {name for step in (*self._program, *self._rough) for name in step.operands}
        self._values: dict[str, Any] = {  # a number that stands alone in an array is one for all
            name: float(value[0]) if np.ndim(value) and len(value) == 1 else value
            for name, value in values.items()
            if name in needed
        }
        self.count = max((len(value) for value in self._values.values() if np.ndim(value)), default=1)
        self._nodes: dict[int, State] = {}
        self.start: State  # one for all mechanisms, or one for each: see `settle`
        sides = self._run(self._rough, self._joints(), {}, np.arange(self.count))
        a, b, c = (sides[name] for name in self._joints())  # the largest distance of two joints, for each mechanism
        self.size = np.array(np.broadcast_to(np.max(np.abs([a - b, b - c, c - a]), axis=0), self.count))
        self._turns = isinstance(driver, Driver)
        self._steps = np.full(self.count, CRANK_GRID) if self._turns else SLIDE_GRID * self.size

    def _starting(self) -> Program:
        """Record where the last central link's first joint and x axis are at the start, and its joints on it."""
        number = self.numbers[-1]
        start, board = self._mechanism.start(number), RecordingBoard()
        assert start is not None
        for opposite, length in self._mechanism.opposites.items():
            board.calc(opposite, "opposite", length)
        board.place("_start", start.x, start.y)
        board.turn("_start_turn", start.angle)
        for mark in self._joints():
            local_mark(board, self._mechanism.link(number), role(mark).of)
        board.incline("_start_arm", "_start_turn", self._joints()[0])
        board.chain("_start_joint", "_start", "_start_arm")
        return Program(board.steps)

    def _joints(self) -> tuple[str, str, str]:
        """Names of the joints of the last central link on a drawing of its own."""
        names = self._first[self.numbers[-1]].operands
        return names[ASTRAY + 2], names[ASTRAY + 6], names[ASTRAY + 10]

    def _run(self, program: Program, wanted: Sequence[str], more: Mapping[str, Array], which: Places) -> dict[str, Any]:
        """Run a program for some mechanisms; the results have the shape of what varies."""
        values = self._values
        if self.count > 1:
            values = {name: value[which] if isinstance(value, np.ndarray) else value for name, value in values.items()}
        values = {**values, **more}
        size = len(which) if more or self.count > 1 else 1
        if size == 1:
            one = {name: float(value[0]) if isinstance(value, np.ndarray) else value for name, value in values.items()}
            board = run(program, one)
            return {name: np.array([board.values[name]]) for name in wanted}
        if size > FEW:
            return batch(program, values, wanted)[0]
        many = ArrayBoard(values, size)
        with np.errstate(invalid="ignore", divide="ignore"):
            program.run(many)
        return {name: many.values[name] for name in wanted}

    def _of(self, each: Array, which: Places) -> Array:
        """Return what there is one of for each mechanism, for some of them."""
        return each[which] if self.count > 1 else np.broadcast_to(each, len(which))

    def settle(self, at: Array, poses: Poses) -> None:
        """Lay the last central link down near where the task says that it starts, those before lie as in `poses`.

        Where that fails the driver is nowhere, and the link stays at its rough start.
        """
        which = np.arange(len(at))
        found = self._run(self._rough, ("_start_joint", "_start_turn"), {}, which)
        place, turn = (np.broadcast_to(found[name], len(at)) for name in ("_start_joint", "_start_turn"))
        x, y, c, s, _ = start_names(self.numbers[-1])
        rough = {**poses, x: place.real, y: place.imag, c: turn.real, s: turn.imag}
        look = self._look(at, rough, which)
        for _ in range(SETTLING - 1):
            look = self._look(at, look.poses, which)
        number = self.numbers[-1]
        moved = np.abs(look.found[f"_place_{number}"] - place) / self._of(self.size, which)
        turned = look.found[f"_turn_{number}"] * turn.conj()
        held = look.closed & (moved <= FAR) & (np.abs(turned.imag) <= FAR) & (turned.real > 0.0)
        state = look.state(np.where(held, at, np.nan))
        state.put(np.flatnonzero(~held), State(state.at, rough, state.signs).take(~held))
        self.start = state

    def near(self, goal: Array) -> Poses:
        """Return the givens of the last group of the course, at any positions of the driver."""
        goal = np.broadcast_to(goal, max(len(goal), len(self.start.at)))
        state = self.go(self._within(goal))
        lost = np.flatnonzero(state.at != self._within(goal))
        if self._turns and len(lost):
            self._other_way(state, goal, lost)
            lost = lost[state.at[lost] != self._within(goal)[lost]]
        astray = np.zeros(len(goal))
        if len(lost):
            astray[lost] = self._astray(state, goal, lost)
        x, y, c, s, way = start_names(self.numbers[-1])
        return {**{name: state.poses[name] for name in (x, y, c, s)}, way: astray}

    def _within(self, goal: Array) -> Array:
        """Return positions of a crank less whole turns, where the group comes back after one or cannot make it."""
        if not self._turns:
            return goal
        whole = np.trunc((goal - self.start.at) / TURN)
        far = np.flatnonzero(np.abs(whole) >= 1.0)
        if not len(far):
            return goal
        goal = goal.copy()
        start = self._starts(len(goal)).take(far)
        once = start.at + np.copysign(TURN, whole[far])
        after = self._follow(self.start if len(self.start.at) == 1 else start, once, far)
        goal[far] -= np.where((after.at != once) | self._same(after, start, far), whole[far] * TURN, 0.0)
        return goal

    def _starts(self, count: int) -> State:
        return self.start.take(np.zeros(count, int) if len(self.start.at) == 1 else np.arange(count))

    def go(self, goal: Array, which: NDArray[np.intp] | None = None) -> State:
        """Return the state at `goal`, or where the way to it ends; `which` are the mechanisms."""
        which = np.arange(len(goal)) if which is None else which
        start = self.start if len(self.start.at) == 1 else self.start.take(which)
        return self._follow(start, goal, which)

    def _other_way(self, state: State, goal: Array, lost: NDArray[np.intp]) -> None:
        """Try to come round the other way, where that way does not lead past the place at which this one ends.

        If it does, the crank has two positions for that angle, and a sweep would jump from one to the other.
        """
        start, within = self._starts(len(goal)).at[lost], self._within(goal)[lost]
        back = np.copysign(TURN, within - start)
        found, end = self.go(within - back, lost), self.go(state.at[lost] - back, lost)
        there = (found.at == within - back) & (end.at != state.at[lost] - back)
        arrived = found.take(there)
        arrived.at[:] = within[there]
        state.put(lost[there], arrived)

    def _look(self, at: Array, poses: Poses, which: Places) -> _Look:
        """Lay all templates down with the driver at `at`, from where they lie."""
        still = {start_names(number)[ASTRAY]: np.zeros(len(at)) for number in self.numbers}
        found = self._run(self._program, self._wanted, {AT: at, **poses, **still}, which)
        if len(at) > 1:
            found = {name: np.broadcast_to(value, len(at)) for name, value in found.items()}
        return _Look(self.numbers, found)

    def _follow(self, start: State, goal: Array, which: Places) -> State:
        """Follow from one start, or one for each, as far towards `goal` as it goes; `which` are the mechanisms."""
        grid = self._of(self._steps, which)
        ahead = np.trunc((goal - start.at) / grid)
        ahead = np.where(np.isfinite(ahead), ahead, 0.0).astype(int)
        if len(start.at) == 1 and self.count == 1:
            state = self._from_nodes(start, ahead)
        else:
            state = start.take(np.arange(len(goal)) if len(start.at) > 1 else np.zeros(len(goal), int))
            passed = np.zeros(len(goal), int)
            for node in range(1, int(np.max(np.abs(ahead), initial=0)) + 1):
                before, passed = passed, np.sign(ahead) * np.minimum(node, np.abs(ahead))
                self._advance(state, start.at + before * grid, start.at + passed * grid, which)
        self._advance(state, start.at + ahead * grid, goal, which)
        return state

    def _from_nodes(self, start: State, ahead: NDArray[np.int_]) -> State:
        """Return states at nodes of the grid, each found once."""
        self._nodes.setdefault(0, start)
        for last in (int(np.max(ahead, initial=0)), int(np.min(ahead, initial=0))):
            sense = 1 if last > 0 else -1
            for node in range(sense, last + sense, sense):
                if node not in self._nodes:
                    state = self._nodes[node - sense].take(np.zeros(1, int))
                    before, there = (start.at + number * self._steps for number in (node - sense, node))
                    self._advance(state, before, there, np.zeros(1, int))
                    self._nodes[node] = state
        return joined([self._nodes[node] for node in ahead.tolist()])

    def _advance(self, state: State, before: Array, goal: Array, which: Places) -> None:
        """Move states on to `goal`, in steps that keep the branch, as far as they go.

        A state that has not come as far as `before` stands in a dead position, and stays there.
        """
        goal = np.broadcast_to(goal, len(state.at))
        least = LEAST * self._of(self._steps, which)
        active = np.flatnonzero((state.at != goal) & (state.at == before))
        step = (goal - state.at)[active]
        while len(active):
            here, rest = state.take(active), goal[active] - state.at[active]
            ahead = np.where(np.abs(step) >= np.abs(rest), goal[active], here.at + step)
            look = self._look(ahead, here.poses, which[active])
            sure = look.sure(here.signs)
            state.put(active[sure], look.state(ahead).take(sure))
            step = np.where(sure, step * 2.0, (ahead - here.at) * 0.5)
            going = (state.at[active] != goal[active]) & (np.abs(step) > least[active])
            active, step = active[going], step[going]

    def _same(self, one: State, other: State, which: Places) -> NDArray[np.bool_]:
        """Tell where the last central link lies in two states alike, or nearly."""
        x, y, c, s, _ = start_names(self.numbers[-1])
        apart = [np.abs(one.poses[name] - other.poses[name]) for name in (x, y, c, s)]
        size = self._of(self.size, which)
        same: NDArray[np.bool_] = np.max([apart[0] / size, apart[1] / size, *apart[2:]], axis=0) <= SAME
        return same

    def _astray(self, state: State, goal: Array, lost: Places) -> Array:
        """Return how far the legs of the last group are from its joints, where the driver stands at `goal` in vain.

        Just at a dead position it is zero, and the pose is refined: it is singular, not out of reach.
        """
        here = state.take(lost)
        look = self._look(goal[lost], here.poses, lost)
        missing = look.found[f"_missing_{self.numbers[-1]}"]
        for _ in range(SETTLING):
            look = self._look(goal[lost], look.poses, lost)
        near = np.abs(goal[lost] - here.at) <= 8.0 * LEAST * self._of(self._steps, lost)
        dead = near & look.folded
        state.put(lost[dead], look.state(goal[lost]).take(dead))
        return np.where(dead, 0.0, np.where(missing > 0.0, missing, np.nan))


@dataclass(frozen=True, slots=True)
class _Look:
    """What a run of the position plan says of every central link."""

    numbers: tuple[int, ...]
    found: Mapping[str, Array]

    @property
    def poses(self) -> Poses:
        """Where the links lie now."""
        poses: Poses = {}
        for number in self.numbers:
            place, turn = self.found[f"_place_{number}"], self.found[f"_turn_{number}"]
            poses |= zip(start_names(number), (place.real, place.imag, turn.real, turn.imag), strict=False)
        return poses

    def state(self, at: Array) -> State:
        """Return the links as a state."""
        signs = {number: np.sign(self.found[f"_determinant_{number}"]) for number in self.numbers}
        return State(np.array(at), {name: np.array(array) for name, array in self.poses.items()}, signs)

    def _all(self, part: str, most: float) -> NDArray[np.bool_]:
        held: NDArray[np.bool_] = np.logical_and.reduce([self.found[f"_{part}_{n}"] <= most for n in self.numbers])
        return held

    @property
    def closed(self) -> NDArray[np.bool_]:
        """Whether the legs reach their joints."""
        return self._all("apart", CLOSED)

    @property
    def folded(self) -> NDArray[np.bool_]:
        """Whether the legs of the last one concur."""
        folded: NDArray[np.bool_] = np.abs(self.found[f"_determinant_{self.numbers[-1]}"]) < FOLDED
        return folded

    def sure(self, signs: Mapping[int, Array]) -> NDArray[np.bool_]:
        """Whether the links are still on the branch with these signs."""
        kept = [np.sign(self.found[f"_determinant_{n}"]) == signs[n] for n in self.numbers]
        held: NDArray[np.bool_] = np.logical_and.reduce([self.closed, self._all("doubt", SURE), *kept])
        return held
