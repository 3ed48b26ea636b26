"""Sheets of cams, and points C1 to C8 of the examiner's list, judged on a sheet that was read back."""

from __future__ import annotations

import cmath
import math
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from pathlib import Path

import numpy as np
import shapely

from kulman import sheet, solve
from kulman.plans.cams.solve import SolvedCam
from kulman.tests.sheets.judge import text_faults, view_faults
from kulman.tests.support.printed_numbers import equation_faults, lines_of
from kulman.tests.support.readback import Sheet, Stroke, View, angle, cross, polygon, read, svgs

NEAR, STEEP = 0.01, 0.05  # mm, degrees
Faults = Iterator[str]
MU = r"μ(?:[_^]\{[^}]*\})+"
MU_PHI, MU_S, MU_DS, MU_D2S, MU_L = "μ_{φ}", "μ_{s}", "μ_{ds/dφ}", "μ_{d}^{2}_{s/dφ}^{2}", "μ_{l}"
MU_S_DS, MU_S_D2S = "μ_{S(ds/dφ)}", "μ_{S(d}^{2}_{s/dφ}^{2}_{)}"  # of plans with one scale factor on both axes
DERIVATIVE = {"diagram_s": 0, "diagram_v": 1, "diagram_a": 2}


@dataclass(frozen=True)
class CamCase:
    """One cam as a task with changes, on a format, in a language."""

    changes: tuple[tuple[str, str], ...] = ()
    format: str = "A1"
    lang: str = "uk"
    task: str = "madi-cam"
    only: str | None = None

    def __str__(self) -> str:
        changed = ",".join(f"{name}={value}" for name, value in self.changes)
        return f"{Path(self.task).stem}-{self.format}-{self.lang}-{changed}"

    @cached_property
    def solved(self) -> SolvedCam:
        found = solve(self.task, set=dict(self.changes) or None).solved
        assert isinstance(found, SolvedCam)
        return found

    @cached_property
    def pages(self) -> tuple[str, ...]:
        changes = dict(self.changes) or None
        drawn = sheet(self.task, set=changes, only=self.only, format=self.format, lang=self.lang)
        return tuple(svgs(drawn))

    @cached_property
    def sheet(self) -> Sheet:
        return read(*self.pages)

    @property
    def sense(self) -> int:
        return self.solved.cam.sense

    def travel(self, line: int) -> float:
        return float(self.solved.motion.at(self.solved.angles[line])[0])


def unless(good: bool, fault: str) -> Faults:
    if not good:
        yield fault


def apart(case: CamCase, sheet: Sheet) -> Faults:
    """Views stand apart within the frame."""
    for page in sheet.pages:
        yield from (f"{fault.view}: {fault.said}" for fault in view_faults(page))


# What is drawn in a view.
def tips(view: View, name: str) -> list[complex]:
    """Tips of the arrowheads of a dimension."""
    return [t.corners[0] for t in view.tips if ("dimension", name) in t.path]


def measured(view: View, name: str) -> float:
    """Distance between the two arrowheads of a dimension, mm."""
    a, b = tips(view, name)
    return abs(b - a)


def ring(view: View, role: str, name: str) -> tuple[complex, float]:
    (found,) = [r for r in view.rings if (role, name) in r.path]
    return found.centre, found.radius


def node(view: View, name: str) -> complex:
    return ring(view, "node", name)[0]


def curve(view: View, name: str) -> list[complex]:
    """All points of a curve, its pieces one after the other."""
    return [p for s in view.inside("curve", name) for p in s.points]


def level(stroke: Stroke) -> float:
    return stroke.points[0].imag


@dataclass(frozen=True)
class Diagram:
    """One diagram: where its axes meet, mm for a unit of the angle and of its ordinate."""

    origin: complex
    across: float
    up: float

    def at(self, phi: float, value: float) -> complex:
        return self.origin + complex(phi * self.across, value * self.up)


def printed_scales(view: View) -> dict[str, float]:
    """Scale factors in the headings and beside the axes of a view, by symbol, a unit a mm."""
    found = {}
    for text in view.texts:
        for symbols, number in re.findall(rf"(?<!/)((?:{MU} = )+)(\d+[.,]?\d*)", text.string):
            found |= dict.fromkeys(re.findall(MU, symbols), float(number.replace(",", ".")))
    return found


def ratio(view: View, over: str, under: str) -> float:
    """The printed ratio of two scale factors."""
    (found,) = [
        m[1] for t in view.texts if (m := re.search(re.escape(f"{over}/{under}") + r" = (\d+[.,]?\d*)", t.string))
    ]
    return float(found.replace(",", "."))


def mu_l(view: View) -> float:
    """The printed scale factor of lengths, m a mm."""
    return printed_scales(view)[MU_L]


def drawn_diagrams(case: CamCase, view: View) -> dict[str, Diagram]:
    """The diagrams from the top: their origins are read back, their scale factors are those that are printed."""
    plans = [plan for plan in DERIVATIVE if view.inside("curve", plan)]
    plans.sort(key=lambda plan: -DERIVATIVE[plan])
    x_0 = min(p.real for s in view.inside("section", "0") for p in s.points)
    axes = [s for s in view.lines("axis") if abs(s.points[0] - complex(x_0, level(s))) < NEAR]
    levels = sorted({round(level(s), 3) for s in axes if level(s) == s.points[1].imag}, reverse=True)
    mus, k = printed_scales(view), reduction(case, view)
    symbols = {"diagram_a": ("mu_d2s", MU_D2S), "diagram_v": ("mu_ds", MU_DS), "diagram_s": ("mu_s", MU_S)}
    found = {}
    for plan, y in zip(plans, levels, strict=True):
        mu = case.solved.values[symbols[plan][0]] / k
        assert abs(mus[symbols[plan][1]] / mu - 1.0) < 5e-5, f"the scale factor of {plan} is printed otherwise"
        found[plan] = Diagram(complex(x_0, y), k / case.solved.values["mu_phi"], 1.0 / mu)
    return found


def reduction(case: CamCase, view: View) -> float:
    """How many times smaller than the task says the diagrams are drawn: their printed scale factor of angles tells."""
    return float(f"{case.solved.values['mu_phi'] / printed_scales(view)[MU_PHI]:.4g}")


def c1_three_diagrams(case: CamCase, sheet: Sheet) -> Faults:
    """Diagrams over one another on one axis, section lines through all, phases in degrees, jumps on section lines."""
    view, solved = sheet["diagrams"], case.solved
    found = drawn_diagrams(case, view)
    yield from unless(len(found) == (3 if solved.layout.given == "diagram_a" else 2), f"{len(found)} diagrams")
    first, last = next(iter(found.values())), list(found.values())[-1]
    xs = []
    for i, phi in enumerate(solved.angles):
        pieces = view.inside("section", str(i))
        places = [p for s in pieces for p in s.points]
        xs.append(places[0].real)
        yield from unless(all(abs(p.real - xs[-1]) < NEAR for p in places), f"section line {i} is not straight")
        yield from unless(abs(xs[-1] - first.at(phi, 0).real) < 0.02, f"section line {i} is not at its angle")
        through = max(p.imag for p in places) > first.origin.imag and min(p.imag for p in places) < last.origin.imag
        yield from unless(through, f"section line {i} does not run through all diagrams")
    upright = [s for s in view.pieces if any(("section", str(i)) in s.path for i in solved.layout.division.lines)]
    lines = shapely.MultiLineString([[(p.real, p.imag) for p in s.points] for s in upright])
    crossed = [t.string for t in view.texts if shapely.box(*t.box).intersects(lines) and not t.turned]
    yield from unless(not crossed, f"section lines run through {crossed}")
    for phase in solved.motion.phases[:3]:
        if phase.length > 0.0:
            length = measured(view, f"phi_{phase.name}")
            yield from unless(abs(length - phase.length * first.across) < 0.02, f"phase {phase.name}: {length} mm")
            degrees = f"{math.degrees(phase.length):.6g}°".replace(".", "." if case.lang == "en" else ",")
            yield from unless(any(degrees in t.string for t in view.texts), f"{degrees} is not printed")
    if "diagram_a" in found:
        yield from _jumps(case, view, found["diagram_a"], xs)


def _jumps(case: CamCase, view: View, diagram: Diagram, xs: list[float]) -> Faults:
    motion, end = case.solved.motion, float(case.solved.angles[-1])
    steps = [s for s in view.strokes if any(k == "jump" and n.startswith("diagram_a") for k, n in s.path)]
    expected = [jump for jump in motion.jumps if jump.order == 2 and jump.phi <= end + 1e-9]
    yield from unless(len(steps) == len(expected), f"{len(steps)} jumps, not {len(expected)}")
    for step, jump in zip(sorted(steps, key=lambda s: s.points[0].real), expected, strict=False):
        yield from unless(any(abs(step.points[0].real - x) < NEAR for x in xs), "a jump lies on no section line")
        for place, value in zip(step.points, (jump.before, jump.after), strict=True):
            yield from unless(abs(place - diagram.at(jump.phi, value)) < 0.02, f"a jump does not end at {value}")


def c2_chords(case: CamCase, sheet: Sheet) -> Faults:
    """Every chord is parallel to the ray of its section; the travel returns to zero, the closing error is printed."""
    view, solved = sheet["diagrams"], case.solved
    found, rays = drawn_diagrams(case, view), view.lines("ray")
    chain = [plan for plan in ("diagram_a", "diagram_v", "diagram_s") if plan in found]
    gaps: dict[str, float] = {}
    for plan, onto in pairwise(chain):
        origin = found[plan].origin
        own = [s for s in rays if abs(s.points[0].imag - origin.imag) < NEAR]
        distance = solved.values["H_a" if plan == "diagram_a" else "H_v"] * 1e3 * reduction(case, view)
        yield from unless(bool(own), f"no rays at {plan}")
        feet = own[0].points[1].real if own else origin.real  # the line on which rays end, beside the axis
        yield from unless(feet < origin.real, f"rays of {plan} run into the diagram")
        for ray in own:
            right = abs(ray.points[0] - complex(feet - distance, origin.imag)) < NEAR
            right = right and abs(ray.points[1].real - feet) < NEAR
            yield from unless(right, f"ray {ray.name} of {plan} does not run from the pole to the line of feet")
        yield from _numbered(case, view, plan, (feet, origin), own)
        of = {name: ray for ray in own for name in ray.name.split()}
        chords = view.inside("chords", onto)
        yield from unless(len(chords) == solved.layout.division.last, f"{len(chords)} chords on {onto}")
        ends = [found[onto].origin, *(chord.points[1] for chord in chords)]
        for chord, start in zip(chords, ends, strict=False):
            yield from unless(abs(chord.points[0] - start) < NEAR, f"chord {chord.name} of {onto} hangs in the air")
            lean = angle(chord.points[1] - chord.points[0], of[chord.name].points[1] - of[chord.name].points[0])
            yield from unless(abs(lean) < STEEP, f"chord {chord.name} of {onto} is not parallel to its ray: {lean}")
        gaps[onto] = abs(ends[-1].imag - found[onto].origin.imag)
    said = " ".join(lines_of(sheet["equations_scales"]))
    for onto, symbol in (("diagram_s", "ΔS"), ("diagram_v", r"Δ\(ds/dφ\)")):
        if onto in gaps:
            printed = re.search(rf"{symbol} = (\d+[.,]\d\d)", said)
            yield from unless(printed is not None, f"the closing error of {onto} is not printed")
            good = printed is not None and abs(float(printed[1].replace(",", ".")) - gaps[onto]) < NEAR
            yield from unless(good, f"{onto} does not close by {gaps[onto]} mm, another number is printed")


def _numbered(case: CamCase, view: View, plan: str, strip: tuple[float, complex], rays: list[Stroke]) -> Faults:
    """All rays end at the heights of their mean ordinates; beside the axis stand all their numbers."""
    feet, origin = strip
    marks = {n: r.centre for r in view.rings for k, n in r.path if k == "mean"} if plan == "diagram_v" else {}
    for ray in rays:
        missed = [n for n in ray.name.split() if n in marks and abs(marks[n].imag - ray.points[1].imag) > NEAR]
        yield from unless(not missed, f"a ray of {plan} misses the mean ordinates {missed}")
    heights = [ray.points[1].imag for ray in rays]
    low, high = min(heights) - 3.0, max(heights) + 3.0
    pole = rays[0].points[0]
    beside = [t for t in view.texts if feet < t.box[0] and t.box[2] < origin.real and low < t.box[1] < high]
    beyond = [t for t in view.texts if t.box[2] < pole.real and -5.0 < t.box[1] - pole.imag < 0.0]
    texts = beside + beyond
    numbers: list[int] = []
    for part in ", ".join(t.string for t in texts if re.fullmatch(r"[\d,– ]+", t.string)).split(", "):
        first, _, last = part.partition("–")
        numbers += range(int(first), int(last or first) + 1)
    wanted = [*range(1, case.solved.layout.division.last + 1)]
    yield from unless(sorted(numbers) == wanted, f"the rays of {plan} have the numbers {sorted(numbers)}")


def c3_law(case: CamCase, sheet: Sheet) -> Faults:
    """Amplitudes and lobes are in the ratio of u, both lobes have one area, the fall has the stated order."""
    view, solved = sheet["diagrams"], case.solved
    if "diagram_a" not in (found := drawn_diagrams(case, view)):
        return
    u, diagram = solved.values["u"], found["diagram_a"]
    ratio = measured(view, "l_A2") / measured(view, "l_A1")
    yield from unless(abs(ratio - u / (1.0 - u)) < 1e-3, f"A_2/A_1 is {ratio}")
    points = [p - diagram.origin for p in curve(view, "diagram_a")]
    top = solved.motion.rise.end * diagram.across
    rise = [p for p in points if p.real <= top + NEAR]
    areas = [0.5 * (a.imag + b.imag) * (b.real - a.real) for a, b in pairwise(rise)]
    positive, negative = sum(area for area in areas if area > 0.0), sum(area for area in areas if area < 0.0)
    yield from unless(abs(positive + negative) < 0.005 * positive, f"the lobes have the areas {positive}, {negative}")
    join = [a for a, b in pairwise(rise) if a.imag > NEAR >= b.imag or a.imag >= -NEAR > b.imag]
    yield from unless(bool(join) and abs(join[-1].real / top - u) < 0.01, "the lobes do not join at u")
    if solved.cam.falls_by == solved.cam.law and solved.cam.fall == "mirror":
        start, ratio = solved.motion.fall.start * diagram.across, solved.motion.rise.length / solved.motion.fall.length
        fall = [complex((p.real - start) * ratio, p.imag / ratio**2) for p in points if p.real >= start - NEAR]
        back = [complex(top - p.real, p.imag) for p in reversed(rise)]
        fallen, backwards = (shapely.LineString([(p.real, p.imag) for p in part]) for part in (fall, back))
        yield from unless(shapely.hausdorff_distance(fallen, backwards) < 0.02, "the fall is not the rise backwards")


def c4_scale_factors(case: CamCase, sheet: Sheet) -> Faults:
    """The printed scale factors follow from one another to their last digit; analogues carry m/mm."""
    said, solved = lines_of(sheet["equations_scales"]), case.solved
    count, faults = equation_faults(sheet)
    yield from faults
    yield from unless(count >= 8, f"only {count} calculations")
    metre = "m/mm" if case.lang == "en" else "м/мм"
    second = (MU_D2S, "μ_{a}") if "mu_a" in solved.values else ()
    for symbol in (MU_S, MU_DS, "μ_{v}", *second):
        lines = [line for line in said if line.startswith(f"{symbol} =")]
        yield from unless(bool(lines), f"{symbol} is not calculated")
        if lines and "d" in symbol:
            yield from unless(lines[0].endswith(f" {metre}"), f"{symbol} has another unit: {lines[0]}")


def c5_sizes(case: CamCase, sheet: Sheet) -> Faults:
    """Equal scales, limits that touch their branch at the permitted angle, the centre among the permitted places."""
    view, solved = sheet["sizes"], case.solved
    roller = solved.roller
    assert roller is not None
    mu = printed_scales(view)[MU_S_DS]
    yield from _transferred(case, sheet, view, mu, {"diagram_s": (MU_S, MU_S_DS), "diagram_v": (MU_DS, MU_S_DS)})
    origin = _crossing(view)
    at = view.point("O")
    for phase, sign in (("rise", -1), ("fall", 1)):  # to the side to which a velocity upwards turns with the cam
        points = curve(view, phase)
        out = max(points, key=lambda p: abs(p.real - origin.real))
        yield from unless((out.real - origin.real) * sign * case.sense > 0, f"the {phase} lies on the wrong side")
    for name, gamma in (("rise", roller.limits.gamma_rise), ("fall", roller.limits.gamma_fall)):
        (limit,) = view.lines("limit", name)
        top, foot = sorted(limit.points, key=lambda p: -p.imag)
        along = (top - foot) / abs(top - foot)
        steep = math.degrees(math.atan2(along.imag, abs(along.real)))
        yield from unless(abs(steep - math.degrees(gamma)) < STEEP, f"the limit of the {name} has {steep} degrees")
        beyond = [cross(along, p - foot) for p in curve(view, name)]
        side = 1.0 if abs(min(beyond)) > abs(max(beyond)) else -1.0
        nearest = max(side * b for b in beyond)
        yield from unless(abs(nearest) < NEAR, f"the limit of the {name} passes its branch by {nearest}")
        beyond_it = side * cross(along, at - foot)  # on the other side than the branch
        yield from unless(beyond_it > -NEAR, f"the limit of the {name} forbids O")
    for name, value in (("r_0", roller.sizes.r_0), ("e", abs(roller.sizes.e))):
        if value < 1e-9:
            continue  # a central follower
        yield from unless(abs(measured(view, name) * mu - value) < 0.02 * mu, f"{name} has {measured(view, name)} mm")
    yield from unless(abs(abs(at - origin) * mu - roller.sizes.r_0) < 0.02 * mu, "O is not r_0 from the lowest place")
    beside = (at - origin).real * mu + roller.sizes.e  # the follower stands e to the right of O, as on the profile
    yield from unless(abs(beside) < 0.02 * mu, "O is on the other side of the follower than on the profile")
    _, r_0 = ring(sheet["profile"], "circle", "r_0")
    size = abs(at - origin) * mu / mu_l(sheet["profile"])
    yield from unless(abs(size - r_0) < 0.02, f"r_0 is {size} mm here, {r_0} mm in the profile")
    numbers = {n for s in view.rings for k, n in s.path if k == "node"}
    rise = {f"{i}_rise" for i in solved.layout.division.rise}
    yield from unless(rise <= numbers, "points have no marks")
    yield from _pressure(case, sheet)


def _transferred(case: CamCase, sheet: Sheet, view: View, mu: float, symbols: dict[str, tuple[str, str]]) -> Faults:
    """The plan says by how much ordinates of the diagrams are multiplied."""
    if "diagrams" not in sheet.names:
        return
    diagrams = drawn_diagrams(case, sheet["diagrams"])
    for plan, (over, under) in symbols.items():
        times = 1.0 / (diagrams[plan].up * mu)
        yield from unless(abs(ratio(view, over, under) - times) < 2e-4, f"ordinates of {plan} are not {times} times")


def _crossing(view: View) -> complex:
    """Where the axes of a view meet."""
    axes = [s for s in view.lines("axis") if not s.dashed]
    (across,) = {round(level(s), 4) for s in axes if abs(s.points[0].imag - s.points[1].imag) < NEAR}
    (upright,) = {round(s.points[0].real, 4) for s in axes if abs(s.points[0].real - s.points[1].real) < NEAR}
    return complex(upright, across)


def _pressure(case: CamCase, sheet: Sheet) -> Faults:
    """The pressure angle never passes its dashed limits."""
    view, sense = sheet["pressure"], case.sense
    every = curve(view, "theta")
    for phase, way in (("rise", sense), ("fall", -sense)):
        limits = [s for s in view.strokes if any(k == "limit" and n.startswith(phase) for k, n in s.path)]
        limit = limits[0]
        yield from unless(limit.dashed, "a limit is not dashed")
        a, b = sorted(p.real for p in limit.points)
        over = [way * (p.imag - level(limit)) for p in every if a - NEAR <= p.real <= b + NEAR]
        yield from unless(max(over) < 0.02, f"the pressure angle passes its limit in the {phase} by {max(over)} mm")


def convex_faults(case: CamCase, sheet: Sheet) -> Faults:
    view, plate = sheet["plate_sizes"], case.solved.plate
    assert plate is not None
    mu = printed_scales(view)[MU_S_D2S]
    yield from _transferred(case, sheet, view, mu, {"diagram_s": (MU_S, MU_S_D2S), "diagram_a": (MU_D2S, MU_S_D2S)})
    (limit,) = view.lines("limit", "convex")
    a, b = sorted(limit.points, key=lambda p: p.real)
    along, origin = (b - a) / abs(b - a), _crossing(view)
    yield from unless(abs(angle(along, 1 - 1j)) < STEEP, "the tangent has not 45 degrees")
    beyond = min(cross(along, p - a) for phase in ("rise", "fall") for p in curve(view, phase))
    yield from unless(abs(beyond) < NEAR, f"the tangent passes the curve by {beyond} mm")
    foot = a + along * ((origin.real - a.real) / along.real)
    size = (origin.imag - foot.imag) * mu
    yield from unless(abs(size - plate.sizes.r_0_min) < 0.02 * mu, f"the tangent gives r_0min {size}")
    for name, value in (("r_0_flat_min", plate.sizes.r_0_min), ("r_0_flat", plate.sizes.r_0)):
        yield from unless(abs(measured(view, name) * mu - value) < 0.02 * mu, f"{name} is dimensioned otherwise")


def c6_inversion(case: CamCase, sheet: Sheet) -> Faults:
    """Positions against the arrow of omega, lines that touch the circle e, the pitch curve where it must be."""
    view, solved = sheet["profile"], case.solved
    roller, mu = solved.roller, mu_l(sheet["profile"])
    assert roller is not None
    centre, r_0 = ring(view, "circle", "r_0")
    e, s_0 = roller.sizes.e, roller.sizes.s_0
    heading = " ".join(t.string for t in view.of("heading"))
    yield from unless(re.search(r"[MМ] \d+([.,]\d+)?:\d", heading) is not None, "the scale is not written as M 1:1")
    turning = view.turning("omega")
    yield from unless(turning is not None and turning[1] == case.sense, "omega turns the other way")
    if abs(e / mu) > 0.05:
        yield from unless(abs(ring(view, "circle", "e")[1] - abs(e) / mu) < NEAR, "the circle e has another radius")
    (pitch,) = view.inside("curve", "pitch")
    yield from unless(pitch.dashed, "the pitch curve is not dash-dot")
    line = shapely.LineString([(p.real, p.imag) for p in pitch.points])
    for i, phi in enumerate(solved.angles):
        pieces = [s for s in view.lines("position") if s.name == str(i)]  # it is broken at letters
        foot, end = pieces[0].points[0], pieces[-1].points[-1]
        up = (end - foot) / abs(end - foot)
        lean = angle(cmath.rect(1.0, math.pi / 2 - case.sense * float(phi)), up)
        yield from unless(abs(lean) < STEEP, f"position {i} is turned by {lean} degrees")
        offset = cross(foot - centre, up)
        yield from unless(abs(offset - e / mu) < NEAR, f"the line of position {i} has the offset {offset} mm")
        at = node(view, str(i))
        distance = math.hypot(e, s_0 + case.travel(i)) / mu
        yield from unless(abs(abs(at - centre) - distance) < NEAR, f"pitch point {i} is {abs(at - centre)} mm from O")
        yield from unless(abs(cross(at - foot, up)) < NEAR, f"pitch point {i} is not on its line")
        yield from unless(line.distance(shapely.Point(at.real, at.imag)) < NEAR, f"the pitch curve passes by point {i}")
    lower = [p for p in pitch.points if abs(abs(p - centre) - r_0) < 0.003]
    share = len(lower) / len(pitch.points)
    yield from unless(share > 0.9 * solved.motion.lower.length / math.tau, "the lower dwell is no arc about O")


def c7_practical(case: CamCase, sheet: Sheet) -> Faults:
    """The practical profile lies R inside of the pitch curve, rollers touch it, all hardware is drawn."""
    view, solved = sheet["profile"], case.solved
    roller, mu = solved.roller, mu_l(sheet["profile"])
    assert roller is not None
    R = roller.profile.R / mu
    (pitch,), (practical,) = view.inside("curve", "pitch"), view.inside("curve", "practical")
    body, around = polygon(practical.points), polygon(pitch.points)
    yield from unless(body.is_valid, "the practical profile has a loop")
    yield from unless(practical.width == max(s.width for s in view.strokes), "the practical profile is not a main line")
    gaps = shapely.distance(around.exterior, shapely.points([(p.real, p.imag) for p in practical.points]))
    cut = bool(roller.profile.undercuts)
    yield from unless(float(np.min(gaps)) > R - NEAR, f"the profile is {float(np.min(gaps))} mm from the pitch curve")
    yield from unless(cut or float(np.max(gaps)) < R + NEAR, f"the profile is {float(np.max(gaps))} mm away")
    for i in solved.layout.division.lines:
        at, radius = ring(view, "roller", str(i))
        yield from unless(abs(radius - R) < NEAR, f"roller {i} has the radius {radius}")
        clear = body.exterior.distance(shapely.Point(at.real, at.imag)) - R
        yield from unless(clear > -NEAR and (cut or clear < NEAR), f"roller {i} is {clear} mm off the profile")
    for role, name in (("link", "rod"), ("spring", "spring"), ("guide", "guide"), ("shaft", "O")):
        yield from unless(bool(view.inside(role, name)), f"no {name} is drawn")
    rod, guide = ([p.real for s in view.inside(*of) for p in s.points] for of in (("link", "rod"), ("guide", "guide")))
    yield from unless(min(guide) < 0.5 * (min(rod) + max(rod)) < max(guide), "the rod is not guided on both sides")
    sharpest = any(k == "sharpest" for r in view.rings for k, _ in r.path)
    yield from unless(sharpest or roller.profile.rho_min == 0.0, "the place of rho_min is not marked")
    normal, *pieces = view.lines("normal")  # far from one another, where it breaks off at what stands on it
    a, b = normal.points
    whole = all(abs(cross((b - a) / abs(b - a), end - a)) < NEAR for piece in pieces for end in piece.points)
    yield from unless(whole, "there are several normals")
    for mark in ("K", "P"):
        place = view.point(f"{mark}{normal.name}")
        yield from unless(abs(cross((b - a) / abs(b - a), place - a)) < NEAR, f"the normal misses {mark}")
    at = node(view, normal.name)
    yield from unless(abs(cross((b - a) / abs(b - a), at - a)) < NEAR, "the normal misses the roller's centre")
    words = " ".join(lines_of(sheet["equations_roller"]))
    yield from unless(words.count("≤") >= 2 and re.search(r"0[.,]4·r", words) is not None, "R_rol is not compared")


def c8_plate(case: CamCase, sheet: Sheet) -> Faults:
    """The tangent at 45 degrees gives r_0min; every plate touches the convex profile at |s'| and never cuts it."""
    solved = case.solved
    plate = solved.plate
    assert plate is not None
    yield from convex_faults(case, sheet)
    view = sheet["plate_profile"]
    mu, (centre, r_0) = mu_l(view), ring(view, "circle", "r_0_flat")
    yield from unless(abs(r_0 - plate.sizes.r_0 / mu) < NEAR, f"r_0 is {r_0} mm")
    (practical,) = view.inside("curve", "practical")
    body = polygon(practical.points)
    yield from unless(body.is_valid and body.convex_hull.area - body.area < 1e-3, "the profile is not convex")
    for i, phi in enumerate(solved.angles):
        if i == 0:
            continue  # the plate itself
        (line,) = [s for s in view.lines("plate") if s.name == str(i)]
        a, b = line.points
        up = cmath.rect(1.0, math.pi / 2 - case.sense * float(phi))
        yield from unless(abs(((b - a) * up.conjugate()).real) < NEAR, f"plate {i} is not normal to its axis")
        height = ((a - centre) * up.conjugate()).real
        yield from unless(abs(height - (plate.sizes.r_0 + case.travel(i)) / mu) < NEAR, f"plate {i} is at {height} mm")
        heights = [((p - centre) * up.conjugate()).real - height for p in practical.points]
        yield from unless(abs(max(heights)) < NEAR, f"plate {i} misses the profile by {max(heights)} mm")
        contact, _ = ring(view, "contact", str(i))
        beside = abs(((contact - centre) * up.conjugate()).imag)
        ds = abs(float(solved.motion.at(phi, -1)[1])) / mu
        yield from unless(abs(beside - ds) < NEAR, f"plate {i} touches {beside} mm beside its axis")
    yield from unless(
        abs(measured(view, "R_plate") * mu - plate.sizes.R_plate) < 0.02 * mu, "R_plate is not dimensioned"
    )
    margin = plate.sizes.R_plate - solved.motion.ds_max.value
    yield from unless(abs(margin - solved.values["margin"]) < 1e-9, "the plate has another margin")


def touching(case: CamCase, sheet: Sheet) -> Faults:
    """Letters that touch a letter, a main line, an arrowhead, or a mark."""
    for view in sheet.views:
        yield from (f"{fault.view}: {fault.said}" for fault in text_faults(view))


POINTS: dict[str, Callable[[CamCase, Sheet], Faults]] = {
    "C1": c1_three_diagrams,
    "C2": c2_chords,
    "C3": c3_law,
    "C4": c4_scale_factors,
    "C5": c5_sizes,
    "C6": c6_inversion,
    "C7": c7_practical,
    "C8": c8_plate,
    "G1": apart,
    "G5": touching,
}
