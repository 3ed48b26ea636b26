"""Points C6 to C8 of the examiner's list for the sheet of a cam: inversion, profiles, followers."""

from __future__ import annotations

import cmath
import math
import re

import numpy as np
import shapely

from kulman.tests.support.cam_cases import (
    NEAR,
    STEEP,
    CamCase,
    Faults,
    measured,
    mu_l,
    ring,
    unless,
)
from kulman.tests.support.cam_points_sizes import convex_faults
from kulman.tests.support.printed_numbers import lines_of
from kulman.tests.support.readback import Sheet, angle, cross, polygon


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
        (position,) = [s for s in view.lines("position") if s.name == str(i)]
        foot, end = position.points
        up = (end - foot) / abs(end - foot)
        lean = angle(cmath.rect(1.0, math.pi / 2 - case.sense * float(phi)), up)
        yield from unless(abs(lean) < STEEP, f"position {i} is turned by {lean} degrees")
        offset = cross(foot - centre, up)
        yield from unless(abs(offset - e / mu) < NEAR, f"the line of position {i} has the offset {offset} mm")
        at, _ = ring(view, "node", str(i))
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
    sharpest = any(k == "sharpest" for r in view.rings for k, _ in r.path)
    yield from unless(sharpest or roller.profile.rho_min == 0.0, "the place of rho_min is not marked")
    (normal,) = view.lines("normal")
    a, b = normal.points
    for mark in ("K", "P"):
        place = view.point(f"{mark}{normal.name}")
        yield from unless(abs(cross((b - a) / abs(b - a), place - a)) < NEAR, f"the normal misses {mark}")
    at, _ = ring(view, "node", normal.name)
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
