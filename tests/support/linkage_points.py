"""Points L1 to L13 of the examiner's list for any linkage, judged on a sheet that was read back against an oracle."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator
from itertools import pairwise

from kulman.plans.linkages.mechanism import FRAME, Driver, Prismatic, Revolute
from kulman.tests.sheets.judge import overlaps
from kulman.tests.support.linkage_cases import Linkage, Oracle
from kulman.tests.support.printed_numbers import equation_faults, lines_of, numbers_of, shows, table, table_faults
from kulman.tests.support.readback import Sheet, View, cross, parallel
from kulman.tests.support.sheet_cases import Case
from kulman.tests.support.sheet_geometry import NEAR, closed_chain, crosses, past, runs_along, same, unless

Faults = Iterator[str]
Judged = Linkage | Case


def mu_of(view: View, lang: str) -> float:
    """The scale factor that the heading of a view prints, per millimetre; Bertyaev has centimetres on both sides."""
    (found,) = [t.string for t in view.of("heading") if re.match(r"(μ|M)_\{", t.string) and "/" in t.string]
    number = numbers_of(found.partition("=")[2].partition(" (")[0], lang)[0]
    return number * 1e-3 if re.search(r"(cm|см)/(cm|см)$", found) else number


def l1_plan(case: Judged, sheet: Sheet) -> Faults:
    """Every lettered point stands in its place; links, points and the frame are lettered; supports are hatched."""
    view, oracle = sheet["position"], case.oracle
    mu, pivot = mu_of(view, case.lang), next(iter(oracle.still), None)
    origin = view.point(pivot) - oracle.place(pivot) / mu if pivot else None
    for name in sorted(oracle.points()):
        if view.has(name) and origin is not None:
            off = view.point(name) - origin - oracle.place(name) / mu
            yield from unless(abs(off) <= NEAR, f"{name} is {abs(off):.3f} mm out of its place")
    labels = [t.string for t in view.of("label")]
    for link in oracle.m.links:
        yield from unless(labels.count(str(link.number)) == 1, f"link {link.number} is numbered {labels}")
    yield from unless("0" in labels, "the frame has no number")
    for name in oracle.points():
        written = [x for x in labels if re.match(rf"^{name[0]}(_\{{[\d,]+\}}|\d*)?$", x)]
        yield from unless(bool(written), f"{name} is not lettered")
    for name in oracle.still:
        yield from unless(any(s.role == "hatch" for s in view.inside("pivot", name)), f"no hatching under {name}")
    for pair in oracle.m.pairs:
        if isinstance(pair, Prismatic) and FRAME in pair.links:
            strokes = [s for s in view.inside("guide") if s.role == "hatch"]
            yield from unless(len(strokes) > 3, "a guide of the frame is not hatched")
    yield from _guides(view)
    yield from _driver(case, view)


def _guides(view: View) -> Faults:
    """No link crosses the hatching of a guide of the frame."""
    links = [s.points for s in view.inside("link") if len(s.points) == 2]
    for hatch in (s.points for s in view.inside("guide") if s.role == "hatch"):
        for a, b in links:
            yield from unless(not crosses(hatch, (a, b)), f"a link crosses the hatching at {hatch[0]:.1f}")


def _driver(case: Judged, view: View) -> Faults:
    driver, oracle = case.oracle.m.driver, case.oracle
    if not isinstance(driver, Driver):
        return
    phi = math.degrees(oracle.values[driver.angle]) % 360
    printed = [numbers_of(t.string.partition("=")[2], case.lang) for t in view.of("label") if t.string.startswith("φ")]
    yield from unless(bool(printed) and abs(printed[0][0] - phi) < 1e-6, f"phi is printed as {printed}, it is {phi}")
    turning = view.turning(f"omega_{driver.link}")
    sense = math.copysign(1.0, oracle.rates(driver.link)[0])
    yield from unless(turning is not None and turning[1] == sense, "sense of omega_1")


def l2_structure(case: Judged, sheet: Sheet) -> Faults:
    """W with its numbers and the formula of structure are printed."""
    words = " ".join(lines_of(sheet["structure"]))
    n, p = len(case.oracle.m.links), len(case.oracle.m.pairs)
    yield from unless(f"3·{n} − 2·{p} − 0 = 1" in words, "W is not printed with its numbers")
    for group in case.solution.solved.structure.groups:
        formula = f"({', '.join(map(str, sorted(group.links)))})"
        yield from unless(formula in words or f"({', '.join(map(str, group.links))})" in words, f"no group {formula}")


def l3_to_l6_plans(case: Judged, sheet: Sheet) -> Faults:
    """Every vector of both plans is what the constraints say; marks stand at the ends of absolute vectors."""
    for plan in ("velocity", "acceleration"):
        for view in [v for v in sheet.views if v.name == plan]:
            yield from _vectors(case, view)
            yield from _meetings(view, plan)


def _vectors(case: Judged, view: View) -> Faults:
    for vector in view.vectors:
        wanted = case.oracle.vector(vector.quantity)
        if wanted is None:
            yield f"{view.name}: nobody knows {vector.quantity}"
            continue
        off = abs(vector.span - wanted / vector.mu)
        yield from unless(off <= NEAR, f"{view.name}: {vector.quantity} is {off:.3f} mm off")


def _meetings(view: View, plan: str) -> Faults:
    """Two construction lines, solid and thin, run past every point that they find by 3 mm or more."""
    ends: dict[str, list[tuple[complex, ...]]] = {}
    for line in view.lines("construction"):
        if re.fullmatch(rf"{plan}\.\w+_[12]", line.name):
            ends.setdefault(line.name[:-2], []).append(line.points)
            main = max(stroke.width for stroke in view.strokes)
            yield from unless(not line.dashed and line.width < main, f"{line.name} is not solid and thin")
    yield from unless(bool(ends), f"{plan}: no construction lines")
    for name, lines in ends.items():
        yield from unless(len(lines) == 2, f"{name} has {len(lines)} lines")
        if view.has(name):
            at = view.point(name)
            for a, b in lines:
                e = (b - a) / abs(b - a)
                reach = ((at - a) / e).real
                past = max(reach, abs(b - a) - reach)
                yield from unless(abs(((at - a) / e).imag) < NEAR and past >= 3.0, f"{name}: a line does not run past")


def l5_similarity(case: Judged, sheet: Sheet) -> Faults:
    """Of every triangle that similarity names all three sides are drawn: on both plans, and on the mechanism."""
    program = case.solution.solved.program
    made = {step.name: step for step in program}
    for step in program:
        if step.verb != "similar" or not any(view.name == step.plan for view in sheet.views):
            continue
        marks = *step.operands[:2], step.name
        yield from _sides(sheet[step.plan], marks)
        point = step.name.rpartition(".")[2]
        ends = [made[point].operands[i] if m.endswith(".p") else m.rpartition(".")[2] for i, m in enumerate(marks[:2])]
        yield from _sides(sheet["position"], (*ends, point))


def _sides(view: View, marks: tuple[str, ...]) -> Faults:
    lines = [s.points for s in view.strokes if len(s.points) == 2]
    lines += [(v.tail, v.tip) for v in view.vectors]
    rings = max((ring.radius for ring in view.rings), default=0.0)
    for i, first in enumerate(marks):
        for second in marks[:i]:
            a, b = view.point(second), view.point(first)
            if abs(b - a) > 2 * rings:  # the lines of links stop at the circles of their joints
                drawn = any(runs_along(line, a, b, rings) for line in lines)
                yield from unless(drawn, f"{view.name}: no side {second}-{first} of a similar triangle")


def l7_senses(case: Judged, sheet: Sheet) -> Faults:
    """Arcs of omega and epsilon turn as the constraints say."""
    view = sheet["position"]
    for link in case.oracle.m.links:
        for name, rate in zip(("omega", "epsilon"), case.oracle.rates(link.number), strict=True):
            turning = view.turning(f"{name}_{link.number}")
            if turning is not None:
                yield from unless(turning[1] == math.copysign(1.0, rate), f"sense of {name}_{link.number}")
                ends = [p for s in view.inside("link", str(link.number)) for p in s.points if len(s.points) == 2]
                ends += [view.point(point) for point in link.points if view.has(point)]
                about = any(same(turning[0], end, 0.02) for end in ends)
                yield from unless(about, f"{name}_{link.number} is not an arc about a point of its link")
                yield from _across_its_link(view, f"{name}_{link.number}", case.oracle.m.driver.link)


def _across_its_link(view: View, name: str, driver: int) -> Faults:
    """An arc of turning crosses its own link and no other; that of the driver may stand beside it."""
    number = name.rpartition("_")[2]
    (arc,) = [s for s in view.inside("arrow", name) if s.arc]
    lines = [(own, s) for s in view.strokes for kind, own in s.path if kind == "link"]
    crossed = {
        own
        for own, stroke in lines
        for side in pairwise(stroke.points)
        if any(crosses(piece, side) for piece in pairwise(arc.points))
    }
    yield from unless(crossed <= {number}, f"the arc of {name} crosses links {sorted(crossed - {number})}")
    if int(number) != driver and any(own == number and len(s.points) == 2 for own, s in lines):
        yield from unless(number in crossed, f"the arc of {name} is not at its link")


def l8_groups(case: Judged, sheet: Sheet) -> Faults:
    """Every group apart in its attitude; each arrow of a force points as the force does and passes its point."""
    for group in case.solution.solved.structure.groups:
        view = sheet[f"group_{group.name}"]
        yield from _to_scale(case, view)
        names = [arrow.name for arrow in view.arrows]
        yield from unless(len(names) == len(set(names)), f"{view.name}: forces drawn twice in {sorted(names)}")
        at = {load.name: load.link for load in case.oracle.m.loads}
        of_group = {x for x in case.oracle.solver.forces if at.get(x, int(re.sub(r"\D", "", x) or 0)) in group.links}
        acting = {x for x in of_group if abs(case.oracle.known[x]) > 1e-9 * _largest(case.oracle)}
        yield from unless(acting <= set(names), f"{view.name} lacks {sorted(acting - set(names))}")
        yield from _arrows(case, view, case.oracle)


def _to_scale(case: Judged, view: View) -> Faults:
    """What is drawn apart stands as in the mechanism, to the scale factor that its own heading prints."""
    mu = mu_of(view, case.lang)
    drawn = [name for name in sorted(case.oracle.points()) if view.has(name)]
    for a, b in pairwise(drawn):
        wanted = (case.oracle.place(b) - case.oracle.place(a)) / mu
        off = abs(view.point(b) - view.point(a) - wanted)
        yield from unless(off <= 0.02, f"{view.name}: {a}{b} is {off:.3f} mm off")


def _largest(oracle: Oracle) -> float:
    return max((abs(force) for force in oracle.solver.forces.values()), default=[0.0])[0]


def _arrows(case: Judged, view: View, oracle: Oracle) -> Faults:
    for arrow in view.arrows:
        wanted = oracle.known.get(arrow.name)
        if wanted is None or abs(wanted) < 1e-6 * _largest(oracle):
            continue
        yield from unless(parallel(arrow.unit, wanted, 0.05), f"{view.name}: {arrow.name} points elsewhere")
        at = _applied(oracle, arrow.name)
        if at and view.has(at):
            off = abs(cross(arrow.unit, view.point(at) - arrow.on))
            yield from unless(off < NEAR, f"{view.name}: {arrow.name} misses {at} by {off:.3f} mm")


def _applied(oracle: Oracle, name: str) -> str | None:
    """The point at which a force acts: of a load its own, of a reaction in a revolute pair the joint."""
    for load in oracle.m.loads:
        if load.name == name:
            return load.point
    found = re.fullmatch(r"(?:F_i|G_)(\d+)", name)
    if found:
        return oracle.m.link(int(found[1])).centre
    digits = re.fullmatch(r"R_(\d)(\d)", name)
    for pair in oracle.m.pairs if digits else ():
        if isinstance(pair, Revolute) and {*pair.links} == {int(digits[1]), int(digits[2])}:
            return pair.point
    return None


def l9_arms(case: Judged, sheet: Sheet) -> Faults:
    """Every arm is normal to the line of its force, is drawn from the centre of moments, and its mm are printed."""
    rows = [row for view in sheet.views if view.name.startswith("results_") for row in table(view)]
    for view in sheet.views:
        if not (view.name.startswith("group_") or view.name in ("driver", "lever")):
            continue
        texts = [t.string for place in ("label", "heading") for t in view.of(place)]
        printed = [x for t in texts for part in t.split("=")[1:] for x in numbers_of(part, case.lang)]
        letters = {letter for t in texts if "," not in t for letter in t.split(" = ")}  # their mm stand in a table
        beside = (cell for row in rows for letter, cell in pairwise(row) if letter in letters)
        printed += [x for cell in beside for x in numbers_of(cell, case.lang)[:1]]
        pieces: dict[str, list[complex]] = {}  # of lines with their letters between
        for line in view.strokes:
            if any(kind == "arm" for kind, _ in line.path) and line.role == "thin":
                pieces.setdefault(str(line.path[-1]), []).extend(line.points)
        for arm, points in pieces.items():
            a, b = points[0], points[-1]
            straight = all(abs(cross((b - a) / abs(b - a), x - a)) < NEAR for x in points)
            yield from unless(straight, f"{view.name}: the arm {arm} is in pieces that are no line")
            yield from unless(_begins(view, a), f"{view.name}: the arm {arm} begins nowhere")
            normal = [x for x in view.arrows if abs(cross(x.unit, b - x.on)) < NEAR]
            square = [x for x in normal if abs((x.unit.conjugate() * (b - a)).real) < NEAR * max(1.0, abs(b - a))]
            yield from unless(bool(square), f"{view.name}: the arm {arm} is not normal to a force")
            yield from unless(
                any(shows(x, abs(b - a), NEAR) for x in printed), f"{view.name}: {abs(b - a):.2f} mm is not printed"
            )


def _begins(view: View, at: complex) -> bool:
    """Whether an arm may begin there: in a circle, or, as a dimension, on a line that extends one."""
    centres = [ring.centre for ring in view.rings]
    extended = (s.points for s in view.lines("extension") if any(same(s.points[0], c) for c in centres))
    return any(same(at, c) for c in centres) or any(past(ends, at, 0.0) for ends in extended)


def l10_force_plans(case: Judged, sheet: Sheet) -> Faults:
    """Every force plan closes, and its vectors are what the balance of all links says."""
    groups = {g.name: g for g in case.solution.solved.structure.groups}
    for view in sheet.views:
        if not view.name.startswith("forces_"):
            continue
        names = {vector.quantity for vector in view.vectors}
        parted = {name.removesuffix("_n") for name in names if name.endswith("_n")}
        group = groups.get(view.name.removeprefix("forces_"))
        inner = {f"R_{i}{j}" for i in group.links for j in group.links} if group else set()
        across = {name for name in names if name.endswith("_m")}  # it finds the reaction, and is no side of the plan
        beside = parted | inner | across
        sides = [v for v in view.vectors if v.quantity not in beside]
        whole = sum(v.span for v in sides)
        yield from unless(abs(whole) < 0.02, f"{view.name} is open by {abs(whole):.3f} mm: {sorted(names)}")
        yield from unless(abs(whole) > 0.02 or closed_chain(sides) is not None, f"{view.name}: not tip to tail")
        for vector in view.vectors:
            wanted = case.oracle.known.get(vector.quantity)
            if wanted is not None:
                off = abs(vector.span - wanted / vector.mu)
                yield from unless(off <= NEAR, f"{view.name}: {vector.quantity} is {off:.3f} mm off")


def l11_driver(case: Judged, sheet: Sheet) -> Faults:
    """The driver is drawn to its printed scale factor; the arrows on it are those of the balance."""
    yield from _to_scale(case, sheet["driver"])
    yield from _arrows(case, sheet["driver"], case.oracle)


def l12_lever(case: Judged, sheet: Sheet) -> Faults:
    """The velocity plan turned; forces unturned at their images; the sum of F h with signs is zero."""
    view = sheet["lever"]
    p, numbers = view.point("lever.p"), case.solution
    mu = mu_of(view, case.lang)
    for name in case.oracle.points():
        if view.has(f"lever.{name}"):
            turned = case.oracle.moves(name)[0] * 1j / mu
            yield from unless(same(view.point(f"lever.{name}") - p, turned), f"lever: {name} is not turned by 90°")
    yield from _whole_plan(case, sheet, view, mu)
    for one in dict.fromkeys(x.name.rpartition("_")[0] for x in view.arrows if "_couple_" in x.name):
        ends = [x.unit for x in view.arrows if x.name.startswith(f"{one}_")]
        yield from unless(len(ends) == 2 and same(ends[0], -ends[1]), f"lever: {one} is no pair of opposite forces")
    for _, _, arm, mm, *_ in table(sheet["results_lever"]) if "results_lever" in sheet.names else []:
        ends = [f"lever.{letter if letter == 'p' else letter.upper()}" for letter in arm]
        if len(ends) == 2 and all(view.has(end) for end in ends):  # an arm that is a line of the plan itself
            long = abs(view.point(ends[1]) - view.point(ends[0]))
            yield from unless(
                shows(numbers_of(mm, case.lang)[0], long, NEAR), f"lever: {arm} is {long:.2f} mm, not {mm}"
            )
    total, largest = 0.0, 0.0
    for arrow in view.arrows:
        wanted = case.oracle.known.get(arrow.name)
        if wanted is not None and abs(wanted) > 1e-6 * _largest(case.oracle):
            yield from unless(parallel(arrow.unit, wanted, 0.05), f"lever: {arrow.name} is turned")
        name = arrow.name.lstrip("_")
        size = abs(numbers.solved.values.get(arrow.name, numbers.solved.values.get(name, 0.0)))
        moment = size * cross(arrow.on - p, arrow.unit)
        total, largest = total + moment, max(largest, abs(moment))
    hung = {f"_M_{arrow.name}_p" for arrow in view.arrows}  # moments of what hangs there as an arrow
    for name, value in numbers.solved.values.items():
        if re.fullmatch(r"_M_?\w+_p", name) and isinstance(value, float) and name not in hung:
            total, largest = total + value / mu, max(largest, abs(value / mu))
    yield from unless(abs(total) <= 1e-3 * largest, f"lever: the sum of moments is {total}, the largest {largest}")


def _whole_plan(case: Judged, sheet: Sheet, lever: View, mu: float) -> Faults:
    """Every vector of the velocity plan has its line on the lever: main between joints, thin to other points."""
    pairs = case.solution.solved.mechanism.pairs
    pins = {f"lever.{pair.point}{n}" for pair in pairs for n in ("", *pair.links)} | {"lever.p"}
    for plan in [v for v in sheet.views if v.name == "velocity"]:
        p, q, lines = plan.point("velocity.p"), lever.point("lever.p"), lever.lines("lever")
        joints, main = [lever.point(pin) for pin in pins if lever.has(pin)], max(s.width for s in lines)
        for line in lines:
            ends = [any(same(end, joint) for joint in joints) for end in (line.points[0], line.points[-1])]
            yield from unless(all(ends) == (line.width == main), f"lever: the weight of {line.name}")
        for vector in plan.vectors:
            ends = [q + (end - p) * 1j * vector.mu / mu for end in (vector.tail, vector.tip)]
            found = any(same(ends[0], s.points[i]) and same(ends[1], s.points[1 - i]) for s in lines for i in (0, 1))
            yield from unless(found or abs(ends[1] - ends[0]) < 0.1, f"lever: no line of {vector.quantity}")


def l13_numbers(case: Judged, sheet: Sheet) -> Faults:
    """Printed calculations recompute; mm times mu is the printed value; every vector has the value of solve."""
    yield from equation_faults(sheet)[1]
    yield from table_faults(sheet, case.lang, {})
    for vector in sheet.vectors:
        expected = abs(case.solution.solved.values.get(vector.quantity, vector.value))
        close = abs(vector.value - expected) <= 1e-12 * expected
        yield from unless(close, f"data-value of {vector.quantity} is {vector.value}, not {expected}")
        off = abs(abs(vector.span) - vector.value / vector.mu)
        yield from unless(off <= NEAR, f"{vector.quantity}: {abs(vector.span)} mm are not {vector.value}")


def underlines(case: Judged, sheet: Sheet) -> Faults:
    """Vector equations underline the known and leave at most two unknowns."""
    for view in sheet.views:
        for text in view.of("line"):
            under = [(a, b) for a, b in text.rules if a.imag < text.baseline]
            if not under:
                continue
            spans = {(round(a.real, 2), round(b.real, 2)) for a, b in under}
            lines = [sum((round(a.real, 2), round(b.real, 2)) == span for a, b in under) for span in spans]
            yield from unless(set(lines) <= {1, 2}, f"underlines of {text.string}")
            single = sum(count == 1 for count in lines)
            yield from unless(single <= 2 * max(1, text.string.count("=")), f"too many unknowns: {text.string}")


JUDGES: tuple[Callable[[Judged, Sheet], Faults], ...] = (
    l1_plan,
    l2_structure,
    l3_to_l6_plans,
    l5_similarity,
    l7_senses,
    l8_groups,
    l9_arms,
    l10_force_plans,
    l11_driver,
    l12_lever,
    l13_numbers,
    underlines,
)


def linkage_faults(case: Judged) -> list[str]:
    """All faults of a sheet."""
    sheet = case.sheet
    has_forces, has_lever = any(v.name == "driver" for v in sheet.views), any(v.name == "lever" for v in sheet.views)
    judges = [j for j in JUDGES if has_forces or j not in (l8_groups, l10_force_plans, l11_driver)]
    judges = [j for j in judges if has_lever or j is not l12_lever]
    faults = [f"{case} {judge.__name__}: {fault}" for judge in judges for fault in judge(case, sheet)]
    return [*faults, *(f"{case}: {fault}" for fault in overlaps(sheet))]
