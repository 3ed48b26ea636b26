"""Points C1 to C4 of the examiner's list for the sheet of a cam: its diagrams and their scale factors."""

from __future__ import annotations

import math
import re
from itertools import pairwise

import shapely

from kulman.tests.support.cam_cases import (
    MU_D2S,
    MU_DS,
    MU_S,
    NEAR,
    STEEP,
    CamCase,
    Diagram,
    Faults,
    curve,
    drawn_diagrams,
    measured,
    reduction,
    unless,
)
from kulman.tests.support.printed_numbers import equation_faults, lines_of
from kulman.tests.support.readback import Sheet, Stroke, View, angle


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
    upright = [s for i in solved.layout.division.lines for s in view.inside("section", str(i))]
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
    positive, negative = _areas(rise)
    yield from unless(abs(positive + negative) < 0.005 * positive, f"the lobes have the areas {positive}, {negative}")
    join = [a for a, b in pairwise(rise) if a.imag > NEAR >= b.imag or a.imag >= -NEAR > b.imag]
    yield from unless(bool(join) and abs(join[-1].real / top - u) < 0.01, "the lobes do not join at u")
    if solved.cam.falls_by == solved.cam.law and solved.cam.fall == "mirror":
        start, ratio = solved.motion.fall.start * diagram.across, solved.motion.rise.length / solved.motion.fall.length
        fall = [complex((p.real - start) * ratio, p.imag / ratio**2) for p in points if p.real >= start - NEAR]
        back = [complex(top - p.real, p.imag) for p in reversed(rise)]
        yield from unless(_apart(fall, back) < 0.02, "the fall is not the rise backwards")


def _areas(points: list[complex]) -> tuple[float, float]:
    above, below = 0.0, 0.0
    for a, b in pairwise(points):
        area = 0.5 * (a.imag + b.imag) * (b.real - a.real)
        above, below = above + max(area, 0.0), below + min(area, 0.0)
    return above, below


def _apart(a: list[complex], b: list[complex]) -> float:
    first, second = (shapely.LineString([(p.real, p.imag) for p in points]) for points in (a, b))
    return float(shapely.hausdorff_distance(first, second))


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
