"""Data, units, position, scales and reading: mistakes M01 to M22, M74, M117, M123 and M126 to M128."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from functools import partial
from itertools import combinations
from operator import add, neg

from ..board import POSITION, Step
from ..boards.exact import run
from ..names import FORCES, ORIGIN, POLE, role
from .motion import rate_from, rates
from .rules import (
    Broken,
    Change,
    Changes,
    Scene,
    Steps,
    aside,
    constant,
    instead,
    mirrored,
    mistake,
    otherwise,
    scaled,
    then,
    with_other,
)

TWELFTH = math.pi / 6.0  # between positions
ROUNDED = (1.03, 0.97)
PRINTED = 0.955  # of a sheet that the printer has fitted to its page
# which operands of a step are lengths, in the laws too
LENGTHS = {"place": (0, 1), "arc": (1,), "arcs": (1, 3), "tangent": (2,), "divide": (2, 3)}
IN_LAWS = dict.fromkeys(("circular_speed", "centripetal", "normal_part", "crank_moment"), 1)
IN_LAWS |= {"turning": 2, "moment_equation": 0}


def _given_times(scene: Scene, name: str, factor: float, how: str = "") -> Change:
    return Change(name, {}, how, {name: scene.paper.givens[name] * factor})


@mistake("M01", 30.0 / math.pi)  # n in rpm is taken for omega
@mistake("M02", 0.5 / math.pi)  # n / 60
@mistake("M03", 60.0)  # 2 pi n
@mistake("M04", 0.5)  # pi n / 60
@mistake("M05", 180.0 / math.pi)  # 6 n in degrees a second
def _speed_times(scene: Scene, factor: float) -> Changes:
    """Change the number of revolutions of the crank, where it is that which is given."""
    step = next((s for s in scene.calculated("signed") if role(s.name).kind == "omega"), None)
    if step and step.operands[0].startswith("n") and scene.is_given(step.operands[0]):
        yield _given_times(scene, step.operands[0], factor)


def _lengths(scene: Scene) -> list[str]:
    """Return the data that are lengths, in order of use."""
    found: dict[str, None] = {}
    for step in scene.program:
        places = LENGTHS.get(step.verb, ())
        if step.verb in ("lay", "back") and step.plan == POSITION:
            places = (2,)
        if step.law in IN_LAWS:
            places = (IN_LAWS[step.law],)
        found.update((step.operands[i], None) for i in places if scene.is_given(step.operands[i]))
        if step.law in ("opposite", "excess", "sum") and role(step.name).kind in ("minus", "offset", "slope"):
            found.update((name, None) for name in step.operands if scene.is_given(name))
    if "_stroke_travel" in scene.steps:
        found.update({"_stroke_begin": None, "_stroke_end": None})
    return [name for name in found if isinstance(scene.paper.givens[name], float)]


@mistake("M05")
def _rates_in_degrees(scene: Scene) -> Changes:
    """Angular velocities and accelerations of links are given in degrees."""
    if steps := scene.calculated("turning"):
        yield scaled(180.0 / math.pi, *steps, how="degrees", at="")


@mistake("M07", of="circular_speed")
def _diameter_for_radius(scene: Scene, step: Step) -> Changes:
    """The stroke, or the diameter of the crank circle, is taken for the crank, or half the crank."""
    if scene.is_given(step.operands[1]):
        yield _given_times(scene, step.operands[1], 2.0, "x2")
        yield _given_times(scene, step.operands[1], 0.5, "x1/2")


def angle_of_driver(scene: Scene) -> str:
    """Return the given that is the crank's angle; nothing where a slider drives, or an angle is calculated."""
    crank = next((s for s in scene.made_by("lay", plan=POSITION) if s.name == scene.pin and s.plan == POSITION), None)
    turn = scene.steps.get(crank.operands[1]) if crank else None
    name = turn.operands[0] if turn and turn.verb == "turn" else "zero"
    return name if name in scene.paper.givens and name != "zero" else ""


@mistake("M08", "", math.degrees)  # degrees are given to a function of radians
@mistake("M09", "angle", neg)  # the angle is laid off clockwise
def _turned(scene: Scene, how: str, turn: Callable[[float], float]) -> Changes:
    """Lay off the crank's angle otherwise."""
    if name := angle_of_driver(scene):
        yield Change(name, {}, how, {name: turn(float(scene.paper.givens[name]))})


for _how, _shift in (("+180", math.pi), ("+90", 0.5 * math.pi), ("-90", -0.5 * math.pi)):
    mistake("M10", _how, partial(add, _shift))(_turned)  # counted from the other dead position, or from the other axis
for _number in (1, -1, 2, -2, 4, -4, 5, -5):
    # the positions are numbered from another one: the whole plan is that of another position
    mistake("M10", f"{30 * _number:+}", partial(add, _number * TWELFTH))(_turned)
mistake("M10", "180-", lambda angle: math.pi - angle)(_turned)  # laid off from the other end of the axis


@mistake("M09", of="signed")
def _turning_the_other_way(scene: Scene, step: Step) -> Changes:
    """The crank turns the other way."""
    if role(step.name).kind == "omega":
        yield instead(step, *then(step, "signed", aside(step.name), constant(-1.0)), how="sense")


@mistake("M12")
def _offset_lost(scene: Scene) -> Changes:
    """The offset of a guide is forgotten, or laid off on the wrong side."""
    for step in scene.made_by("lay", "back", plan=POSITION):
        if step.plan == POSITION and role(step.operands[1]).across_guide and scene.values[step.operands[2]]:
            yield with_other(step, 2, "zero", "none")
            yield otherwise(step, "side", verb="back" if step.verb == "lay" else "lay")
    for step in scene.made_by("tangent"):
        if scene.values[step.operands[2]]:
            yield from _offset_at(step, 2)
    for step in scene.made_by("place"):
        if role(step.name).kind == ORIGIN:
            yield from (x for i in (0, 1) if scene.is_given(step.operands[i]) for x in _offset_at(step, i))


def _offset_at(step: Step, place: int) -> tuple[Change, Change]:
    return with_other(step, place, "zero", f"none {place}"), mirrored(step, place, f"side {place}")


@mistake("M13")
def _lengths_exchanged(scene: Scene) -> Changes:
    """The lengths of two links are exchanged."""
    given = scene.paper.givens
    whole = {s.operands[i] for s in scene.made_by("arc", "arcs") for i in LENGTHS[s.verb]}
    whole |= {s.operands[1] for s in scene.calculated("circular_speed")}
    whole |= {s.operands[2] for s in scene.made_by("divide")}
    for first, second in combinations((name for name in _lengths(scene) if name in whole), 2):
        yield Change(first, {}, second, {first: given[second], second: given[first]})


@mistake("M117")
def _with_another_length(scene: Scene) -> Changes:
    """Calculate an angular velocity or acceleration with the length of another link, or of a part of one."""
    spans = [name for name in _lengths(scene) if role(name).kind == "l"]
    spans += [s.name for s in scene.made_by("measure") if role(s.name).kind == "l" and not role(s.name).hidden]
    for rate in scene.calculated("turning"):
        yield from (with_other(rate, 2, name, name) for name in spans if name != rate.operands[2])


# lengths stay in millimetres
mistake("M06")(lambda scene: [Change("l", {}, data={n: scene.paper.givens[n] * 1000.0 for n in _lengths(scene)})])
# one arm is left in millimetres
mistake("M06")(lambda scene: (scaled(1000.0, step, how="arm") for step in scene.made_by("arm")))
# a dyad is put together on the other side
mistake("M11")(lambda scene: (mirrored(s, len(s.operands) - 1) for s in scene.made_by("arc", "arcs", "tangent")))


# Scales and reading.


def _readings(scene: Scene) -> list[Step]:
    """Return the readings of all plans that need its scale."""
    steps = scene.made_by("read")
    return [s for s in steps if not role(s.name).hidden and s.plan != POSITION and s.name not in scene.laid_off]


def _drawn_plans(scene: Scene) -> list[tuple[list[str], list[Step]]]:
    """Return the plans that are read, those of one scale together, with their readings."""
    by_scale: dict[float, list[str]] = {}
    for plan in dict.fromkeys(step.plan for step in _readings(scene)):
        by_scale.setdefault(scene.mu(plan), []).append(plan)
    return [(plans, [step for step in _readings(scene) if step.plan in plans]) for plans in by_scale.values()]


@mistake("M15", by_scale=True)
def _another_scale(scene: Scene) -> Changes:
    """The scale factor of velocities is taken for accelerations, or the other way round, or that of lengths."""
    for plans, steps in _drawn_plans(scene):
        if role(plans[0]).kind != FORCES:
            for other in ("velocity", "acceleration", POSITION):
                if other in scene.paper.mus and other not in plans:
                    yield scaled(scene.mu(other) / scene.mu(plans[0]), *steps, how=other, at=plans[0])


@mistake("M74", by_scale=True)
def _scale_of_another_group(scene: Scene) -> Changes:
    """The force plan of one group, or one segment of it, is read with the scale factor of another."""
    groups = [(plans[0], steps) for plans, steps in _drawn_plans(scene) if role(plans[0]).kind == FORCES]
    for plan, steps in groups:
        for other, _ in groups:
            if other != plan:
                factor = scene.mu(other) / scene.mu(plan)
                yield scaled(factor, *steps, how=other, at=plan)
                yield from (scaled(factor, step, how=f"{other} alone") for step in steps)


@mistake("M16", by_scale=True)
def _segments_without_scale(scene: Scene) -> Changes:
    """The segment of a normal part is ab^2 / AB in millimetres, which needs the crank's scale."""
    if "acceleration" in scene.paper.mus and "velocity" in scene.paper.mus:
        factor = scene.mu("acceleration") * scene.mu(POSITION) / scene.mu("velocity") ** 2
        yield scaled(factor, *scene.calculated("normal_part"), at="acceleration")


@mistake("M17", by_scale=True)
def _millimetres_for_length(scene: Scene) -> Changes:
    """The drawn millimetres of a link stand in omega = v / l in the place of its length."""
    for rate in ("omega", "epsilon"):
        steps = [s for s in scene.calculated("turning") if role(s.name).kind == rate]
        if steps:
            yield scaled(scene.mu(POSITION), *steps, how="all")
            yield scaled(1e-3, *steps, how="mm")
        if len(steps) > 1:
            yield from (scaled(scene.mu(POSITION), step, how="alone") for step in steps)


@mistake("M20")
def _centimetres(scene: Scene) -> Changes:
    """Centimetres for millimetres, on a plan or in one reading."""
    for factor in (10.0, 0.1):
        yield from (scaled(factor, *steps, how=f"{factor}", at=plans[0]) for plans, steps in _drawn_plans(scene))
        yield from (scaled(factor, step, how=f"{factor} alone") for step in _readings(scene))


@mistake("M21")
def _relative_for_absolute(scene: Scene) -> Changes:
    """The segment ab is read for v_B, and pb for v_BA."""
    by_tip: dict[str, list[Step]] = {}
    for step in _readings(scene):
        if step.plan in ("velocity", "acceleration"):
            by_tip.setdefault(step.operands[1], []).append(step)
    for steps in by_tip.values():
        absolute = next((s for s in steps if role(s.operands[0]).kind == POLE), None)
        yield from (_exchanged(scene, absolute, step) for step in steps if absolute is not None and step != absolute)


def _exchanged(scene: Scene, absolute: Step, relative: Step) -> Change:
    """Exchange two readings, and let the rates that follow have their sizes; the senses show in the drawing."""
    pair = absolute, relative
    steps: Steps = {one.name: (one.but(operands=other.operands),) for one, other in (pair, pair[::-1])}
    for rate, reading in rates(scene, absolute.plan):
        if reading in pair:
            steps = {**steps, **rate_from(scene, rate, reading.name).steps}
    return Change(relative.name, steps, absolute.name)


@mistake("M22")
def _another_position(scene: Scene) -> Changes:
    """One segment is copied from the plan of a neighbouring position."""
    if not (name := angle_of_driver(scene)):
        return
    for how, shift in (("+30", TWELFTH), ("-30", -TWELFTH)):
        angle = float(scene.paper.givens[name]) + shift
        there = run(scene.program, {**scene.paper.givens, name: math.fmod(angle, 2.0 * math.pi)}).values
        for step in _readings(scene):
            if step.plan in ("velocity", "acceleration") and there[step.name] == there[step.name]:
                yield instead(step, Step("calc", step.name, (constant(there[step.name]),), "given"), how=how)


# divided by the scale factor instead of multiplied
mistake("M14", by_scale=True)(
    lambda scene: (scaled(scene.mu(p[0]) ** -2, *steps, at=p[0]) for p, steps in _drawn_plans(scene))
)
# the scale factor is rounded after the plan is drawn
mistake("M18")(
    lambda scene: (scaled(x, *steps, how=f"{x}", at=p[0]) for p, steps in _drawn_plans(scene) for x in ROUNDED)
)
# the sheet was not printed at 100 per cent
mistake("M19")(lambda scene: [scaled(PRINTED, *_readings(scene), at="")])
# two digits of a number are transposed: that hangs on the number, and is found from the answers
mistake("M123", by_scale=True)(lambda scene: ())
# the other direction is taken as positive: that hangs on all senses and directions of a student
mistake("M126")(lambda scene: ())
# numbers of two lines are exchanged, a decimal comma is lost: they hang on the numbers, as those with two digits do
mistake("M127")(lambda scene: ())
mistake("M128")(lambda scene: ())


def transposed(scene: Scene, name: str, written: float, meant: float) -> Broken:
    """Return the construction in which a number was written for another one of the same digits, and gone on with."""
    step = scene.steps.get(f"_{name}", scene.steps[name])  # what is laid off and read again is calculated before
    return Broken("M123", scene.paper, scaled(abs(written / meant), step, how=f"{meant:.4g}", at=name))


def miswritten(number: str, scene: Scene, name: str) -> Broken:
    """Return the construction as it is, of which numbers or senses were written otherwise, of a quantity first."""
    return Broken(number, scene.paper, Change(name, {}))


def other_orders(number: float) -> Iterator[tuple[float, float]]:
    """Go through the numbers of four digits in which two neighbouring digits of a number are exchanged.

    Half a unit of the second digit comes with each: a number that is meant is as near as that, any other by chance.
    Of zeros that end the number one may have been written.
    """
    mantissa, _, power = f"{abs(number):.3e}".partition("e")
    digits = (mantissa.replace(".", "").rstrip("0") + "0")[:4]
    for i in range(len(digits) - 1):
        if digits[i] != digits[i + 1]:
            swapped = digits[:i] + digits[i + 1] + digits[i] + digits[i + 2 :]
            yield float(f"{swapped[0]}.{swapped[1:]}e{power}"), 0.5 * 10.0 ** (int(power) - i - 1)
