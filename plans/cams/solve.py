"""A cam solved: motion, sizes, construction, values and quantities in sections, and what comes through of errors.

K is that of `plans.condition`, over Q, or over the size that Q is a part of (of e that is r_0). Much of a cam is found
beside the board, by closed forms of its law, so that the derivatives are central differences of all of it.

The board begins with the numbers of the task, and with those that belong to the law of motion. A law of motion is a
table to the board, as it is to a student: parts of the amplitude, of the travel, of the sizes.

A cam is judged by rules of good design and by usual numbers: others are solved, too, but are more often a wrong unit.

A cam's construction finds most sizes twice: by the closed forms of its law, and by chords and tangents as they are
drawn. Who draws has one of each, and goes on with it: the scale factors follow from the highest ordinate of the curve
of chords, r_0 from where the tangents meet. In a cam as a student draws it what is drawn takes the name of what it
stands for, `mu_s_chord` that of `mu_s`, `r_0_tangents` that of `r_0`, and all that hangs on these hangs on the drawing.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

from ...scales.errors import InputError
from ..board import Program, Step, with_needs
from ..boards.exact import run
from ..condition import Condition, by_solving_again, ratio
from ..hands.shaky import Paper, Tolerance
from ..hands.spread import added_up
from ..laws import LAWS
from ..marking.key import rounded
from ..names import role
from ..quantities import Quantity, quantities, results, worst_behind
from ..solved import AT_LEAST, AT_MOST, Check, Solved, found_on
from . import construction
from .cam import (
    DIAGRAMS_PART,
    GIVENS,
    PLANS,
    PLATE,
    PRESSURE_PART,
    PROFILE_PART,
    ROCKER,
    ROLLER,
    SIZES_PART,
    VALUES,
    Cam,
)
from .followers import OF_R_0, OF_RHO_MIN, RIGHT_ANGLE, PlateCam, PlateProfile, RollerCam, RollerProfile
from .motion import RISE, Array, Division, Motion, motion_of
from .sizes import plate_cam, rocker_cam, roller_cam


def diagram_givens(motion: Motion, division: Division, given: str) -> dict[str, Any]:
    """Return what the diagrams begin with: angles of section lines, and parts of the amplitude that is given."""
    order, angles, top = 2 if given == construction.ACCELERATION else 1, division.angles, motion.rise.length
    # the greatest ordinate of the given diagram in the rise, SI: A_1, or the greatest ds/dphi
    amplitude = motion.maximum(0.0, float(order == 1), float(order == 2), (RISE,)).value
    numbers: dict[str, Any] = {"_two": 2.0, "_minus_one": -1.0}
    middles = 0.5 * (angles[:-1] + angles[1:])
    means = motion.at(middles)[order]
    for i in division.sections:
        numbers |= {f"_phi{i}": float(angles[i]), f"_phi_middle{i}": float(middles[i - 1])}
        numbers[f"_part{i}"] = float(means[i - 1]) / amplitude
    for word, side in (("before", -1), ("after", 1)):
        values = motion.at(angles, side)[order]
        numbers |= {f"_part{i}_{word}": float(values[i]) / amplitude for i in division.lines}
    if given == construction.VELOCITY:
        for i, phase in division.on_lines:  # of two values at a jump that inside
            word = "after" if i == division.of(phase)[0] else "before"
            numbers[f"_node{i}_{phase}"] = numbers[f"_part{i}_{word}"]
        return numbers | {"_part_v": motion.ds_max.value / amplitude, "_part_s": motion.h / (amplitude * top)}
    numbers["_part_v"] = motion.ds_max.value / (amplitude * top)
    numbers["_part_s"] = motion.h / (amplitude * top * top)
    return numbers | {"_part_a": motion.d2s_max.value / amplitude}


CHORDS = "chords"
SECTIONS = (DIAGRAMS_PART, CHORDS, ROLLER, PLATE, construction.PROFILE)
PRESSURES = ("gamma_rise_min", "gamma_fall_min")  # also what the plan of pressure angles shows
NAMES = {
    CHORDS: ("s_close", "v_close"),
    ROLLER: (
        *("mu_s_ds", "r_0", "e", "s_0", "e_least", "e_most", "r_0_tangents", "e_tangents"),
        *("l_rocker", "l_OC", "psi_0", *PRESSURES),
    ),
    PLATE: ("mu_s_d2s", "r_0_flat_tangent", "r_0_flat_min", "r_0_flat", "rho_flat_min", "R_plate"),
    construction.PROFILE: ("mu_l", "R_roller", "rho_min"),
}
OF_PLAN = {
    DIAGRAMS_PART: (DIAGRAMS_PART, CHORDS),
    SIZES_PART: (ROLLER, PLATE),
    PROFILE_PART: (construction.PROFILE,),
    PRESSURE_PART: (),
}
_SECTION = {name: section for section, names in NAMES.items() for name in names}


def section_of(name: str) -> str:
    """Return the section of a quantity or a scale factor: what belongs to nothing else belongs to the diagrams."""
    return _SECTION.get(name, CHORDS if name in construction.EXACT_OF else DIAGRAMS_PART)


def listed(names: Iterable[str], plans: Iterable[str]) -> tuple[str, ...]:
    """Return those of the names that belong to the plans wanted, not only to what these need, section by section."""
    wanted = [*plans]
    sections = {section for plan in wanted for section in OF_PLAN[plan]}
    kept = [name for name in names if section_of(name) in sections or (PRESSURE_PART in wanted and name in PRESSURES)]
    return tuple(sorted(kept, key=lambda name: SECTIONS.index(section_of(name))))


# the scale factor in which each plan shows values; on the diagrams that of the axis of ordinates
SCALES = {
    construction.ACCELERATION: "mu_d2s",
    construction.VELOCITY: "mu_ds",
    construction.TRAVEL: "mu_s",
    construction.SIZES: "mu_s_ds",
    construction.PLATE_SIZES: "mu_s_d2s",
    **dict.fromkeys((construction.ROCKER_SIZES, construction.PROFILE, construction.PLATE_PROFILE), "mu_l"),
}
# the plans with equal scale factors on both axes, and the factor of a diagram that is the finest for each
EQUAL = {"mu_s_ds": "mu_s", "mu_s_d2s": "mu_d2s"}
# the plan that shows a quantity as a segment, beside those that are read from one
SHOWN_ON = {
    **dict.fromkeys(("A_1", "A_2"), construction.ACCELERATION),
    "ds_max": construction.VELOCITY,
    "s_max": construction.TRAVEL,
    **dict.fromkeys(("r_0", "e", "s_0", "r_0_tangents", "e_tangents"), construction.SIZES),
    **dict.fromkeys(("r_0_flat_min", "r_0_flat_tangent", "rho_flat_min"), construction.PLATE_SIZES),
    **dict.fromkeys(("rho_min", "R_roller"), construction.PROFILE),
    **dict.fromkeys(("r_0_flat", "R_plate"), construction.PLATE_PROFILE),
}
LENGTHS = ("H_a", "H_v", "R_roller", "l_rocker", "r_0_flat")  # given ones that are results, too
# how the numbers that a task has on the paper of the diagrams change with the size of the drawing
REDUCED = {"l_A1": 1, "H_a": 1, "H_v": 1, "mu_phi": -1}
UNITS = {
    **VALUES,
    **{"v_max": "m/s", "a_max": "m/s^2", "mu_phi": "rad/mm", "mu_v": "(m/s)/mm", "mu_a": "(m/s^2)/mm"},
    **dict.fromkeys(("mu_s", "mu_ds", "mu_d2s"), "m/mm"),
    **dict.fromkeys(("nu", "nu_a", "psi_0", *PRESSURES), "rad"),
}


def unit_of(name: str) -> str:
    """Return the SI unit of a cam's number or quantity by its name; analogues have that of the travel."""
    return UNITS.get(construction.EXACT_OF.get(name, name), "m")


@dataclass(frozen=True, slots=True, kw_only=True)
class SolvedCam(Solved):
    """A cam solved; the cams for its followers are those of `layout`."""

    cam: Cam
    motion: Motion
    layout: construction.Layout

    @property
    def rolling(self) -> RollerCam | None:
        """The cam for a follower with a roller, on a line or on a rocker."""
        return self.layout.rolling

    @property
    def roller(self) -> RollerCam | None:
        """The cam for a roller on a line."""
        return None if self.layout.rocks else self.layout.rolling

    @property
    def rocker(self) -> RollerCam | None:
        """The cam for a rocker."""
        return self.layout.rolling if self.layout.rocks else None

    @property
    def plate(self) -> PlateCam | None:
        """The cam for a plate."""
        return self.layout.plate

    @property
    def profiles(self) -> list[tuple[str, str, RollerProfile | PlateProfile]]:
        """The profiles: the curve whose curvature counts, the follower, the profile."""
        rolling = ("pitch_rocker", ROCKER) if self.layout.rocks else ("pitch", ROLLER)
        cams = (*rolling, self.rolling), ("profile_plate", PLATE, self.plate)
        return [(curve, follower, cam.profile) for curve, follower, cam in cams if cam is not None]

    @property
    def angles(self) -> Array:
        """The angles of the section lines, rad."""
        return self.layout.division.angles

    @property
    def edges(self) -> tuple[str, ...]:
        """The directions of axes and section lines."""
        return construction.RIGHT, construction.UP

    @property
    def on_paper(self) -> tuple[str, ...]:
        """The diagrams, whose scale factors come from what is measured on them."""
        return construction.DIAGRAMS

    @property
    def ends(self) -> tuple[str, ...]:
        """Where the diagrams close: the velocity after each phase unless it is given, the travel after the fall."""
        division, given = self.layout.division, self.layout.given
        speeds = (division.top, division.last) if given == construction.ACCELERATION else ()
        marks = (*(f"{construction.VELOCITY}.{line}" for line in speeds), f"{construction.TRAVEL}.{division.last}")
        return tuple(mark for mark in marks if mark in self.program.by_name)

    @property
    def draws_profiles(self) -> bool:
        """Whether the profiles are constructed, not only the sizes."""
        return any(plan in (construction.PROFILE, construction.PLATE_PROFILE) for plan in self.program.plans)


def solve_cam(cam: Cam, values: Mapping[str, float], plans: Iterable[str] = PLANS) -> SolvedCam:
    """Solve a cam, whose followers, laws and senses are chosen.

    The `values` are its numbers in SI by name; r_0_flat of a cam for a plate alone may be called r_0. The `plans`
    wanted, of `cam.PLANS`, come with those that they need, no others.

    Raises InputError: a law that cannot be had with these numbers, or a size that the limits do not permit.
    """
    if cam.followers == (PLATE,) and "r_0" in values:
        if "r_0_flat" in values:
            raise InputError("cam-r-0-twice")
        values = {"r_0_flat" if name == "r_0" else name: value for name, value in values.items()}
    wanted = with_needs(plans, construction.NEEDS)
    motion = _motion(cam, values)
    division = motion.division(cam.sections)
    # a velocity that jumps is given: no acceleration has it
    begins = construction.VELOCITY if motion.velocity_jumps else construction.ACCELERATION
    layout = construction.Layout(
        division,
        begins,
        int(abs(division.angles - motion.ds_max.phi).argmin()),
        ROCKER in cam.followers,
        *(_cams(cam, motion, values) if SIZES_PART in wanted else ()),
    )
    found = _found(construction.construct(layout, wanted), {**values, **_givens(cam, motion, layout)})
    return SolvedCam(**found, cam=cam, motion=motion, layout=layout)


def reduced(solved: SolvedCam, part: float) -> SolvedCam:
    """Return the cam with diagrams `part` times as large as the task has them: drawn so, and measured on it."""
    if part == 1.0:
        return solved
    drawn = {name: solved.givens[name] * part**power for name, power in REDUCED.items()}
    return replace(solved, **_found(solved.program, {**solved.givens, **drawn}))


def _again(solved: SolvedCam, values: Mapping[str, float]) -> Mapping[str, Any]:
    """Return what the same construction gives with other numbers; its section lines go with the pieces of the law."""
    import numpy as np

    cam, layout = solved.cam, solved.layout
    motion = _motion(cam, values)
    # up to the lower dwell, which begins where phases that fill the turn become shorter
    before, now = (of.corners[: len(of.corners) - len(of.lower.pieces)] for of in (solved.motion, motion))
    division = replace(layout.division, angles=np.interp(solved.angles, before, now))
    rolling, plate = _cams(cam, motion, values) if layout.rolling or layout.plate else (None, None)
    layout = replace(layout, division=division, rolling=rolling, plate=plate)
    return run(solved.program, {**values, **_givens(cam, motion, layout)}).values


def _motion(cam: Cam, values: Mapping[str, float]) -> Motion:
    """Return the motion of the follower; the stroke of a rocker is that of its roller."""
    h = LAWS[construction.ARC](values["psi"], values["l_rocker"]) if ROCKER in cam.followers else values["h"]
    return motion_of(cam, {**values, "h": h})


def _cams(cam: Cam, motion: Motion, values: Mapping[str, float]) -> tuple[RollerCam | None, PlateCam | None]:
    """Return the cams for a follower with a roller and for a plate, which cannot follow a velocity that jumps."""
    rolling = roller_cam(cam, motion, values) if ROLLER in cam.followers else None
    if ROCKER in cam.followers:
        rolling = rocker_cam(cam, values)
    follows = PLATE in cam.followers and not motion.velocity_jumps
    return rolling, plate_cam(cam, motion, values) if follows else None


def _givens(cam: Cam, motion: Motion, layout: construction.Layout) -> dict[str, Any]:
    """Return what the board begins with beside the numbers of the cam."""
    division, sense = layout.division, cam.sense
    numbers = diagram_givens(motion, division, layout.given) | {"_sense": float(sense)}
    s, ds, _ = motion.at(division.angles, -1)
    for i in division.lines:  # the follower's axes in the inverted motion, and travels as parts of the stroke
        numbers[f"_axis_angle{i}"] = RIGHT_ANGLE - sense * float(division.angles[i])
        numbers |= {f"_s_part{i}": float(s[i]) / motion.h, f"_x_part{i}": sense * float(ds[i]) / motion.h}
    for follower in (layout.rolling, layout.plate):
        numbers |= follower.givens(division) if follower is not None else {}
    return numbers


def _found(program: Program, givens: Mapping[str, Any]) -> dict[str, Any]:
    """Return what the construction gives with these numbers, by fields of a cam solved."""
    board = run(program, givens)
    stated = {"mu_phi": Quantity("mu_phi", float(givens["mu_phi"]), unit_of("mu_phi"))} if "mu_phi" in givens else {}
    lengths = {name: givens[name] for name in LENGTHS if name in givens}
    shown = SHOWN_ON | dict.fromkeys(
        ("r_0", "l_OC") if construction.ROCKER_SIZES in program.plans else (), construction.ROCKER_SIZES
    )
    found = stated | quantities(program, board.values, lengths, unit_of)
    return {**found_on(board, program, SCALES, shown), "givens": givens, "quantities": found}


# numbers that neither the motion nor the smallest sizes depend on
ON_BOARD = {"l_A1", "H_a", "H_v", "mu_phi", "omega", "R_roller", "rho_flat", "margin"}
# sizes beside which others count, that may be nothing
BESIDE = {
    **dict.fromkeys(("e", "e_least", "e_most"), "r_0"),
    "e_tangents": "r_0_tangents",
    "s_close": "S_max_chord",
    "v_close": "V_max_chord",
}


def conditions_of(solved: SolvedCam) -> dict[str, Condition]:
    """Return the condition of every quantity, given ones among them."""
    numbers = {name: float(solved.givens[name]) for name in VALUES if name in solved.givens}

    def solve_with(others: Mapping[str, float]) -> Mapping[str, Any]:
        changed = {name for name, value in others.items() if value != numbers[name]}
        on_board = changed <= ON_BOARD
        values = run(solved.program, {**solved.givens, **others}).values if on_board else _again(solved, others)
        return {name: values[name] for name in solved.quantities}

    totals = by_solving_again(solve_with, numbers)
    worst = worst_behind(solved.program, solved.sines)
    return {
        name: Condition(ratio(total, float(abs(solved.values[BESIDE.get(name, name)]))), worst.get(name, 1.0))
        for name, total in totals.items()
    }


def tolerances_of(drawn: SolvedCam, paper: Paper, tolerance: Tolerance) -> dict[str, float]:
    """Return by how much the quantities of a cam that is drawn may differ, SI.

    Each may miss what all errors of the hand add up to; a length that the sheet shows as a segment, also what is let
    pass of such a segment; an angle, what is let pass of a direction where a protractor may have found it. What is
    only calculated from exact numbers, such as the inclination of the line of transfer, is rounded.
    """
    names = [step.name for step in results(paper.program)]
    limits = added_up(paper, tolerance, names)
    for name in names:
        value, step = float(abs(drawn.values[name])), paper.program.by_name[name]
        alone, is_measured = rounded(value, tolerance), step.verb in ("distance", "read")
        plan = role(step.operands[0]).plan if is_measured else drawn.shown_on.get(name, "")
        if drawn.quantities[name].unit == "rad":
            alone = max(alone, math.radians(tolerance.degrees))
        elif plan:
            of_drawing = plan in paper.unscaled and not is_measured  # calculated where nothing is to scale
            mu = drawn.values[drawn.scale_of_plan[plan]] if of_drawing else paper.mus[plan]
            alone = max(alone, float(tolerance.of_segment(value / mu) * mu))
        limits[name] = max(limits[name], alone)
    return limits


ROUNDING = 1e-9  # part of a limit by which rounding may pass it


@dataclass(frozen=True, slots=True, kw_only=True)
class _Rule(Check):
    """A rule; its limit may be a `part` of the `size` of the quantity `of`, m."""

    part: float = 1.0
    size: float = 0.0


def rules_of(solved: SolvedCam) -> tuple[_Rule, ...]:
    """Return the rules for a cam with a roller, none for one with a plate alone.

    `roller_of_radius` and `roller_of_curvature` hold the roller against 0.4 r_0 and 0.7 rho_min, the latter where the
    pitch curve is convex anywhere; `gamma_rise` and `gamma_fall` the least transmission angles against those permitted.
    """
    found = solved.rolling
    if found is None:
        return ()
    rules, R = [], found.profile.R
    sizes = {"radius": (OF_R_0, "r_0", found.sizes.r_0), "curvature": (OF_RHO_MIN, "rho_min", found.profile.rho_min)}
    for name, (part, of, size) in sizes.items():
        limit = part * size
        if math.isfinite(size):
            about = {"quantity": "R_roller", "of": of, "part": part, "size": size}
            rules.append(_Rule.of_value(f"roller_of_{name}", R, AT_MOST, limit, "m", limit * ROUNDING, **about))
    for phase in ("gamma_rise", "gamma_fall"):
        least, permitted = float(solved.values[f"{phase}_min"]), float(solved.givens[phase])
        room, quantity = permitted * ROUNDING, f"{phase}_min"
        rules.append(_Rule.of_value(phase, least, AT_LEAST, permitted, "rad", room, quantity=quantity))
    return tuple(rules)


# what follows is looked at where all that is given is usual
USUAL_FOUND = {"r_0": (2e-3, 1.0), "r_0_flat": (2e-3, 1.0), "a_max": (0.0, 1e5)}


_Unusual = tuple[str, float, float, float]  # the name of a number, the number, and between what the usual ones lie


def unusual(solved: SolvedCam) -> Iterator[_Unusual]:
    """Go through the numbers that hardly any cam has, SI: the given ones, else those that follow from them."""
    given = {name: of.usual for name, of in GIVENS.items() if of.usual is not None}
    yield from [*_beyond(solved.givens, given)] or _beyond(solved.values, USUAL_FOUND)


def _beyond(values: Mapping[str, Any], usual: Mapping[str, tuple[float, float]]) -> Iterator[_Unusual]:
    for name, (least, most) in usual.items():
        value = values.get(name)
        if value is not None and not least * (1.0 - ROUNDING) <= value <= most * (1.0 + ROUNDING):
            yield name, float(value), least, most


# ordinates that only a drawing shows keep its name
HEIGHTS = {construction.EXACT[name]: construction.CHORD_OF[name] for name in construction.EXACT}
TANGENTS = {"r_0": "r_0_tangents", "e": "e_tangents", "r_0_flat_min": "r_0_flat_tangent"}
GIVEN = ("r_0", "e")  # of a cam whose sizes are given none are drawn


def stands_for(solved: SolvedCam) -> dict[str, str]:
    """Return for every size that is drawn, and found by a formula, too, what it is called there."""
    names = {*solved.program.names}
    found = {drawn: exact for drawn, exact in construction.EXACT_OF.items() if {drawn, exact} <= names}
    sized = any(name in solved.givens for name in GIVEN)
    for exact, drawn in TANGENTS.items():
        if {exact, drawn} <= names and not (sized and exact in GIVEN):
            found[drawn] = exact
    return found


def as_drawn(solved: SolvedCam) -> SolvedCam:
    """Return the cam as a student draws it: of values that are drawn those have the plain names."""
    named, made = stands_for(solved), {*solved.program.names}
    instead = {exact: drawn for exact, drawn in HEIGHTS.items() if {exact, drawn} <= made}
    left_out, names = {*named.values(), *instead}, named | instead
    bends = solved.roller is not None and not solved.motion.velocity_jumps  # else the pitch curve has corners
    numbers = _curved(solved) if bends else {}
    steps = []
    for step in (step for step in solved.program if step.name not in left_out):
        operands = tuple(names.get(name, name) for name in step.operands)
        drawn = step.but(name=names.get(step.name, step.name), operands=operands)
        if drawn.name == "s_0" and "e_tangents" in named:  # it goes with r_0 and e
            drawn = drawn.but(law="other_leg", operands=("r_0", "e"))
        elif drawn.name == "rho_min" and numbers:  # the curvature is that of the drawn cam, with its travel
            travel = f"_s{solved.layout.division.top}_drawn"
            stroke = travel if travel in made else "h"
            drawn = drawn.but(law=construction.SHARPEST, operands=(stroke, "e", "s_0", *numbers))
        steps.append(drawn)
    program, numbers = Program(tuple(_in_order(steps))), {**numbers, **solved.givens}
    board = run(program, numbers)
    return replace(solved, program=program, givens=numbers, values=board.values, sines=board.sines)


def _curved(solved: SolvedCam) -> dict[str, float]:
    """Return s, s', s'' in parts of the stroke on every section line, both limits where they jump, in this order.

    The pitch curve of a roller is curved after these, and after where its centre is.
    """
    limits = [solved.motion.at(solved.angles, side) for side in (-1, 1)]
    found = {}
    for order, word in enumerate(("s", "ds", "d2s")):
        turned = solved.cam.sense if order == 1 else 1.0
        for side, values in zip(("before", "after"), limits, strict=True):
            for i, value in enumerate(values[order].tolist()):
                found[f"_{word}{i}_{side}_curved"] = turned * value / solved.motion.h
    return found


def _in_order(steps: Iterable[Step]) -> Iterator[Step]:
    """Go through steps, each as soon as all that it needs is there."""
    wanted = [*steps]
    missing, held = {step.name for step in wanted}, list[Step]()
    for step in wanted:
        held.append(step)
        while ready := next((one for one in held if missing.isdisjoint(one.operands)), None):
            held.remove(ready)
            missing.discard(ready.name)
            yield ready
