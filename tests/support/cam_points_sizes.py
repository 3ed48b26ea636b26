"""Point C5 of the examiner's list for the sheet of a cam: its least sizes, for a roller and for a plate."""

from __future__ import annotations

import math

from kulman.tests.support.cam_cases import (
    MU_D2S,
    MU_DS,
    MU_S,
    MU_S_D2S,
    MU_S_DS,
    NEAR,
    STEEP,
    CamCase,
    Faults,
    curve,
    drawn_diagrams,
    level,
    measured,
    mu_l,
    printed_scales,
    ratio,
    ring,
    unless,
)
from kulman.tests.support.readback import Sheet, View, angle, cross


def c5_sizes(case: CamCase, sheet: Sheet) -> Faults:
    """Equal scales, limits that touch their branch at the permitted angle, the centre among the permitted places."""
    view, solved = sheet["sizes"], case.solved
    roller = solved.roller
    assert roller is not None
    mu = printed_scales(view)[MU_S_DS]
    yield from _transferred(case, sheet, view, mu, {"diagram_s": (MU_S, MU_S_DS), "diagram_v": (MU_DS, MU_S_DS)})
    origin = _crossing(view)
    at = view.point("O")
    for phase, sign in (("rise", 1), ("fall", -1)):
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
