"""Points Z1 to Z5 of the examiner's list for the sheet of a gear pair, judged on a sheet that was read back."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator
from functools import partial
from itertools import pairwise

import shapely

from kulman.scales.scale import SERIES
from kulman.tests.support.gear_cases import (
    CIRCLES,
    NEAR,
    STEEP,
    WHEELS,
    Faults,
    GearCase,
    arc_of,
    centres,
    crossings,
    mu,
    one,
    outline,
    printed,
    tips,
    turned,
    unless,
)
from kulman.tests.support.readback import Sheet, View, angle, cross, polygon

TOOTH = 50.0  # mm


def detailed(sheet: Sheet) -> View:
    """The view in which teeth are large enough to measure on."""
    return sheet["near"] if "near" in sheet.names else sheet["meshing"]


def z1_scale(case: GearCase, sheet: Sheet) -> Faults:
    """The scale is of the standard's row, teeth are high enough, the distance of the centres is the printed one."""
    for view in (sheet["meshing"], detailed(sheet)):
        mantissa = mu(view) / 10.0 ** math.floor(math.log10(mu(view)) + 1e-9)
        yield from unless(any(abs(mantissa - m) < 1e-9 for m in SERIES), f"{view.name} has the scale factor {mu(view)}")
    view = detailed(sheet)
    height = case.sizes["h"] / mu(view)
    said = any(re.search(rf"\b{height:.1f}".replace(".", "[.,]"), t.string) for t in view.texts)
    yield from unless(height >= TOOTH or (case.format == "A4" and said), f"teeth are {height} mm high")
    whole = sheet["meshing"]
    below, above = centres(whole)
    yield from unless(abs((above - below).real) < NEAR, "the line of centres leans")
    yield from unless(abs(abs(above - below) - case.sizes["a_w"] / mu(whole)) < NEAR, f"O1O2 is {abs(above - below)}")
    yield from unless(abs(printed(whole, "a_{w}") - case.sizes["a_w"] * 1e3) < 0.00501, "a_w is printed otherwise")
    first, second = tips(whole, "a_w")
    yield from unless(abs(abs(first - second) - abs(above - below)) < NEAR, "the dimension of a_w is not O1O2")
    axis = one(whole.lines("axis", "O1O2"))
    for at in (below, above):
        yield from unless(abs(cross(axis[1] - axis[0], at - axis[0])) < NEAR * abs(axis[1] - axis[0]), "O off the axis")


def z2_circles(case: GearCase, sheet: Sheet) -> Faults:
    """Five circles a wheel about its centre, as large as they are printed, each with its own line; P is lettered."""
    for view in {v.name: v for v in (sheet["meshing"], detailed(sheet))}.values():
        pole = view.point("P")
        for i in WHEELS:
            about = [arc_of(view, f"d_{name}{i}")[0] for name in CIRCLES]
            for name, centre in zip(CIRCLES, about, strict=True):
                full, radius = f"d_{name}{i}", arc_of(view, f"d_{name}{i}")[1]
                off = 2.0 * radius - case.sizes[full if name else f"d_{i}"] / mu(view)
                yield from unless(abs(off) < NEAR, f"{view.name}: {full} is {off} mm too large")
                yield from unless(abs(centre - about[0]) < NEAR, f"{view.name}: {full} has another centre")
                number = printed(sheet["meshing"], f"d_{{{name}{i}}}")
                yield from unless(abs(number - 2e3 * radius * mu(view)) < 0.00501, f"{full} is printed as {number}")
            (dashes,) = {tuple(s.dashed for s in view.inside("circle", f"d_{name}{i}")) for name in ("w", "", "b")}
            yield from unless(dashes == (True,), f"the circles of wheel {i} cannot be told apart")
            rolling = abs(pole - about[0]) - arc_of(view, f"d_w{i}")[1]
            yield from unless(abs(rolling) < NEAR, f"{view.name}: d_w{i} misses the pole by {rolling} mm")
        yield from unless(any(t.string == "P" for t in view.texts), f"{view.name}: P has no letter")


def z3_line_of_engagement(case: GearCase, sheet: Sheet) -> Faults:
    """N1N2 passes P, touches both base circles with radii at right angles to it, and makes alpha_w with t-t."""
    view = sheet["meshing"]
    pole, ends = view.point("P"), [view.point(f"N{i}") for i in WHEELS]
    along = (ends[1] - ends[0]) / abs(ends[1] - ends[0])
    yield from unless(abs(cross(along, pole - ends[0])) < NEAR, "N1N2 misses the pole")
    drawn = one(view.lines("line-of-action", "N1N2"))
    for i, end, centre in zip(WHEELS, ends, centres(view), strict=True):
        yield from unless(abs(cross(along, end - drawn[0])) < NEAR, f"N{i} is not on the line")
        lean = abs(angle(along, centre - end)) - 90.0
        yield from unless(abs(lean) < STEEP, f"the radius to N{i} leans by {lean} degrees")
        gap = abs(cross(along, centre - end)) - case.sizes[f"d_b{i}"] / 2 / mu(view)
        yield from unless(abs(gap) < NEAR, f"N1N2 passes the base circle {i} at {gap} mm")
        radius = one(view.lines("radius", f"N{i}"))
        yield from unless(abs(radius[1] - end) < NEAR and abs(radius[0] - centre) < NEAR, f"O{i}N{i} is not drawn")
    a, b = one(view.lines("tangent", "t"))
    lean = abs(angle(b - a, along))
    lean = min(lean, 180.0 - lean)
    yield from unless(abs(lean - math.degrees(case.sizes["alpha_w"])) < STEEP, f"the angle of action is {lean}")
    yield from unless(abs(lean - printed(view, "α_{w}")) < STEEP, "alpha_w is printed otherwise")
    yield from unless(abs(cross((b - a) / abs(b - a), pole - a)) < NEAR and abs((b - a).imag) < NEAR, "t-t misses P")
    yield from unless(along.real * case.side < 0.0 < along.imag, "contacts go the wrong way")
    for i, sense in ((1, case.side), (2, -case.side)):
        turning = view.turning(f"omega_{i}")
        yield from unless(turning is not None and turning[1] == sense, f"omega_{i} turns the other way")


def z4_teeth(case: GearCase, sheet: Sheet) -> Faults:
    """Three equal involute teeth a wheel with fillets, as thick as printed, that touch on N1N2 and do not overlap."""
    view = detailed(sheet)
    bodies = []
    for i in WHEELS:
        centre, r = arc_of(view, f"d_{i}")
        points = outline(view, f"teeth_{i}")
        yield from _pitched(case, view, i)
        yield from _involute(case, view, i)
        root, fillet = arc_of(view, f"d_f{i}")[1], [abs(p - centre) for p in points]
        yield from unless(abs(min(fillet) - root) < NEAR, f"the roots of wheel {i} are at {min(fillet)}")
        yield from unless(sum(root + 0.1 < p < r for p in fillet) > 20, f"wheel {i} has no fillets")
        bodies.append(polygon((*points, centre)))
    overlap = bodies[0].intersection(bodies[1]).area
    yield from unless(all(body.is_valid for body in bodies), "an outline crosses itself")
    yield from unless(overlap < 1e-4, f"the wheels overlap by {overlap} mm2")
    pole = shapely.Point(view.point("P").real, view.point("P").imag)
    for i, body in zip(WHEELS, bodies, strict=True):
        off = body.exterior.distance(pole)
        yield from unless(off < NEAR, f"the flank of wheel {i} is {off} mm from the pole")
    for i, mate in ((1, 2), (2, 1)):
        a, b = tips(view, f"gap_{i}")
        gap = case.given["c"] * case.given["m"] / mu(view)
        yield from unless(abs(abs(a - b) - gap) < NEAR, f"the gap at root {i} is {abs(a - b)} mm")
        about = {abs(p - arc_of(view, f"d_f{i}")[0]) - arc_of(view, f"d_f{i}")[1] for p in (a, b)}
        over = {abs(p - arc_of(view, f"d_a{mate}")[0]) - arc_of(view, f"d_a{mate}")[1] for p in (a, b)}
        yield from unless(
            min(map(abs, about)) < NEAR and min(map(abs, over)) < NEAR, f"gap {i} is not from root to tip"
        )


def _pitched(case: GearCase, view: View, i: int) -> Faults:
    """Teeth stand a pitch apart and are as thick as printed, measured on the reference circle."""
    centre, r = arc_of(view, f"d_{i}")
    cuts = crossings(outline(view, f"teeth_{i}"), centre, r)
    yield from unless(len(cuts) == 6, f"wheel {i} has {len(cuts) / 2} teeth")
    for k, (a, b) in enumerate(zip(cuts, cuts[2:], strict=False)):
        pitch = turned(centre, a, b) - math.tau / case.given[f"z_{i}"]
        yield from unless(abs(pitch) * r < NEAR, f"flank {k + 1} of wheel {i} is {pitch * r} mm off the pitch")
    thick = [abs(turned(centre, a, b)) * r for a, b in zip(cuts[::2], cuts[1::2], strict=True)]
    wanted = {
        "s": case.sizes[f"s_{i}"] / mu(view),
        "e": (case.sizes["p"] - case.sizes[f"s_{i}"]) / mu(view),
    }
    for s in thick:
        yield from unless(abs(s - wanted["s"]) < NEAR, f"a tooth of wheel {i} is {s} mm thick")
    for letter, length in wanted.items():
        a, b = tips(view, f"{letter}_{i}")
        yield from unless(abs(abs(turned(centre, a, b)) * r - length) < NEAR, f"{letter}_{i} is dimensioned otherwise")
        number = printed(view, f"{letter}_{{{i}}}")
        yield from unless(abs(number - length * mu(view) * 1e3) < 0.00501, f"{letter}_{i} is printed as {number}")
        for tip in (a, b):
            far = min(abs(tip - cut) for cut in cuts)
            yield from unless(far < NEAR, f"{letter}_{i} ends {far} mm beside a flank")


def _involute(case: GearCase, view: View, i: int) -> Faults:
    """Normals of the flanks touch the base circle."""
    centre, base = arc_of(view, f"d_b{i}")
    tip, low = arc_of(view, f"d_a{i}")[1], _lowest(case, view, i)
    worst, seen = 0.0, 0
    for a, b in pairwise(outline(view, f"teeth_{i}")):
        if min(abs(a - centre), abs(b - centre)) > low + NEAR and max(abs(a - centre), abs(b - centre)) < tip - NEAR:
            normal = (b - a) / abs(b - a) * 1j
            worst = max(worst, abs(abs(cross(normal, centre - 0.5 * (a + b))) - base))
            seen += 1
    yield from unless(seen > 60 and worst < NEAR, f"a normal of wheel {i} misses the base circle by {worst} mm")


def _lowest(case: GearCase, view: View, i: int) -> float:
    """How far from the centre the involute begins, mm, where it is not undercut."""
    rho = max(case.sizes[f"rho_l{i}"], 0.0)
    return math.hypot(case.sizes[f"d_b{i}"] / 2, rho) / mu(view)


def z5_active(case: GearCase, sheet: Sheet) -> Faults:
    """The active line, its lower points, engagement from start to end, both contact ratios, zones of contact."""
    view = detailed(sheet)
    first, last = one(view.lines("active", "A1A2"))
    g = case.sizes["g_alpha"]
    yield from unless(abs(abs(last - first) - g / mu(view)) < NEAR, f"A1A2 is {abs(last - first)} mm")
    for i, mate, end in ((1, 2, first), (2, 1, last)):
        centre, tip = arc_of(view, f"d_a{mate}")
        off = abs(end - centre) - tip
        yield from unless(abs(off) < NEAR, f"A{i} is {off} mm off the tip circle of its mate")
        low, own = view.point(f"L{i}"), arc_of(view, f"d_{i}")[0]
        yield from unless(abs(abs(low - own) - abs(end - own)) < NEAR, f"L{i} is not as far from O{i} as A{i}")
        line = shapely.LineString([(p.real, p.imag) for p in outline(view, f"teeth_{i}")])
        yield from unless(line.distance(shapely.Point(low.real, low.imag)) < NEAR, f"L{i} is not on the flank")
        yield from unless(bool(view.inside("active", f"flank_{i}")), f"the active flank of wheel {i} is not marked")
        for end_name, at in (("start", first), ("end", last)):
            line = shapely.LineString([(p.real, p.imag) for p in outline(view, f"{end_name}_{i}")])
            gap = line.distance(shapely.Point(at.real, at.imag))
            yield from unless(gap < NEAR, f"the tooth of wheel {i} misses the {end_name} by {gap} mm")
    yield from _between(sheet["meshing"])
    yield from _ratios(case, sheet)
    yield from _zones(case, sheet["action"])


def _between(view: View) -> Faults:
    """The ends of the active line are between N1 and N2, in this order."""
    n, a = [view.point(f"N{i}") for i in WHEELS], [view.point(f"A{i}") for i in WHEELS]
    along = (n[1] - n[0]) / abs(n[1] - n[0])
    places = [((p - n[0]) * along.conjugate()).real for p in (*a, n[1])]
    yield from unless(0.0 < places[0] < places[1] < places[2], "A1, A2 are not between N1 and N2")


def _ratios(case: GearCase, sheet: Sheet) -> Iterator[str]:
    """The contact ratio by the drawn active line and by the drawn angles of action is the printed one."""
    view, epsilon = sheet["meshing"], case.sizes["epsilon_alpha"]
    words = [t.string for t in sheet["action"].texts if t.string.startswith("ε_{α} = ")]
    yield from unless(len(words) == 3, "the contact ratio is not printed three times")
    for text in words:
        number = float(text.rpartition("= ")[2].replace(",", "."))
        yield from unless(abs(number - epsilon) < 0.0006, f"the contact ratio is printed as {number}")
    for i, centre in zip(WHEELS, centres(view), strict=True):
        rays = [s.points for s in view.lines("ray", f"phi_alpha{i}")]
        a, b = (max(points, key=partial(_far, centre)) for points in rays)
        phi = abs(turned(centre, a, b))
        yield from unless(abs(math.degrees(phi) - printed(view, f"φ_{{α{i}}}")) < 0.006, f"phi_alpha{i} is {phi}")
        tau = math.radians(printed(view, f"τ_{{{i}}}"))
        yield from unless(abs(phi / tau - epsilon) < 0.002, f"phi/tau of wheel {i} is {phi / tau}")
        on = abs(a - centre) - arc_of(view, f"d_w{i}")[1]
        yield from unless(abs(on) < NEAR, f"the arc of action of wheel {i} is {on} mm off its rolling circle")


def _far(centre: complex, point: complex) -> float:
    return abs(point - centre)


def _zones(case: GearCase, view: View) -> Faults:
    """One pair touches where no flank is a base pitch before or behind another on the active line."""
    start = view.point("A1").real
    pitch, line = case.sizes["p_b"] / mu(view), case.sizes["g_alpha"] / mu(view)
    for stroke in (s for s in view.strokes if any(role == "zone" for role, _ in s.path)):
        (name,) = [n for role, n in stroke.path if role == "zone"]
        low, high = (f(p.real for p in stroke.points) - start for f in (min, max))
        middle = 0.5 * (low + high)
        count = sum(-1e-6 < middle + k * pitch < line + 1e-6 for k in range(-5, 6))
        yield from unless(count == int(name.partition("_")[2]), f"zone {name} has {count} pairs")
        for edge in (low, high):
            whole = min(
                abs(edge % pitch), pitch - edge % pitch, abs((line - edge) % pitch), pitch - (line - edge) % pitch
            )
            yield from unless(whole < NEAR, f"zone {name} ends {whole} mm beside a change")
    a, b = tips(view, "p_b_1")
    yield from unless(abs(abs(a - b) - pitch) < NEAR, "p_b is dimensioned otherwise")


POINTS: dict[str, Callable[[GearCase, Sheet], Faults]] = {
    "Z1": z1_scale,
    "Z2": z2_circles,
    "Z3": z3_line_of_engagement,
    "Z4": z4_teeth,
    "Z5": z5_active,
}
