"""The forces of a hoist as they are: by the formulas where these are valid, else by the motion; over time; its places.

A hoist is judged by whether its formulas are valid, and whether its rope is strong enough. Where load and drum stand is
chosen by the greatest force and stress over beta_0 and beta_2, and by what is permitted. The article's loop changes
beta_0 and beta_2 until the rope is safe enough: it tries the places of a grid, the nearest to the given ones first.
Where a rope that pushes or a support that pulls makes the formulas invalid, the motion of a one-sided rope and support
is taken. Over time the travel, the height of the load, the forces, and how far the beams bend are known.

Source: Karpenko, Muzyka, Gudym, figure 3.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import astuple, dataclass, fields
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...scales.errors import InputError
from ..board import Board, recorded
from ..boards.exact import ExactBoard
from ..laws import TURN
from ..solved import AT, AT_LEAST, MORE, Check, Pieces
from .hoist import FINITE, MOST_SWINGS, RIGID, VALUES, Numbers, complete
from .model import model, motion_given, rope_force, swinging
from .onesided import Curve, OneSided, one_sided

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
ROPE_1, ROPE_2, SUPPORT, STRENGTH = ("rope_phase_1", "rope_phase_2", "support", "strength")


def valid(found: Numbers) -> Any:
    """Return whether the two-sided formulas are valid: the rope always pulls, the load does not come back."""
    return (found["F_12_min"] >= 0.0) & (found["P_12_min"] >= 0.0) & (found["s_min"] > 0.0)


def _validity(found: Numbers, motion: OneSided | None) -> list[Check]:
    """Return the checks of the two-sided formulas: least forces of the rope in both phases, least height of the load.

    A value is what the formulas give as long as the checks before it hold, else that of the motion.
    """
    pulls = found["F_12_min"] >= 0.0
    if pulls or motion is None:
        taut, least = found["P_12_min"] >= 0.0, found["P_12_min"]
    else:
        taut, least = not motion.slackens, motion.least_pull
    if motion is None or (pulls and taut):
        stays, lowest = found["s_min"] > 0.0, found["s_min"]
    else:
        stays, lowest = not motion.returns, motion.lowest
    rows = [(ROPE_1, "F_12_min", pulls, found["F_12_min"], AT_LEAST, "N")]
    rows += [(ROPE_2, "P_12_min", taut, least, AT_LEAST, "N"), (SUPPORT, "s_min", stays, lowest, MORE, "m")]
    return [
        Check(name=name, ok=bool(ok), value=value, unit=unit, limit=0.0, relation=relation, quantity=quantity)
        for name, quantity, ok, value, relation, unit in rows
    ]


def strength(values: Numbers) -> Check:
    """Return whether the rope is as safe as is required."""
    return Check.of_value(STRENGTH, values["safety"], AT_LEAST, values["K"], "1", quantity="safety", of="K")


MOST_OF_MANY = 10_000.0  # pieces and swings of the motions of many hoists together
VALIDITY = ("F_12_min", "P_12_min", "s_min")
MOVED = ("g", "m", "C_01", "C_12", "V_t", "a")  # what a motion follows from


@dataclass(frozen=True, slots=True)
class Forces:
    """The quantities of a hoist in SI, what they are judged by, and the motion where the formulas are not valid."""

    found: Numbers
    checks: tuple[Check, ...]
    motion: OneSided | None

    @property
    def ok(self) -> Mapping[str, bool]:
        """The verdicts by name."""
        return {check.name: check.ok for check in self.checks}

    @property
    def end(self) -> float:
        """Until when a hoist is looked at: one period after the lift-off, or until its motion repeats itself."""
        return self.found["t_1"] + TURN / self.found["k_1"] if self.motion is None else self.motion.pieces[-1].end

    @property
    def marks(self) -> dict[str, float]:
        """The times of the lift-off and of the greatest and least forces after it, in order, s."""
        t_1, T_1 = self.found["t_1"], self.found["T_1"]
        if self.motion is None:
            half = 0.5 * TURN / self.found["k_1"]
            least = t_1 + T_1 + (half if half > T_1 else -half)
        else:
            least = self.motion.extremes(lifted=True)[1][0]
        known = {"F_12_max": self.found["t_F12_max"], "t_1": t_1, "P_12_max": t_1 + T_1, "P_12_min": least}
        return dict(sorted(known.items(), key=lambda mark: mark[1]))


def forces(values: Numbers) -> Forces:
    """Return the forces of one hoist, whose givens are in SI; what has a default may be left out.

    Raises InputError of givens that no hoist can have, named.
    """
    givens = complete(values)
    found = model(givens)
    _in_range(found)
    motion = None if valid(found) else one_sided(found)
    checks = _validity(found, motion)
    if motion is not None:
        found = model(givens | motion_givens(motion), one_sided=True)
    return Forces(found, (*checks, strength(found)), motion)


def motion_givens(motion: OneSided) -> dict[str, float]:
    """Return the quantities that a motion gives in the place of formulas, as givens of the construction."""
    t_1 = motion.t_1
    (t_most, most), (_, least) = motion.extremes(lifted=False)
    (t_top, top), (_, bottom) = motion.extremes(lifted=True)
    found = {"t_1": t_1, "F_12_t1": motion.force(t_1), "_dF_t1": motion.rate(t_1), "s_min": motion.lowest}
    found |= {"F_12_max": most, "t_F12_max": t_most, "F_12_min": least}
    found |= {"T_1": t_top - t_1, "P_12_max": top, "P_12_min": bottom}
    return {motion_given(name): value for name, value in found.items()}


def _forces_of_many(values: Numbers, wanted: Iterable[str]) -> dict[str, Any]:
    """Return quantities of many hoists at once, each found as it is valid for it; `formulas`: whether these are.

    The `values` are complete and admissible givens, of any shapes that go together. Raises InputError of motions of too
    many pieces and swings.
    """
    names, left = tuple(wanted), MOST_OF_MANY
    found = model(values, (*names, *VALIDITY, *MOVED))
    shape = np.broadcast_shapes(*(np.shape(values[name]) for name in VALUES))
    kept = {name: np.array(np.broadcast_to(found[name], shape)) for name in names}
    formulas = np.broadcast_to(valid(found), shape)
    for index in map(tuple, np.argwhere(~formulas)):
        one = {name: float(np.broadcast_to(values[name], shape)[index]) for name in VALUES}
        motion = one_sided({name: float(np.broadcast_to(found[name], shape)[index]) for name in MOVED}, left)
        left -= motion.events
        alone = model(one | motion_givens(motion), names, one_sided=True)
        for name in names:
            kept[name][index] = alone[name]
    return kept | {"formulas": formulas}


# what is known over time, and in what; the forces of both phases are one
COLUMN_UNITS = {"t": "s", "y": "m", "s": "m", "F_01": "N", "F_12": "N", "sigma": "Pa", "w_0": "m", "w_2": "m"}
BOTH, ROPE, BEAM, NEITHER = ("both", "rope", "support", "neither")  # what bears the load
BEARS = {(True, True): BOTH, (True, False): ROPE, (False, True): BEAM, (False, False): NEITHER}  # rope, support


class _Course(NamedTuple):
    """A hoist at times of shape (N,): columns in SI by name, and what bears at each."""

    columns: dict[str, Array]
    states: tuple[str, ...]


def _in_phases(board: Board) -> None:
    """The forces of both phases at a time, each as if it were in its own."""
    board.calc("_mu", "support_share", "C_12", "C_01")
    board.calc("_C_osc", "product", "_mu", "C_12")
    rope_force(board, "_rope_1", "t")
    board.calc("_lagging", "lagging", "V_t", "a", "k", "t")
    board.calc("_support_1", "support_force", "C", "_lagging", "P_st")
    board.calc("_T", "excess", "t", "t_1")
    board.calc("_swing", "swing", "D_0", "D_1", "k_1", "_T")
    board.calc("_rope_2", "suspended_force", "P_m", "_swing")


def _after(board: Board) -> None:
    """What follows from the force of the rope in either phase."""
    board.calc("y", "wound", "V_t", "a", "t")
    board.calc("s", "height", "y", "P_st", "C_01", "F_12", "C_12")
    board.calc("sigma", "stress", "F_12", "S")
    board.calc("_pressed", "opposite", "F_01")
    board.calc("w_0", "deflection", "_pressed", "C_01")
    board.calc("w_2", "deflection", "F_12", "C_2")


def rope_forces(found: Numbers, t: Any) -> tuple[Any, Any]:
    """Return the forces of support and rope by the formulas of the phase that each time is in, N.

    Needed are the quantities `V_t a k k_1 C C_01 C_12 P_st P_m D_0 D_1 t_1`, SI.
    """
    board = ExactBoard({**found, "t": t})
    board.follow(recorded(_in_phases))
    resting = t < found["t_1"]
    values = board.values
    return np.where(resting, values["_support_1"], 0.0), np.where(resting, values["_rope_1"], values["_rope_2"])


def course(forces: Forces, t: Array) -> _Course:
    """Look at a hoist at times from its beginning on, s, of shape (N,), none after the end of its motion."""
    motion = forces.motion
    if motion is None:
        borne, height = rope_forces(forces.found, t), None
        states = tuple(np.where(t < forces.found["t_1"], BOTH, ROPE).tolist())
    else:
        F_12, height = (np.array([of(at) for at in t.tolist()]) for of in (motion.force, motion.height))
        pieces = [motion.at(time) for time in t.tolist()]
        states = tuple(BEARS[piece.rope, piece.support] for piece in pieces)
        borne = _pressed(forces, height, np.array([piece.support for piece in pieces])), F_12
    return _Course(
        {name: np.asarray(value, float) for name, value in _columns(forces.found, t, borne, height).items()}, states
    )


def _pressed(forces: Forces, height: Any, support: Any) -> Any:
    """Return the force of a support that only pushes."""
    C_01 = forces.found["C_01"]
    return np.where(support, height, 0.0) * (C_01 if np.isfinite(C_01) else 0.0)


def _columns(found: Numbers, t: Any, borne: tuple[Any, Any], height: Any) -> dict[str, Any]:
    """Return the columns at times with the forces of support and rope, and the height of the load where it is known."""
    board = ExactBoard({**found, "t": t, "F_01": borne[0], "F_12": borne[1]})
    board.follow(recorded(_after))
    values = board.values if height is None else {**board.values, "s": height}
    return {name: values[name] for name in COLUMN_UNITS}


NUMBERS = tuple(f.name for f in fields(Curve))  # of a curve


def changed(forces: Forces, given: Callable[[str], Any], names: Iterable[str]) -> dict[str, Any]:
    """Return the givens of a hoist with those of some names that are `given` in their place, and so t_1."""
    return {name: forces.found[name] for name in VALUES} | {name: given(name) for name in (*names, "t_1")}


def formulas(forces: Forces, given: Callable[[str], Any], names: Collection[str] = ()) -> dict[str, Any]:
    """Return the columns at a time, which is given with the numbers of its piece: none where the formulas are valid.

    Where these are, the givens of some `names` are given, too; then there are an end of the time, and columns `limit.`
    that are not negative where the formulas of these givens are valid: a rope that always pulls, a load that stays up.
    """
    t = given("t")
    if forces.motion is None and not names:
        return _columns(forces.found, t, rope_forces(forces.found, t), None)
    if forces.motion is None:
        found = swinging(changed(forces, given, names))
        columns = _columns(found, t, rope_forces(found, t), None)
        swing = np.sqrt(found["D_0"] * found["D_0"] + found["D_1"] * found["D_1"])
        limits = {"slack": columns["F_12"], "slack_after": found["P_m"] - swing}
        limits["returns"] = np.where(t < found["t_1"], 0.0, columns["s"])
        return (
            columns | {"end": found["t_1"] + TURN / found["k_1"]} | {f"limit.{name}": of for name, of in limits.items()}
        )
    since = given(AT) - given("begin")
    stretch, height = (Curve(*(given(f"{of}.{name}") for name in NUMBERS)) for of in ("stretch", "height"))
    long, high = (
        curve.ordinate(since, np.cos(curve.w * since), np.sin(curve.w * since)) for curve in (stretch, height)
    )
    pull = given("rope") * forces.motion.C_12 * long
    borne = _pressed(forces, high, given("support") > 0.0), np.where(pull > 0.0, pull, 0.0)
    return _columns(forces.found, t, borne, high)


def pieces(forces: Forces) -> Pieces | None:
    """Return the pieces of the motion where the formulas are not valid."""
    if forces.motion is None:
        return None
    names = ["begin", "rope", "support", *(f"{of}.{name}" for of in ("stretch", "height") for name in NUMBERS)]
    rows = [
        [piece.begin, piece.rope, piece.support, *astuple(piece.stretch), *astuple(piece.height)]
        for piece in forces.motion.pieces
    ]
    return Pieces(np.array([piece.begin for piece in forces.motion.pieces]), names, np.array(rows, float))


LEAST, MOST = 0.05, 0.5  # of beta: nearer to its end a beam is rigid
PLACES, FEWER = 46, 16  # of each beta: steps of 0.01, or of 0.03 where many motions have to be followed
MANY = 100  # places at which the formulas are not valid, and the motion takes a thousand times as long
ROUNDS, FINE, LESS = 5, 9, 5  # rounds in which the optimum is closed in on, and places in each


@dataclass(frozen=True, slots=True, eq=False)
class _Spectrum:
    """Greatest forces over the places of load and drum."""

    # shape (N,): the places
    beta_0: Array
    beta_2: Array
    # shape (N, M), SI
    F_max: Array
    sigma_max: Array
    safety: Array
    formulas: Flags  # shape (N, M): whether the closed formulas are valid
    permitted: Flags  # shape (N, M): whether the strength condition holds

    def trial(self, i: int, j: int) -> Trial:
        """Return what was found at one pair of places."""
        return Trial(*map(float, (self.beta_0[i], self.beta_2[j], self.F_max[i, j], self.safety[i, j])))

    @property
    def best(self) -> Trial:
        """The pair of places with the least force."""
        return self.trial(*map(int, np.unravel_index(self.F_max.argmin(), self.F_max.shape)))


@dataclass(frozen=True, slots=True)
class Trial:
    """Places that were tried, and the safety that they have."""

    beta_0: float
    beta_2: float
    F_max: float
    safety: float


@dataclass(frozen=True, slots=True, eq=False)
class Choice:
    """The spectrum, the best places, and the way of the article's loop."""

    spectrum: _Spectrum
    given: Trial  # the places that are given
    best: Trial  # those with the least force, between the places of the grid too
    trials: tuple[Trial, ...]  # what the loop tried, `given` first; the last is safe, unless no place is
    K: float  # the safety that is required

    @property
    def found(self) -> bool:
        """Whether the loop ended with places that are safe."""
        return self.trials[-1].safety >= self.K


def spectrum(values: Numbers, beta_0: Array, beta_2: Array) -> _Spectrum:
    """Return the greatest forces at all pairs of places, of complete givens, whose own places do not count."""
    found = _forces_of_many(_placed(values, beta_0, beta_2), ("F_max",))
    F_max, formulas = (found[name].reshape(len(beta_0), len(beta_2)) for name in ("F_max", "formulas"))
    sigma_max = F_max * (1.0 / values["S"])
    safety = values["sigma"] / sigma_max
    return _Spectrum(beta_0, beta_2, F_max, sigma_max, safety, formulas, safety >= values["K"])


def _placed(values: Numbers, beta_0: Array, beta_2: Array) -> dict[str, Any]:
    """Return the givens of the hoists at all pairs of places."""
    first, second = (places.ravel() for places in np.meshgrid(beta_0, beta_2, indexing="ij"))
    return {**values, "beta_0": first, "beta_2": second}


def _grid(places: int) -> Array:
    return LEAST + (MOST - LEAST) * (np.arange(places) / (places - 1))


def choose(values: Numbers, places: int = PLACES) -> Choice:
    """Look for places that are safe, and for the best ones, of complete givens, SI.

    So many `places` of each beam from `LEAST` to `MOST` are tried, fewer where the formulas are not valid at many.
    """
    grid, fine = _grid(places), FINE
    if np.sum(~valid(model(_placed(values, grid, grid), VALIDITY))) > MANY:
        grid, fine = _grid(min(places, FEWER)), LESS
    found = spectrum(values, grid, grid)
    given = spectrum(values, np.array([values["beta_0"]]), np.array([values["beta_2"]])).trial(0, 0)
    trials = [given]  # until they are safe, those first that are least changed
    away = np.hypot(found.beta_0[:, None] - given.beta_0, found.beta_2[None, :] - given.beta_2)
    for at in np.argsort(away, axis=None, kind="stable").tolist():
        if trials[-1].safety >= values["K"]:
            break
        trials.append(found.trial(*divmod(at, len(found.beta_2))))
    return Choice(found, given, _best(values, found, fine), tuple(trials), values["K"])


def _best(values: Numbers, found: _Spectrum, count: int) -> Trial:
    """Return the places of the least force: those of the grid, then of finer and finer grids around them."""
    width = float(found.beta_0[1] - found.beta_0[0])
    best = found.best
    for _ in range(ROUNDS):
        around = width * np.linspace(-1.0, 1.0, count)
        nearer = spectrum(values, *(np.clip(beta + around, LEAST, MOST) for beta in (best.beta_0, best.beta_2))).best
        best = nearer if nearer.F_max < best.F_max else best
        width *= 3.0 / (count - 1)
    return best


def _in_range(found: Numbers) -> None:
    """Refuse givens so far apart that a result has no number; only what a rigid beam has may be infinite.

    Raises InputError: `hoist-range`, `hoist-stiff` of a load that swings so often that its phase is not known.
    """
    for name, value in found.items():
        of_rigid = math.isinf(value) and name in RIGID and math.isinf(found[RIGID[name]])
        if not math.isfinite(value) and not of_rigid:
            raise InputError("hoist-range", name=name)
    if vanished := [name for name in FINITE if not found[name] > 0.0]:
        raise InputError("hoist-range", name=vanished[0])
    turns = found["k"] * found["t_1"] / TURN
    if math.isfinite(found["k"]) and turns > MOST_SWINGS:
        raise InputError("hoist-stiff", n=f"{turns:.3g}")
