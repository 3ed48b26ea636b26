"""Points Z6 and Z7 of the examiner's list for the sheet of a gear pair, judged on a sheet that was read back."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from itertools import pairwise

from kulman.plans.gears.teeth import meshing_of
from kulman.tests.support.gear_cases import NEAR, WHEELS, Faults, GearCase, one, tips, unless
from kulman.tests.support.gear_tables import NUMBER, calculations, last_digit, number, rows
from kulman.tests.support.readback import Sheet, View

CURVES = {1: "theta_12", 2: "theta_21"}
ENDS = ("A1", "A2")
PLACES = {"N1": "01", "P": "06", "N2": "12"}


def heading(view: View) -> str:
    return "; ".join(t.string for t in view.of("heading"))


def scale(view: View, symbol: str) -> float:
    found = re.search(rf"{re.escape(symbol)} = ({NUMBER})", heading(view))
    assert found, symbol
    return number(found[1])


def nodes(view: View, role: str, name: str) -> dict[str, complex]:
    """Circles of a role whose names begin so, by what follows."""
    return {n.removeprefix(name): r.centre for r in view.rings for k, n in r.path if k == role and n.startswith(name)}


def z6_sliding(case: GearCase, sheet: Sheet) -> Faults:
    """Lines of V_k from N1 and N2 over P, steady ordinates, curves of theta with their limits, the active part."""
    view = sheet["sliding"]
    yield from _velocities(case, view)
    yield from _table(case, view, rows(sheet["points"])[1:])
    for i in WHEELS:
        yield from _curve(case, view, i)
    yield from _active(case, view)


def _velocities(case: GearCase, view: View) -> Faults:
    first, last, pole, w = (view.point(name) for name in ("N1", "N2", "P", "W"))
    mu, sizes = scale(view, "μ_{ρ}"), case.sizes
    for name, rho in (("A1", "rho_p1"), ("P", "rho_w1"), ("A2", "rho_a1"), ("N2", "l_N1N2")):
        off = abs(view.point(name) - first - sizes[rho] / mu)
        yield from unless(off < NEAR, f"{name} is {off} mm beside its place")
    yield from unless(abs((w - pole).real) < NEAR, "W is not over the pole")
    for i, foot in zip(WHEELS, (first, last), strict=True):
        ends = one(view.inside("curve", f"V_k{i}"))
        yield from unless(min(abs(end - foot) for end in ends) < NEAR, f"V_k{i} does not begin in N{i}")
        sine = ((ends[1] - ends[0]).conjugate() * (w - ends[0])).imag / abs(ends[1] - ends[0])
        yield from unless(abs(sine) < NEAR, f"V_k{i} misses W by {sine} mm")
    a, b = tips(view, "PW")
    yield from unless(abs(abs(a - b) - abs(w - pole)) < NEAR, "PW is dimensioned otherwise")


def _reduction(view: View) -> float:
    found = re.search(r"(\d+):(\d+(?:[.,]\d+)?)", heading(view).split("μ")[0])
    return number(found[2]) if found else 1.0


def _table(case: GearCase, view: View, table: list[list[str]]) -> Faults:
    """The table has the ordinates that are drawn, steady ones, and sliding that comes out of them."""
    axis, times = view.point("N1").imag, _reduction(view)
    yield from unless(len(table) == 12, f"the table has {len(table)} points")
    y: dict[int, list[float]] = {1: [], 2: []}
    for k, row in enumerate(table, start=1):
        cells = row[-6:]
        for i in WHEELS:
            y[i].append(number(cells[i - 1]))
            drawn = (nodes(view, "ordinate", f"y_{i}_")[f"{k:02d}"].imag - axis) * times
            off = abs(drawn - y[i][-1])
            yield from unless(off < NEAR * times + last_digit(cells[i - 1]), f"y_{i} of point {k} is drawn {drawn}")
        for own, mate, difference, theta in ((0, 1, 2, 3), (1, 0, 4, 5)):
            ys = number(cells[own]), number(cells[mate])
            yield from unless(abs(number(cells[difference]) - ys[0] + ys[1]) < 1e-9, f"the difference of point {k}")
            if ys[0] == 0.0:
                yield from unless(cells[theta] == "−∞", f"sliding of point {k} is {cells[theta]}")
                continue
            again = (ys[0] - ys[1]) / ys[0]
            yield from unless(
                abs(again - number(cells[theta])) <= last_digit(cells[theta]) + 1e-9, f"sliding of point {k}: {again}"
            )
            exact = _theta(case, k, own + 1)
            off = abs(exact - number(cells[theta]))
            yield from unless(off <= last_digit(cells[theta]) + 1e-9, f"sliding of point {k} is {exact}")
    yield from unless(all(b > a for a, b in pairwise(y[1])), "y_1 does not grow")
    yield from unless(all(b < a for a, b in pairwise(y[2])), "y_2 does not fall")


def _theta(case: GearCase, k: int, i: int) -> float:
    return case.sizes[f"{CURVES[i]}_{k:02d}"]


def _curve(case: GearCase, view: View, i: int) -> Faults:
    """A curve keeps its law, is 1 at the other wheel's N, 0 in the pole, and goes down to the stated value."""
    (line,) = view.inside("curve", CURVES[i])
    first, mu, mu_theta = view.point("N1"), scale(view, "μ_{ρ}"), scale(view, "μ_{θ}")
    axis = next(
        s.points[0].imag for s in view.lines("axis") if s.points[0].imag < first.imag - 1.0 and _level(s.points)
    )
    whole, u = case.sizes["l_N1N2"], case.sizes["u"]
    for p in line.points:
        rho_1, theta = (p.real - first.real) * mu, (p.imag - axis) * mu_theta
        own, mate, ratio = (rho_1, whole - rho_1, u) if i == 1 else (whole - rho_1, rho_1, 1.0 / u)
        # as a distance from the curve: it is steep near its own end
        off = (
            (theta - 1.0 + mate / (ratio * own)) / mu_theta / math.hypot(1.0, whole * mu / (ratio * own**2) / mu_theta)
        )
        yield from unless(abs(off) < NEAR, f"{CURVES[i]} is {off} mm beside its law at rho_1 = {rho_1}")
    ends = sorted(line.points, key=lambda p: p.imag)
    yield from unless(abs((ends[-1].imag - axis) * mu_theta - 1.0) < NEAR * mu_theta, "the highest sliding is not 1")
    cut = number(heading(view).split("θ = ")[1])
    yield from unless(abs((ends[0].imag - axis) * mu_theta - cut) < NEAR * mu_theta, f"not cut off at {cut}")
    pole = min(line.points, key=lambda p: abs(p.imag - axis))
    yield from unless(abs(pole.real - view.point("P").real) < 2.0, "sliding is not 0 in the pole")
    for point, at in nodes(view, "node", f"{CURVES[i]}_").items():
        off = (at.imag - axis) * mu_theta - _theta(case, int(point), i)
        yield from unless(abs(off) < NEAR * mu_theta, f"{CURVES[i]} of point {point}")


def _level(points: tuple[complex, ...]) -> bool:
    return abs(points[0].imag - points[-1].imag) < NEAR < abs(points[0].real - points[-1].real)


def _active(case: GearCase, view: View) -> Faults:
    """The part between A1 and A2 is hatched, under both curves; both extremes of both wheels are printed there."""
    left, right = (view.point(end).real for end in ENDS)
    texts = [t.string for t in view.of("extreme")]
    for name in CURVES.values():
        strokes = view.inside("active", name)
        xs = [p.real for s in strokes for p in s.points]
        yield from unless(len(strokes) > 5, f"the active part of {name} is not hatched")
        yield from unless(min(xs) > left - NEAR and max(xs) < right + NEAR, f"{name} is hatched beyond A1A2")
        yield from unless(min(xs) < left + 4.0 and max(xs) > right - 4.0, f"{name} is hatched in part")
        for end in ENDS:
            exact = case.sizes[f"{name}_{end}"]
            said = f"θ_{{{name[-2:]}}}(A_{{{end[1]}}})"
            found = [text for text in texts if text.startswith(said)]
            good = len(found) == 1 and abs(number(found[0].split("= ")[1]) - exact) <= 0.00501
            yield from unless(good, f"{said} is {exact}, printed: {found}")


def z7_checks(case: GearCase, sheet: Sheet) -> Faults:
    """Every check has its number, its limit and the verdict; angles are in degrees; calculations come out again."""
    sizes, given = case.sizes, case.given
    table = rows(sheet["checks"])[1:]
    first, last = meshing_of(given).touching
    lacking = last - first < sizes["g_alpha"] * (1.0 - 1e-9)
    yield from unless(len(table) == 11 + lacking, f"there are {len(table)} checks")
    for row in table[:4]:
        yield from unless(row[2] == row[3] and abs(number(row[2]) - sizes["a_w"] * 1e3) < 0.000501, f"a_w: {row}")
    expected = [
        *((given[f"x_{i}"], sizes[f"x_min{i}"], 1.0, 1.0) for i in WHEELS),
        *((sizes[f"rho_l{i}"], sizes[f"rho_p{i}"], -1.0, 1e3) for i in WHEELS),
        (sizes["epsilon_alpha"], 1.2, 1.0, 1.0),
        *((((last - first) / sizes["p_b"], 1.2, 1.0, 1.0),) if lacking else ()),
        *((sizes[f"s_a{i}"], 0.3 * given["m"], 1.0, 1e3) for i in WHEELS),
    ]
    kept = {table[0][4]}
    for row, (value, limit, way, times) in zip(table[4:], expected, strict=True):
        good = all(
            abs(number(cell) - exact * times) <= last_digit(cell) + 1e-9
            for cell, exact in zip(row[2:4], (value, limit), strict=True)
        )
        yield from unless(good, f"{row} is {value}, {limit}")
        yield from unless((row[4] in kept) == (way * (value - limit) >= 0.0), f"the verdict of {row}")
        yield from unless(("≥" if way > 0 else "≤") in row[1], f"the condition of {row}")
    yield from unless(not any("°" in cell or "рад" in cell for row in table for cell in row), "angles among checks")
    yield from _calculations(sheet)


def _calculations(sheet: Sheet) -> Faults:
    count = 0
    for name in ("sizes", "auxiliary", "quality"):
        for found in calculations(sheet[f"equations_{name}"]):
            yield from unless("рад" not in found.result and "rad" not in found.result, f"{found} is in radians")
            if found.expression:
                count += 1
                off = abs(found.again - number(found.result))
                yield from unless(off <= last_digit(found.result) * (1.0 + 1e-9), f"{found} comes out {found.again}")
    yield from unless(count > 40, f"only {count} calculations have numbers")


SLIDING_POINTS: dict[str, Callable[[GearCase, Sheet], Faults]] = {"Z6": z6_sliding, "Z7": z7_checks}
