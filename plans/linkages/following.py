"""Groups of class III are followed: from where the task says that they start to where the driver is wanted.

Such a group has up to six positions for one of the driver, and no sign that tells them apart. So its central link is
laid down near the place that the task names, and moved on with the driver in steps so small that Newton's method stays
on one branch: its second correction must be a small part of the first (then no other position is as near), and the
determinant of the legs must keep its sign. Where that fails the step is halved, down to nothing in a dead position.

The way leads over a grid of the driver's positions that begins at the start. So what is found for one position does not
depend on which others are asked for with it, to the last bit.

Any two legs of a group may make its special point, but where two legs are nearly parallel their lines meet far away,
and where the special point stands in the joint of the third leg nothing turns about it. The choice is data of the
construction: `Start.legs`.

Source of the criterion: Deuflhard, Newton methods for nonlinear problems, chapter 5 (adaptive pathfollowing).
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from itertools import combinations
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..board import Program, RecordingBoard, Step
from ..boards.arrays import ArrayBoard
from ..boards.batch import FEW, batch
from ..boards.exact import ILL, SMALL, run
from ..boards.template import ASTRAY, CLOSED, FOLDED
from ..laws import TURN
from ..names import role
from .chain import construct, named
from .mechanism import Driver, Mechanism, start_names
from .parts import local_mark
from .structure import TRIAD, analyse
from .triad import Triad

Array = NDArray[np.float64]
Places = NDArray[np.intp]
Poses = dict[str, Array]  # near_x, near_y, near_c, near_s of every central link, by name
# float64 of shape (rows, N): where the driver is, then of every central link its pose and the sign of its determinant
State = Array
Legs = tuple[int, int]

CRANK_GRID = math.radians(5.0)
SLIDE_GRID = 1.0 / 16.0  # of a central link's length
LEAST = 2.0**-30  # part of a step of the grid: shorter steps lead nowhere
SURE = 0.25  # second correction over the first up to which Newton's method surely stays on its branch
SETTLING = 6  # runs of the position plan that lay a template down from its rough start
FAR = 0.75  # how far it may move from there: in its sizes, and as the sine of its turn
SAME = 1e-6  # part of its size, and angle, up to which a link lies as before
AT = "_followed_at"
PARTS = ("place", "turn", "determinant", "apart", "doubt", "missing")


class Follower:
    """The groups of class III of one mechanism with its numbers in SI, or of N where these are arrays of shape (N,).

    They are known at any positions of the driver: that among the numbers does not matter.
    """

    def __init__(self, mechanism: Mechanism, values: Mapping[str, Any]) -> None:
        self._turns = isinstance(mechanism.driver, Driver)
        self._courses: list[_Course] = []
        numbers = triads(mechanism)
        for count, number in enumerate(numbers, start=1):
            course = _Course(mechanism, values, numbers[:count])
            start = mechanism.start(number)
            assert start is not None
            at = np.atleast_1d(np.asarray(values.get(start.driver, 0.0), float))
            at = np.broadcast_to(at, max(len(at), course.count))
            course.settle(at, self.near(at))  # from where the central links lie that are followed already
            self._courses.append(course)

    def near(self, at: Array) -> Poses:
        """Return the board's givens that say where each central link lies, about, with the driver at `at`.

        `at`, float64 of shape (N,), is in radians, or metres of a slide. Each group has five givens of that shape, see
        `start_names`; one of them is not zero where it cannot come from its start, so that the board refuses.
        """
        found: Poses = {}
        for course in self._courses:
            found |= course.near(at)
        return found

    @property
    def places(self) -> Array:
        """Places of the driver that stand for all: around a crank's circle, a slide's start."""
        start = self._courses[-1].start[0, :1]
        return start + np.arange(-36, 37) * (TURN / 72) if self._turns else start

    def limits(self, range_of: float = TURN) -> tuple[float, float] | None:
        """Return how far the driver of one mechanism can go from the start of its last group, down and up.

        The groups come to a dead position there, to 1e-9 rad; after `range_of` the search ends. None when nothing can
        be laid down.
        """
        course = self._courses[-1]
        start = float(course.start[0, 0])
        if not math.isfinite(start):
            return None
        low, high = course.go(np.array([start - range_of, start + range_of]), np.arange(2))[0]
        return float(low), float(high)


def triads(mechanism: Mechanism) -> list[int]:
    """Return the central links of the groups of class III, in order of attachment."""
    return [group.central for group in analyse(mechanism).groups if group.kind == TRIAD]


def followed(mechanism: Mechanism, values: Mapping[str, Any]) -> dict[str, Any]:
    """Return the board's givens that say where the central link of every group of class III lies, about.

    The `values` are numbers or float64 arrays of shape (N,) in SI, the driver's position among them. A mechanism
    without such groups needs none. For many positions of one mechanism, asked for again and again, keep a `Follower`.
    """
    if not mechanism.starts:
        return {}
    at = np.asarray(values[mechanism.driver.coordinate], float)
    found = Follower(mechanism, values).near(np.atleast_1d(at))
    if all(len(array) == 1 for array in found.values()) and not at.ndim:
        return {name: float(array[0]) for name, array in found.items()}
    return found


class _Course:
    """The position plan of a mechanism up to the last of some groups of class III, whose central links are `numbers`.

    `count` is the number of mechanisms: one, unless `values` has arrays for their dimensions.
    """

    def __init__(self, mechanism: Mechanism, values: Mapping[str, Any], numbers: Sequence[int]) -> None:
        driver = mechanism.driver
        own = replace(driver, angle=AT) if isinstance(driver, Driver) else replace(driver, travel=AT)
        self._mechanism = replace(mechanism, driver=own, loads=(), couples=())
        self._names = {number: start_names(number) for number in numbers}
        self._last = numbers[-1]
        program = construct(self._mechanism, ("position",))[1]
        templates = {step.operands[1]: step.operands for step in reversed(program.which(("template",)))}
        first = {number: templates[names[0]] for number, names in self._names.items()}
        self._joints = tuple(first[self._last][ASTRAY + i] for i in (2, 6, 10))  # of the last link, on its own drawing
        extra = [Step(f"template_{part}", f"_{part}_{n}", first[n][1:]) for n in numbers for part in PARTS]
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
        sides = self._run(self._rough, self._joints, {}, np.arange(self.count))
        a, b, c = (sides[name] for name in self._joints)  # the largest distance of two joints, for each mechanism
        self._size = np.array(np.broadcast_to(np.max(np.abs([a - b, b - c, c - a]), axis=0), self.count))
        self._turns = isinstance(driver, Driver)
        self._steps = np.full(self.count, CRANK_GRID) if self._turns else SLIDE_GRID * self._size

    def _starting(self) -> Program:
        """Record where the last central link's first joint and x axis are at the start, and its joints on it."""
        start, board = self._mechanism.start(self._last), RecordingBoard()
        assert start is not None
        for opposite, length in self._mechanism.opposites.items():
            board.calc(opposite, "opposite", length)
        board.place("_start", start.x, start.y)
        board.turn("_start_turn", start.angle)
        for joint in self._joints:
            local_mark(board, self._mechanism.link(self._last), role(joint).of)
        board.incline("_start_arm", "_start_turn", self._joints[0])
        board.chain("_start_joint", "_start", "_start_arm")
        return Program(board.steps)

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

    def _look(self, state: State, at: Array, which: Places) -> tuple[dict[str, Array], State]:
        """Lay all templates down with the driver at `at`, from where they lie; return what the plan says, and how."""
        near = {AT: at}
        for row, names in zip(range(1, len(state), 5), self._names.values(), strict=True):
            near |= dict(zip(names, (*state[row : row + 4], np.zeros(len(at))), strict=True))
        look = self._run(self._program, self._wanted, near, which)
        if len(at) > 1:
            look = {name: np.broadcast_to(value, len(at)) for name, value in look.items()}
        rows = [at]
        for number in self._names:
            place, turn = look[f"_place_{number}"], look[f"_turn_{number}"]
            rows += [place.real, place.imag, turn.real, turn.imag, np.sign(look[f"_determinant_{number}"])]
        return look, np.array(rows)

    def _all(self, look: Mapping[str, Array], part: str, most: float) -> NDArray[np.bool_]:
        return np.asarray(np.logical_and.reduce([look[f"_{part}_{n}"] <= most for n in self._names]))

    def settle(self, at: Array, poses: Poses) -> None:
        """Lay the last central link down near where the task says that it starts, those before lie as in `poses`.

        Where that fails the driver is nowhere, and the link stays at its rough start.
        """
        which = np.arange(len(at))
        found = self._run(self._rough, ("_start_joint", "_start_turn"), {}, which)
        place, turn = (np.broadcast_to(found[name], len(at)) for name in ("_start_joint", "_start_turn"))
        nothing, (*before, _) = np.zeros(len(at)), self._names.values()
        rows = [row for names in before for row in (*(poses[name] for name in names[:4]), nothing)]
        rough = np.array([at, *rows, place.real, place.imag, turn.real, turn.imag, nothing])
        look, state = self._look(rough, at, which)
        for _ in range(SETTLING - 1):
            look, state = self._look(state, at, which)
        moved = np.abs(look[f"_place_{self._last}"] - place) / self._of(self._size, which)
        turned = look[f"_turn_{self._last}"] * turn.conj()
        held = self._all(look, "apart", CLOSED) & (moved <= FAR) & (np.abs(turned.imag) <= FAR) & (turned.real > 0.0)
        is_pose = np.arange(len(state))[:, None] % 5 > 0
        self.start = np.where(is_pose & ~held, rough, state)
        self.start[0, ~held] = np.nan

    def near(self, goal: Array) -> Poses:
        """Return the givens of the last group of the course, at any positions of the driver."""
        goal = np.broadcast_to(goal, max(len(goal), self.start.shape[1]))
        within = self._within(goal)
        state = self.go(within, np.arange(len(goal)))
        lost = np.flatnonzero(state[0] != within)
        if self._turns and len(lost):
            self._other_way(state, within, lost)
            lost = lost[state[0, lost] != within[lost]]
        astray = np.zeros(len(goal))
        if len(lost):
            astray[lost] = self._astray(state, goal, lost)
        *pose, way = self._names[self._last]
        return {**dict(zip(pose, state[-5:-1], strict=True)), way: astray}

    def _within(self, goal: Array) -> Array:
        """Return positions of a crank less whole turns, where the group comes back after one or cannot make it."""
        if not self._turns:
            return goal
        whole = np.trunc((goal - self.start[0]) / TURN)
        far = np.flatnonzero(np.abs(whole) >= 1.0)
        if not len(far):
            return goal
        goal, start = goal.copy(), self._start(far)
        once = start[0] + np.copysign(TURN, whole[far])
        after = self.go(once, far)
        size = self._of(self._size, far)  # the last link may lie as before, or nearly
        x, y, c, s = np.abs(after[-5:-1] - start[-5:-1])
        same = np.max([x / size, y / size, c, s], axis=0) <= SAME
        goal[far] -= np.where((after[0] != once) | same, whole[far] * TURN, 0.0)
        return goal

    def _start(self, which: Places) -> State:
        return self.start[:, np.zeros(len(which), int) if self.start.shape[1] == 1 else which]

    def _other_way(self, state: State, within: Array, lost: Places) -> None:
        """Try to come round the other way, where that way does not lead past the place at which this one ends.

        If it does, the crank has two positions for that angle, and a sweep would jump from one to the other.
        """
        within = within[lost]
        back = np.copysign(TURN, within - self._start(lost)[0])
        found, end = self.go(within - back, lost), self.go(state[0, lost] - back, lost)
        there = (found[0] == within - back) & (end[0] != state[0, lost] - back)
        found[0] = within
        state[:, lost[there]] = found[:, there]

    def go(self, goal: Array, which: Places) -> State:
        """Follow from the start as far towards `goal` as it goes; `which` are the mechanisms."""
        state, grid = self._start(which), self._of(self._steps, which)
        start = state[0].copy()
        ahead = np.trunc((goal - start) / grid)
        ahead = np.where(np.isfinite(ahead), ahead, 0.0).astype(int)
        if self.start.shape[1] == 1 and self.count == 1:
            state = self._from_nodes(ahead)
        else:
            passed = np.zeros(len(goal), int)
            for node in range(1, int(np.max(np.abs(ahead), initial=0)) + 1):
                before, passed = passed, np.sign(ahead) * np.minimum(node, np.abs(ahead))
                self._advance(state, start + before * grid, start + passed * grid, which)
        self._advance(state, start + ahead * grid, goal, which)
        return state

    def _from_nodes(self, ahead: NDArray[np.int_]) -> State:
        """Return states at nodes of the grid, each found once."""
        one = np.zeros(1, int)
        self._nodes.setdefault(0, self.start)
        for last in (int(np.max(ahead, initial=0)), int(np.min(ahead, initial=0))):
            sense = 1 if last > 0 else -1
            for node in range(sense, last + sense, sense):
                if node not in self._nodes:
                    state = self._nodes[node] = self._nodes[node - sense].copy()
                    before, there = (self.start[0] + number * self._steps for number in (node - sense, node))
                    self._advance(state, before, there, one)
        return np.concatenate([self._nodes[node] for node in ahead.tolist()], axis=1)

    def _advance(self, state: State, before: Array, goal: Array, which: Places) -> None:
        """Move states on to `goal`, in steps that keep the branch, as far as they go.

        A state that has not come as far as `before` stands in a dead position, and stays there.
        """
        least = LEAST * self._of(self._steps, which)
        active = np.flatnonzero((state[0] != goal) & (state[0] == before))
        step = (goal - state[0])[active]
        while len(active):
            here = state[:, active]
            ahead = np.where(np.abs(step) >= np.abs(goal[active] - here[0]), goal[active], here[0] + step)
            look, there = self._look(here, ahead, which[active])
            sure = self._all(look, "apart", CLOSED) & self._all(look, "doubt", SURE)
            sure &= (there[5::5] == here[5::5]).all(axis=0)  # the signs of the determinants
            state[:, active[sure]] = there[:, sure]
            step = np.where(sure, step * 2.0, (ahead - here[0]) * 0.5)
            going = (state[0, active] != goal[active]) & (np.abs(step) > least[active])
            active, step = active[going], step[going]

    def _astray(self, state: State, goal: Array, lost: Places) -> Array:
        """Return how far the legs of the last group are from its joints, where the driver stands at `goal` in vain.

        Just at a dead position it is zero, and the pose is refined: it is singular, not out of reach.
        """
        here, there = state[:, lost], goal[lost]
        look, seen = self._look(here, there, lost)
        missing = look[f"_missing_{self._last}"]
        for _ in range(SETTLING):
            look, seen = self._look(seen, there, lost)
        near = np.abs(there - here[0]) <= 8.0 * LEAST * self._of(self._steps, lost)
        dead = near & (np.abs(look[f"_determinant_{self._last}"]) < FOLDED)  # the legs of the last one concur
        state[:, lost[dead]] = seen[:, dead]
        return np.where(dead, 0.0, np.where(missing > 0.0, missing, np.nan))


def with_special_points(
    mechanism: Mechanism,
    values: Mapping[str, Any],
    near: Mapping[str, Any] | None = None,
    enough: float = SMALL,
    first: Mapping[int, Legs | None] | None = None,
) -> Mechanism:
    """Return the mechanism with two legs chosen for the special point of every triad whose task names none.

    Its numbers in SI are for one position or, float64 arrays of shape (N,), for many: of these the worst one counts;
    `near` is what `followed` gives for them, where it is known already. The first two legs whose sines are nowhere
    below `enough` are taken, so that one position is constructed like another; without such ones the best two. Those
    that `first` has by the number of the central link are taken where their lines meet everywhere, however flatly.
    """
    for number, (pairs, sines) in _sines(mechanism, values, near).items():
        worst = sines.min(axis=1)
        legs = pairs[int(np.argmax(np.minimum(worst, enough)))]
        wanted = (first or {}).get(number)
        keeps = wanted is not None and worst[pairs.index(wanted)] >= ILL
        legs = wanted if keeps and wanted else legs
        starts = tuple(replace(start, legs=legs) if start.link == number else start for start in mechanism.starts)
        mechanism = replace(mechanism, starts=starts)
    return mechanism


def _sines(
    mechanism: Mechanism, values: Mapping[str, Any], near: Mapping[str, Any] | None
) -> dict[int, tuple[list[Legs], Array]]:
    """Return for each triad without named legs the pairs of its legs, and the worse sine of each, shape (3, N).

    Where the mechanism cannot be assembled all are one.
    """
    unnamed = {start.link for start in mechanism.starts if start.legs is None}
    free, board = mechanism.without_loads, RecordingBoard()
    groups = named(free, analyse(free))[1] if unnamed else ()
    triads = [group for group in groups if isinstance(group, Triad) and group.central.number in unnamed]
    by_triad = {triad.central.number: dict(_pairs(board, triad)) for triad in triads}
    if not by_triad:
        return {}
    wanted = [name for pairs in by_triad.values() for names in pairs.values() for name in names]
    program = Program((*construct(free, ("position",))[1].steps, *board.steps)).needed_for(wanted)
    values = {**values, **(near or followed(mechanism, values))}
    values = {name: value for name, value in values.items() if name in program.needs}
    many = any(np.ndim(value) for value in values.values())
    found = batch(program, values, wanted)[0] if many else run(program, values).values
    sines = {}
    for number, pairs in by_triad.items():
        both = [[np.atleast_1d(np.abs(found[name])) for name in names] for names in pairs.values()]
        rows = np.min(both, axis=1)
        sines[number] = [*pairs], np.where(np.isnan(rows).all(axis=0), 1.0, np.nan_to_num(rows, nan=0.0))
    return sines


def _pairs(board: RecordingBoard, triad: Triad) -> Iterable[tuple[Legs, tuple[str, str]]]:
    """Record the sines of every two legs: of their lines, and of the third line with the way to the special point."""
    board.pole("_nowhere")
    for first, second in combinations(triad.by_number, 2):
        third = next(leg for leg in triad.legs if leg not in (first, second))
        key = f"{first.number}_{second.number}"
        board.meet(f"_X_{key}", first.start, first.e, second.start, second.e)
        board.distance(f"_l_{key}", f"_X_{key}", third.end)
        board.calc(f"_sine_{key}", "across_axis", first.e, "_nowhere", second.e)
        # the normals to both meet like the lines themselves
        board.calc(f"_across_{key}", "across_axis", third.e, f"_X_{key}", third.end)
        board.calc(f"_sine_D_{key}", "part_of", f"_across_{key}", f"_l_{key}")
        yield (first.number, second.number), (f"_sine_{key}", f"_sine_D_{key}")
