"""Points Z1 to Z7 of the examiner's list for sheets of gear pairs that were read back; sizes by the second route."""

import cmath
import math
import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np
import shapely

from kulman import sheet
from kulman.plans.gears.teeth import meshing_of
from kulman.scales.scale import SERIES
from kulman.tests.support.gears import madi, second_route
from kulman.tests.support.readback import Sheet, Stroke, Text, View, angle, cross, polygon, read, svgs
from kulman.tests.support.sheet_geometry import NEAR, unless
from kulman.variants.sheets import Sheet as Drawing

STEEP = 0.01  # degrees
Faults = Iterator[str]
CIRCLES = ("a", "w", "", "b", "f")
WHEELS = (1, 2)
NUMBER = r"[−-]?\d+(?:[.,]\d+)?"
LEVEL = 0.8  # mm by which baselines of one row may differ
FUNCTIONS = {"sin": "sin", "cos": "cos", "tg": "tan", "tan": "tan"}
TOOTH = 50.0  # mm
CURVES = {1: "theta_12", 2: "theta_21"}
ENDS = ("A1", "A2")


@dataclass(frozen=True)
class GearCase:
    """One pair as a task with changes, on a format, in a language."""

    changes: tuple[tuple[str, float], ...] = ()
    format: str = "A1"
    lang: str = "uk"
    rotation: str = "ccw"
    only: str | None = "meshing"

    def __str__(self) -> str:
        changed = ",".join(f"{name}={value}" for name, value in self.changes)
        return f"{self.format}-{self.lang}-{self.rotation}-{changed}"

    @cached_property
    def drawn(self) -> Drawing:
        changes = {**{name: repr(value) for name, value in self.changes}, "rotation": self.rotation}
        return sheet("madi-gear", set=changes, only=self.only, format=self.format, lang=self.lang)

    @cached_property
    def pages(self) -> tuple[str, ...]:
        return tuple(svgs(self.drawn))

    @cached_property
    def sheet(self) -> Sheet:
        return read(*self.pages)

    @cached_property
    def given(self) -> dict[str, float]:
        return madi(**dict(self.changes))

    @cached_property
    def sizes(self) -> dict[str, float]:
        """Quantities by the second route, SI."""
        found = second_route({name: np.array([value]) for name, value in self.given.items()})
        return {name: float(np.ravel(value)[0]) for name, value in found.items()}

    @property
    def side(self) -> int:
        """+1 when the pinion turns counter-clockwise: contacts go to the left."""
        return 1 if self.rotation == "ccw" else -1


def mu(view: View) -> float:
    """The printed scale factor, m a mm; it must be that of the printed ratio."""
    [(up, down)] = re.findall(r"[MМ] (\d+(?:[.,]\d+)?):(\d+)", heading(view))
    found = scale(view, "μ_{l}")
    assert abs(found - 1e-3 * number(down) / number(up)) < 1e-9, heading(view)
    return found


def printed(view: View, symbol: str) -> float:
    """The number printed after `symbol =`, as it stands; those of both wheels must agree."""
    sought = re.compile(rf"(?<!\w){re.escape(symbol)} ?= (-?\d+(?:[.,]\d+)?)")
    [found] = {number(text) for line in map(_line, view.texts) for text in sought.findall(line)}
    return found


def _line(text: Text) -> str:
    """A text as a line; the scripts of one that is turned are below."""
    if not text.turned:
        return text.string
    main = max(run.size for run in text.runs)
    return "".join(run.string if run.size > 0.9 * main else f"_{{{run.string}}}" for run in text.runs)


def arc_of(view: View, name: str) -> tuple[complex, float]:
    """Centre and radius of the arc of a circle."""
    arc, *_ = [s.arc for s in view.inside("circle", name) if s.arc is not None]  # it is broken at letters
    return arc[0], arc[1]


def tips(view: View, name: str) -> list[complex]:
    """Tips of the arrowheads of a dimension."""
    return [t.corners[0] for t in view.tips if ("dimension", name) in t.path]


def centres(view: View) -> tuple[complex, complex]:
    return view.point("O1"), view.point("O2")


def outline(view: View, name: str) -> list[complex]:
    """A drawn profile; one that letters break off is joined again."""
    return [point for line in view.lines("profile", name) for point in line.points]


def crossings(points: Sequence[complex], centre: complex, radius: float) -> list[complex]:
    """Where a broken line crosses a circle, one after the other."""
    found = []
    for a, b in pairwise(points):
        low, high = abs(a - centre) - radius, abs(b - centre) - radius
        if (low < 0.0) != (high < 0.0):
            found.append(a + (b - a) * (low / (low - high)))
    return found


def turned(centre: complex, a: complex, b: complex) -> float:
    """The angle from a to b about a centre, rad."""
    return cmath.phase((b - centre) / (a - centre))


def one(strokes: Sequence[Stroke]) -> tuple[complex, complex]:
    """The ends of the only line, whose pieces beside letters are in one line."""
    a, b = strokes[0].points[0], strokes[-1].points[-1]
    assert all(abs(cross(b - a, p - a)) < NEAR * abs(b - a) for stroke in strokes for p in stroke.points)
    return a, b


def number(text: str) -> float:
    """A printed number; the first one of a text."""
    if text == "−∞":
        return -math.inf
    found = re.search(NUMBER, text)
    assert found, text
    return float(found[0].replace("−", "-").replace(",", "."))


def last_digit(text: str) -> float:
    """Half of the last digit of a printed number."""
    found = re.search(NUMBER, text)
    assert found, text
    return 0.5 * 10.0 ** -len(re.split("[.,]", found[0])[1] if re.search("[.,]", found[0]) else "")


def rows(view: View) -> list[list[str]]:
    """The rows of a table from the top, each from the left; cells without text are left out."""
    levels: dict[float, list[tuple[float, str]]] = {}
    for text in view.of("cell"):
        at = next((level for level in levels if abs(level - text.baseline) < LEVEL), text.baseline)
        levels.setdefault(at, []).append((text.box[0], text.string))
    return [[string for _, string in sorted(levels[level])] for level in sorted(levels, reverse=True)]


def apart(points: Sequence[complex], place: complex) -> float:
    """How far a place is from a broken line."""
    line = shapely.LineString([(p.real, p.imag) for p in points])
    return float(line.distance(shapely.Point(place.real, place.imag)))


def near(off: float, what: str) -> Faults:
    """A fault unless a length is nothing, mm."""
    yield from unless(abs(off) < NEAR, f"{what}: {off} mm")


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
    for name, at, out in (("O1", below, below - above), ("O2", above, above - below)):
        yield from unless(abs(cross(axis[1] - axis[0], at - axis[0])) < NEAR * abs(axis[1] - axis[0]), "O off the axis")
        feet = [p - at for stroke in whole.inside("pivot", name) for p in stroke.points]
        yield from unless(sum((foot / out).real for foot in feet) > 0.0, f"the support of {name} is among the teeth")


def z2_circles(case: GearCase, sheet: Sheet) -> Faults:
    """Five circles a wheel about its centre, as large as they are printed, each with its own line; P is lettered."""
    for view in {v.name: v for v in (sheet["meshing"], detailed(sheet))}.values():
        pole = view.point("P")
        for i in WHEELS:
            about = [arc_of(view, f"d_{name}{i}")[0] for name in CIRCLES]
            for name, centre in zip(CIRCLES, about, strict=True):
                full, radius = f"d_{name}{i}", arc_of(view, f"d_{name}{i}")[1]
                yield from near(
                    2.0 * radius - case.sizes[full if name else f"d_{i}"] / mu(view),
                    f"{view.name}: {full} is too large",
                )
                yield from unless(abs(centre - about[0]) < NEAR, f"{view.name}: {full} has another centre")
                number = printed(sheet["meshing"], f"d_{{{name}{i}}}")
                yield from unless(abs(number - 2e3 * radius * mu(view)) < 0.00501, f"{full} is printed as {number}")
            (dashes,) = {(any(s.dashed for s in view.inside("circle", f"d_{name}{i}")),) for name in ("w", "", "b")}
            yield from unless(dashes == (True,), f"the circles of wheel {i} cannot be told apart")
            yield from near(abs(pole - about[0]) - arc_of(view, f"d_w{i}")[1], f"{view.name}: d_w{i} misses the pole")
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
        yield from near(
            abs(cross(along, centre - end)) - case.sizes[f"d_b{i}"] / 2 / mu(view), f"N1N2 passes the base circle {i}"
        )
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
    for i in WHEELS:
        yield from near(apart(outline(view, f"teeth_{i}"), view.point("P")), f"the flank of wheel {i} misses the pole")
    for i, mate in ((1, 2), (2, 1)):
        a, b = tips(view, f"gap_{i}")
        gap = case.given["c"] * case.given["m"] / mu(view)
        yield from unless(abs(abs(a - b) - gap) < NEAR, f"the gap at root {i} is {abs(a - b)} mm")
        for centre, radius in (arc_of(view, f"d_f{i}"), arc_of(view, f"d_a{mate}")):
            off = min(abs(abs(p - centre) - radius) for p in (a, b))
            yield from unless(off < NEAR, f"gap {i} is not from root to tip")


def _pitched(case: GearCase, view: View, i: int) -> Faults:
    """Teeth stand a pitch apart and are as thick as printed, measured on the reference circle."""
    centre, r = arc_of(view, f"d_{i}")
    cuts = crossings(outline(view, f"teeth_{i}"), centre, r)
    yield from unless(len(cuts) == 6, f"wheel {i} has {len(cuts) / 2} teeth")
    for k, (a, b) in enumerate(zip(cuts, cuts[2:], strict=False)):
        pitch = turned(centre, a, b) - math.tau / case.given[f"z_{i}"]
        yield from unless(abs(pitch) * r < NEAR, f"flank {k + 1} of wheel {i} is {pitch * r} mm off the pitch")
    thick = [abs(turned(centre, a, b)) * r for a, b in zip(cuts[::2], cuts[1::2], strict=True)]
    s_i = case.sizes[f"s_{i}"]
    wanted = {"s": s_i / mu(view), "e": (case.sizes["p"] - s_i) / mu(view)}
    for s in thick:
        yield from unless(abs(s - wanted["s"]) < NEAR, f"a tooth of wheel {i} is {s} mm thick")
    for letter, length in wanted.items():
        a, b = tips(view, f"{letter}_{i}")
        yield from unless(abs(abs(turned(centre, a, b)) * r - length) < NEAR, f"{letter}_{i} is dimensioned otherwise")
        said = printed(view, f"{letter}_{{{i}}}")
        yield from unless(abs(said - length * mu(view) * 1e3) < 0.00501, f"{letter}_{i} is printed as {said}")
        for tip in (a, b):
            far = min(abs(tip - cut) for cut in cuts)
            yield from unless(far < NEAR, f"{letter}_{i} ends {far} mm beside a flank")


def _involute(case: GearCase, view: View, i: int) -> Faults:
    """Normals of the flanks touch the base circle."""
    centre, base = arc_of(view, f"d_b{i}")
    tip = arc_of(view, f"d_a{i}")[1]
    low = math.hypot(case.sizes[f"d_b{i}"] / 2, max(case.sizes[f"rho_l{i}"], 0.0)) / mu(view)  # unless it is undercut
    worst, seen = 0.0, 0
    for a, b in pairwise(outline(view, f"teeth_{i}")):
        if min(abs(a - centre), abs(b - centre)) > low + NEAR and max(abs(a - centre), abs(b - centre)) < tip - NEAR:
            normal = (b - a) / abs(b - a) * 1j
            worst = max(worst, abs(abs(cross(normal, centre - 0.5 * (a + b))) - base))
            seen += 1
    yield from unless(seen > 60 and worst < NEAR, f"a normal of wheel {i} misses the base circle by {worst} mm")


def z5_active(case: GearCase, sheet: Sheet) -> Faults:
    """The active line, its lower points, engagement from start to end, both contact ratios, zones of contact."""
    view = detailed(sheet)
    first, last = one(view.lines("active", "A1A2"))
    g = case.sizes["g_alpha"]
    yield from unless(abs(abs(last - first) - g / mu(view)) < NEAR, f"A1A2 is {abs(last - first)} mm")
    for i, mate, end in ((1, 2, first), (2, 1, last)):
        centre, tip = arc_of(view, f"d_a{mate}")
        yield from near(abs(end - centre) - tip, f"A{i} is off the tip circle of its mate")
        low, own = view.point(f"L{i}"), arc_of(view, f"d_{i}")[0]
        yield from unless(abs(abs(low - own) - abs(end - own)) < NEAR, f"L{i} is not as far from O{i} as A{i}")
        yield from near(apart(outline(view, f"teeth_{i}"), low), f"L{i} is not on the flank")
        yield from unless(bool(view.inside("active", f"flank_{i}")), f"the active flank of wheel {i} is not marked")
        for end_name, at in (("start", first), ("end", last)):
            gap = apart(outline(view, f"{end_name}_{i}"), at)
            yield from near(gap, f"the tooth of wheel {i} misses the {end_name}")
    whole = sheet["meshing"]
    n, a = ([whole.point(f"{letter}{i}") for i in WHEELS] for letter in "NA")
    along = (n[1] - n[0]) / abs(n[1] - n[0])
    places = [((p - n[0]) * along.conjugate()).real for p in (*a, n[1])]
    yield from unless(0.0 < places[0] < places[1] < places[2], "A1, A2 are not between N1 and N2")
    yield from _ratios(case, sheet)
    yield from _zones(case, sheet["action"])


def _ratios(case: GearCase, sheet: Sheet) -> Iterator[str]:
    """The contact ratio by the drawn active line and by the drawn angles of action is the printed one."""
    view, epsilon = sheet["meshing"], case.sizes["epsilon_alpha"]
    words = [t.string for t in sheet["action"].texts if t.string.startswith("ε_{α} = ")]
    yield from unless(len(words) == 3, "the contact ratio is not printed three times")
    for text in words:
        yield from unless(abs(number(text.rpartition("= ")[2]) - epsilon) < 0.0006, f"printed is {text}")
    for i, centre in zip(WHEELS, centres(view), strict=True):
        ends = [point for s in view.lines("ray", f"phi_alpha{i}") for point in s.points]
        rays = {
            round(cmath.phase(p - centre), 6): p for p in sorted(ends, key=lambda p: abs(p - centre)) if p != centre
        }
        a, b = rays.values()  # of each ray the farthest place
        phi = abs(turned(centre, a, b))
        yield from unless(abs(math.degrees(phi) - printed(view, f"φ_{{α{i}}}")) < 0.006, f"phi_alpha{i} is {phi}")
        tau = math.radians(printed(view, f"τ_{{{i}}}"))
        yield from unless(abs(phi / tau - epsilon) < 0.002, f"phi/tau of wheel {i} is {phi / tau}")
        far = max(abs(a - centre), abs(b - centre))  # a letter may stand on the end of one of them
        yield from near(far - arc_of(view, f"d_w{i}")[1], f"the arc of action of wheel {i} is off its rolling circle")


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
            whole = min(min(x % pitch, pitch - x % pitch) for x in (edge, line - edge))
            yield from unless(whole < NEAR, f"zone {name} ends {whole} mm beside a change")
    a, b = tips(view, "p_b_1")
    yield from unless(abs(abs(a - b) - pitch) < NEAR, "p_b is dimensioned otherwise")


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
        yield from near(view.point(name) - first - sizes[rho] / mu, f"{name} is beside its place")
    yield from unless(abs((w - pole).real) < NEAR, "W is not over the pole")
    for i, foot in zip(WHEELS, (first, last), strict=True):
        ends = one(view.inside("curve", f"V_k{i}"))
        yield from unless(min(abs(end - foot) for end in ends) < NEAR, f"V_k{i} does not begin in N{i}")
        yield from near(
            ((ends[1] - ends[0]).conjugate() * (w - ends[0])).imag / abs(ends[1] - ends[0]), f"V_k{i} misses W"
        )
    a, b = tips(view, "PW")
    yield from unless(abs(abs(a - b) - abs(w - pole)) < NEAR, "PW is dimensioned otherwise")


def _table(case: GearCase, view: View, table: list[list[str]]) -> Faults:
    """The table has the ordinates that are drawn, steady ones, and sliding that comes out of them."""
    axis = view.point("N1").imag
    reduced = re.search(r"\d+:(\d+(?:[.,]\d+)?)", heading(view).split("μ")[0])
    times = number(reduced[1]) if reduced else 1.0
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
            for right in ((ys[0] - ys[1]) / ys[0], case.sizes[f"{CURVES[own + 1]}_{k:02d}"]):
                off = abs(right - number(cells[theta]))
                yield from unless(off <= last_digit(cells[theta]) + 1e-9, f"sliding of point {k} is {right}")
    yield from unless(all(b > a for a, b in pairwise(y[1])), "y_1 does not grow")
    yield from unless(all(b < a for a, b in pairwise(y[2])), "y_2 does not fall")


def _curve(case: GearCase, view: View, i: int) -> Faults:
    """A curve keeps its law, is 1 at the other wheel's N, 0 in the pole, and goes down to the stated value."""
    (line,) = view.inside("curve", CURVES[i])
    first, mu, mu_theta = view.point("N1"), scale(view, "μ_{ρ}"), scale(view, "μ_{θ}")
    ends_of = [(s.points[0], s.points[-1]) for s in view.lines("axis")]
    level = [a.imag for a, b in ends_of if abs(a.imag - b.imag) < NEAR < abs(a.real - b.real)]
    axis = next(y for y in level if y < first.imag - 1.0)
    whole, u = case.sizes["l_N1N2"], case.sizes["u"]
    for p in line.points:
        rho_1, theta = (p.real - first.real) * mu, (p.imag - axis) * mu_theta
        own, mate, ratio = (rho_1, whole - rho_1, u) if i == 1 else (whole - rho_1, rho_1, 1.0 / u)
        slope = whole * mu / (ratio * own**2) / mu_theta  # as a distance from the curve: it is steep near its own end
        yield from near(
            (theta - 1.0 + mate / (ratio * own)) / mu_theta / math.hypot(1.0, slope),
            f"{CURVES[i]} is beside its law at rho_1 = {rho_1}",
        )
    ends = sorted(line.points, key=lambda p: p.imag)
    yield from unless(abs((ends[-1].imag - axis) * mu_theta - 1.0) < NEAR * mu_theta, "the highest sliding is not 1")
    cut = number(heading(view).split("θ = ")[1])
    yield from unless(abs((ends[0].imag - axis) * mu_theta - cut) < NEAR * mu_theta, f"not cut off at {cut}")
    pole = min(line.points, key=lambda p: abs(p.imag - axis))
    yield from unless(abs(pole.real - view.point("P").real) < 2.0, "sliding is not 0 in the pole")
    for point, at in nodes(view, "node", f"{CURVES[i]}_").items():
        off = (at.imag - axis) * mu_theta - case.sizes[f"{CURVES[i]}_{point}"]
        yield from unless(abs(off) < NEAR * mu_theta, f"{CURVES[i]} of point {point}")


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
    yield from _laws_of_sliding(case, sheet)


def _calculations(sheet: Sheet) -> Faults:
    count = 0
    for name in ("sizes", "auxiliary", "quality"):
        for expression, result in calculations(sheet[f"equations_{name}"]):
            yield from unless("рад" not in result and "rad" not in result, f"{result} is in radians")
            if expression:
                count += 1
                again = evaluated(expression)
                good = abs(again - number(result)) <= last_digit(result) * (1.0 + 1e-9)
                yield from unless(good, f"{expression} = {result} comes out {again}")
    yield from unless(count > 40, f"only {count} calculations have numbers")


def _laws_of_sliding(case: GearCase, sheet: Sheet) -> Faults:
    """The laws of sliding are said with what they are at the ends of the active line, if both ends are there."""
    said = " ".join(text.string for text in sorted(sheet["equations_quality"].of("line"), key=lambda t: -t.baseline))
    for name in CURVES.values():
        ends = sorted(case.sizes[f"{name}_{end}"] for end in ENDS)
        found = re.search(rf"(\S+) ≤ θ_\{{{name[-2:]}\}} ≤ (\S+)", said)
        good = (found is None) == (ends[-1] > 1.0)  # where a point of contact would lie beyond its N
        for printed, end in zip(found.groups() if found else (), ends, strict=False):
            good &= printed == "−∞" if math.isinf(end) else abs(number(printed) - end) <= 0.00501
        yield from unless(good, f"{name} is within {ends}, printed: {found and found[0]}")


def calculations(view: View) -> Iterator[tuple[str, str]]:
    """Go through the calculations of a block of text, lines that are broken joined again: expression, result."""
    lines: list[str] = []
    for text in sorted(view.of("line"), key=lambda text: -text.baseline):
        if lines and text.string.strip().startswith("="):
            lines[-1] += " " + text.string.strip()
        else:
            lines.append(text.string.strip())
    for line in lines:
        parts = line.split(" = ")
        if re.match(NUMBER, parts[-1]):
            yield parts[-2] if len(parts) > 3 else "", parts[-1]


def evaluated(expression: str) -> float:
    """The value of a printed expression; angles in degrees."""
    text = expression.replace(",", ".").replace("−", "-").replace("π", "pi").replace("·", "*")
    text = re.sub(r"(\d)pi", r"\1*pi", text)

    def call(found: re.Match[str]) -> str:
        return f"{found[1]}({found[3].strip('()')})" + ("**2" if found[2] else "")

    def of_degrees(function: Callable[[float], float]) -> Callable[[float], float]:
        return lambda degrees: function(math.radians(degrees))

    known: dict[str, object] = {
        **{name: of_degrees(getattr(math, function)) for name, function in FUNCTIONS.items()},
        "inv": of_degrees(lambda angle: math.tan(angle) - angle),
        "arccos": lambda value: math.degrees(math.acos(value)),
    }
    text = re.sub(rf"({'|'.join(known)})(\^\{{2\}})? (\(.*?\)|[\d.]+°)", call, text)
    return float(eval(text.replace("°", ""), {"__builtins__": {}}, known | {"pi": math.pi}))


POINTS = {"Z1": z1_scale, "Z2": z2_circles, "Z3": z3_line_of_engagement, "Z4": z4_teeth, "Z5": z5_active}
SLIDING_POINTS = {"Z6": z6_sliding, "Z7": z7_checks}


def faults(case: GearCase, sheet: Sheet, point: str) -> list[str]:
    """What a point finds on a sheet; a judge that stumbles has found something, too."""
    try:
        return list((POINTS | SLIDING_POINTS)[point](case, sheet))
    except (AssertionError, ValueError, KeyError) as stumbled:
        return [repr(stumbled)]
