"""What the examiner's list wants of a slider-crank beyond any linkage; each judge yields the faults of a sheet."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator

from kulman.tests.sheets.judge import overlaps
from kulman.tests.support import linkage_points
from kulman.tests.support.printed_numbers import half_digit, lines_of, numbers_of, shows, table
from kulman.tests.support.readback import Arrow, Sheet, Stroke, View, angle, cross, parallel
from kulman.tests.support.sheet_cases import Case
from kulman.tests.support.sheet_geometry import NEAR, along, on, past, same, unless

Faults = Iterator[str]
SENSE = {"uk": ("проти годинникової", "за годинниковою"), "ru": ("против часовой", "по часовой")}
ON_LEVER = {"F_{i2}": "F_i2", "F_{i3}": "F_i3", "F_{3}": "F_3", "F′_{i2}": "F_i2_couple_B", "F″_{i2}": "F_i2_couple_A"}
WRITTEN = 1.5e-6  # mm, to which places stand in a file
REACTIONS = ("R_12_n", "R_12_t", "R_03")
ARMS = {"F_i2": "h_{Fi2}", "F_i3": "h_{Fi3}", "F_3": "h_{F3}", "F_i2_couple_B": "h′_{i2}", "F_i2_couple_A": "h″_{i2}"}
SENSE["en"] = ("counter-clockwise", "clockwise")


def l1_letters_and_supports(case: Case, sheet: Sheet) -> Faults:
    """O is the origin of the table; phi, numbers and letters once; lines stop at circles; hatching on one side."""
    view = sheet["position"]
    (mu,) = numbers_of(_heading(view, "μ_{l}"), case.lang)
    o = view.point("O")
    for name, place in case.places.items():
        yield from unless(same(view.point(name) - o, place / mu), f"{name} is not in its place")
    labels = [t.string for t in view.of("label")]
    for letter in ("O", "A", "B", "S_{2}", "0", "1", "2", "3"):
        yield from unless(labels.count(letter) == 1, f"{letter} is lettered {labels.count(letter)} times")
    for line in (*view.inside("link", "1"), *view.inside("link", "2")):
        for end in line.points:
            rim = min(abs(abs(end - r.centre) - r.radius) for r in view.rings if r.path and r.path[-1][0] != "centre")
            yield from unless(rim < NEAR, f"link line ends {rim:.3f} mm off a circle")
    strokes = [s for s in view.inside("guide") if s.role == "hatch"]
    (rail,) = [s for s in view.inside("guide") if s.role == "main"]
    sides = {cross(rail.points[1] - rail.points[0], s.points[1] - rail.points[0]) > 0 for s in strokes}
    yield from unless(len(strokes) > 3 and len(sides) == 1, "the guide is not hatched on one side")
    yield from _angle(case, view, o)
    turning = view.turning("omega_1")
    yield from unless(turning is not None and same(turning[0], o, 0.02), "omega_1 does not turn about O")


def _angle(case: Case, view: View, o: complex) -> Faults:
    phi = math.degrees(case.given("phi")) % 360
    (text,) = [t.string for t in view.of("label") if t.string.startswith("φ")]
    yield from unless(abs(numbers_of(text, case.lang)[0] - phi) < 1e-6, f"phi is printed as {text}")
    arcs = [s for s in view.inside("dimension", "phi") if s.arc and s.role != "tail"]
    if phi > 5:
        (arc,) = arcs
        assert arc.arc is not None
        # a half circle is read from its ends with less precision
        near = NEAR if phi < 170 else 0.1
        yield from unless(abs(math.degrees(arc.arc[2]) - phi) < near, f"the arc of phi is {arc.arc[2]}")
        yield from unless(abs(angle(1, arc.points[0] - o)) < NEAR, "phi is not measured from the axis x")


def l2_construction_and_structure(case: Case, sheet: Sheet) -> Faults:
    """The compass arc about A crosses the guide at B; W, the group and the formula stand in words."""
    view = sheet["position"]
    (arc,) = view.lines("construction", "arc_B")
    a, b = view.point("A"), view.point("B")
    assert arc.arc is not None
    yield from unless(same(arc.arc[0], a, 0.02), "the compass arc is not about A")
    yield from unless(abs(arc.arc[1] - abs(b - a)) < NEAR, "the compass arc has another radius")
    yield from unless((arc.points[0] - b).imag * (arc.points[-1] - b).imag < 0, "the arc does not cross the guide")
    yield from unless(arc.width == min(s.width for s in view.strokes if s.width), "the arc is not thin")
    words = " ".join(t.string for t in sheet["structure"].of("line"))
    for text in ("W = 3n − 2p_{1} − p_{2} = 3·3 − 2·4 − 0 = 1", "II_{2}(2, 3)", "I(0, 1)"):
        yield from unless(text in words, f"the structure does not say {text}")


def l3_to_l6_ends(case: Case, sheet: Sheet) -> Faults:
    """Vectors of both plans run between the points that name them; a^n, a^t follow one another; small ones are said."""
    for plan, symbol in (("velocity", "V"), ("acceleration", "a")):
        view = sheet[plan]
        for name, tail, tip in (("A", "p", "A"), ("B", "p", "B"), ("S2", "p", "S2"), ("BA", "A", "B")):
            vector = view.vector(f"{symbol}_{name}")
            ends = same(vector.tail, view.point(f"{plan}.{tail}")) and same(vector.tip, view.point(f"{plan}.{tip}"))
            yield from unless(ends, f"{vector.quantity} does not run from {tail} to {tip}")
    view, notes = sheet["acceleration"], " ".join(t.string for t in sheet["acceleration"].of("heading"))
    n, t = view.vector("a_BA_n"), view.vector("a_BA_t")
    yield from unless(same(n.tail, view.vector("a_A").tip) and same(t.tail, n.tip), "a', n, b' do not follow")
    yield from unless(same(t.tip, view.point("acceleration.B")), "a^t does not end at b'")
    for vector in view.vectors:
        small = abs(vector.span) < 2.0
        yield from unless(not small or symbol_of(vector.quantity) in notes, f"{vector.quantity} is small but not said")


def symbol_of(name: str) -> str:
    """The symbol of a quantity: its name with scripts, a Greek letter for a turning."""
    letter, _, rest = name.partition("_")
    stem, _, part = rest.partition("_")
    letter = {"omega": "ω", "epsilon": "ε"}.get(letter, letter)
    return f"{letter}^{{{part}}}_{{{stem}}}" if part else f"{letter}_{{{stem}}}"


def l7_carried_vectors(case: Case, sheet: Sheet) -> Faults:
    """Arcs of omega_2, epsilon_2 turn as V_BA, a^t_BA turn B about A; speeds up or slows down accordingly."""
    view = sheet["position"]
    a, b = view.point("A"), view.point("B")
    found: list[float] = []
    for plan, vector, arc in (("velocity", "V_BA", "omega_2"), ("acceleration", "a_BA_t", "epsilon_2")):
        carried = sheet[plan].vector(vector)
        turning = view.turning(arc)
        if abs(carried.span) < 1e-4:
            # beside a special position it may be shorter than the file has decimals
            there = turning is None or abs(carried.span) > 0 or (case.phi or 0.0) % 90.0 != 0.0
            yield from unless(there, f"an arrow for a zero {arc}")
            continue
        arrow = view.arrow(vector)
        about = turning is not None and any(same(turning[0], joint, 0.02) for joint in (a, b))
        yield from unless(about, f"{arc} is not an arc about a joint of link 2")
        near = 0.05 + math.degrees(WRITTEN / abs(carried.span))  # of a vector of a micrometre little is written
        yield from unless(parallel(arrow.tip - arrow.on, carried.span, near), f"{vector} at B is not parallel")
        yield from unless(same(arrow.tail, b), f"{vector} is not carried to B")
        sense = math.copysign(1.0, cross(b - a, carried.span))
        yield from unless(turning is not None and turning[1] == sense, f"{arc} turns against {vector}")
        found.append(sense)
    if len(found) == 2:
        words = " ".join(t.string for t in sheet["equations_kinematics"].of("line"))
        up, down = {"uk": ("прискорено", "сповільнено"), "ru": ("ускоренно", "замедленно")}.get(
            case.lang, ("speeds up", "slows down")
        )
        wanted, other = (up, down) if found[0] == found[1] else (down, up)
        yield from unless(wanted in words and other not in words, f"the sheet does not say {wanted}")


def l8_group_apart(case: Case, sheet: Sheet) -> Faults:
    """The group without the crank, with all its forces, each once; it is said how forces are drawn."""
    view, plan = sheet["group_23"], sheet["acceleration"]
    a, b = view.point("A"), view.point("B")
    yield from unless(not view.inside("link", "1") and not view.has("O"), "the crank is drawn")
    yield from unless(bool(view.of("heading")[0].string), "no words about the scale of forces")
    present = {name for name, of in (("F_i3", "a_B"), ("F_i2", "a_S2")) if abs(plan.vector(of).span) > 1e-3}
    present |= {"F_3", *(name for name in REACTIONS if abs(sheet["forces_23"].vector(name).span) > 1e-3)}
    drawn = [arrow.name for arrow in view.arrows]
    fits = len(drawn) == len(set(drawn)) and present <= set(drawn) <= {"F_3", "F_i3", "F_i2", *REACTIONS}
    yield from unless(fits, f"forces drawn {sorted(drawn)}, acting {sorted(present)}")
    for arrow in view.arrows:
        side = sheet["forces_23"].vector(arrow.name)
        yield from unless(abs(cross(arrow.unit, side.span)) < 0.02, f"{arrow.name} is not parallel to its side")
        at = {"F_i2": view.point("S2"), "R_12_n": a, "R_12_t": a}.get(arrow.name, b)
        yield from unless(abs(cross(arrow.unit, at - arrow.on)) < NEAR, f"{arrow.name} misses its point")
    for name, line in zip(REACTIONS, ((b - a) / abs(b - a), (b - a) / abs(b - a) * 1j, 1j), strict=True):
        across = abs(cross(sheet["forces_23"].vector(name).span, line))
        yield from unless(across < NEAR, f"{name} has another line")
    rate, turning = plan.vector("a_BA_t").span, view.turning("M_i2")
    if abs(rate) > 1e-4:
        against = -math.copysign(1.0, cross(b - a, rate))
        yield from unless(turning is not None and turning[1] == against, "M_i2 does not oppose epsilon_2")


def l9_arms(case: Case, sheet: Sheet) -> Faults:
    """Arms h_2 about B and h_21 about O have right-angle marks and end on the lines of their forces."""
    for name, arm, force, about in (("group_23", "h_2", "F_i2", "B"), ("driver", "h_21", "R_21", "O")):
        view = sheet[name]
        arrow, centre = view.arrow(force), view.point(about)
        foot = arrow.on + arrow.unit * ((centre - arrow.on) / arrow.unit).real
        reach = abs(foot - centre)
        lines = [s for s in view.strokes if any(k == "arm" for k, _ in s.path) and s.role == "thin"]
        extended = [s for s in view.lines("extension") if s.name.startswith("h_")]
        starts = [centre, *(a for s in extended for a in _on(s.points, centre, arrow.unit, lines))]
        drawn = [s for s in lines for a in starts if same(s.points[0], a) and same(s.points[1], foot + a - centre)]
        yield from unless(reach < 0.05 or bool(drawn), f"{arm} is not the perpendicular to the line of {force}")
        foot = drawn[0].points[1] if drawn else foot
        marks = [m for m in view.lines("right-angle") if any(same(p, foot, 3.0) for p in m.points)]
        yield from unless(reach < 4.0 or bool(marks), f"{arm} has no right-angle mark")
        extension = [s.points for s in view.lines("line-of-action")]
        ends = any(on(points, foot) and past(points, foot, 1.0) for points in extension)
        yield from unless(reach < 0.05 or ends, f"{arm} ends in air")


def l10_force_plan(case: Case, sheet: Sheet) -> Faults:
    """Each load once; the unknowns adjacent, found by construction lines; R_12 their chord; R_32 on a plan."""
    view = sheet["forces_23"]
    names = sorted(v.quantity for v in view.vectors)
    yield from unless(names == sorted([*REACTIONS, "F_i3", "F_3", "F_i2", "R_12"]), f"the plan has {names}")
    n, t, r, full = (view.vector(name) for name in (*REACTIONS, "R_12"))
    yield from unless(same(n.tail, r.tip), "the unknowns do not meet")
    yield from unless(same(n.tip, t.tail), "R^n is not followed by R^t")
    yield from unless(same(full.tail, n.tail) and same(full.tip, t.tip), "R_12 is not the chord of its parts")
    closing = {vector.quantity for vector in sheet["forces_2"].vectors}
    yield from unless({"R_12", "F_i2", "R_32"} <= closing, "no plan of link 2")
    lines = view.lines("construction")
    for vector in (n, r):
        good = [s for s in lines if on(s.points, n.tail) and along(s.points, vector.span) and past(s.points, n.tail, 3)]
        yield from unless(abs(vector.span) < 0.1 or bool(good), f"no construction line of {vector.quantity}")


def l11_driver(case: Case, sheet: Sheet) -> Faults:
    """R_21 opposes R_12 at A, R_01 at O; R_21 h_21 mu_l is the printed M_bal, which opposes its turning."""
    view, plan = sheet["driver"], sheet["forces_1"]
    r12, r21 = sheet["forces_23"].vector("R_12"), plan.vector("R_21")
    yield from unless(parallel(r21.span, -r12.span), "R_21 is not opposite to R_12")
    yield from unless(abs(abs(r21.span) * r21.mu - abs(r12.span) * r12.mu) < 1e-4 * r21.mu, "R_21 has another size")
    arrow, o = view.arrow("R_21"), view.point("O")
    # the driver may be drawn larger than the mechanism, to a scale factor of its own
    (mu,) = numbers_of(_heading(view, "μ_{l}") or _heading(view, "μ_{l1}"), case.lang)
    moment = cross(arrow.on - o, arrow.unit) * mu * abs(r21.span) * r21.mu
    a = view.point("A")
    reaches = {0.0, *(ring.radius for ring in view.rings if same(ring.centre, a))}  # it may end at the circle of A
    ends = [abs(end - a) for end in (arrow.tail, arrow.tip)]
    at_a = any(abs(end - reach) < NEAR for end in ends for reach in reaches)
    yield from unless(at_a, "R_21 is not at A")
    reaction = view.arrow("R_01")
    yield from unless(
        parallel(reaction.unit, -arrow.unit) and abs(cross(reaction.unit, o - reaction.on)) < NEAR, "R_01"
    )
    turning = view.turning("M_bal")
    rows = {row[0]: row for row in table(sheet["results_forces"])}
    (printed,) = [row for name, row in rows.items() if name.startswith("M_{") and name not in ("M_{i2}", "M_{03}")]
    (value,) = numbers_of(printed[3], case.lang)
    # what is printed of the reaction and of its arm, which near a dead position is less than a hundredth of a mm
    size, force = abs(r21.span) * r21.mu, next(row[3] for name, row in rows.items() if name == "R_{21}")
    read = abs(moment) * (1e-3 + half_digit(force) / max(size, half_digit(force))) + 5e-4 + 0.005 * mu * size
    yield from unless(abs(abs(value) - abs(moment)) <= read, f"M_bal {value}, measured {moment}")
    if abs(cross(arrow.on - o, arrow.unit)) > 0.01:
        against = -math.copysign(1.0, moment)
        yield from unless(turning is not None and turning[1] == against, "M_bal does not oppose R_21")
        words = " ".join(t.string for t in sheet["equations_forces"].of("line"))
        ccw, cw = SENSE[case.lang]
        yield from unless((ccw if against > 0 else cw) in words, "the sense of M_bal is not said")


def l12_lever(case: Case, sheet: Sheet) -> Faults:
    """Forces at their images, and no reaction; couples; arms; signs of the printed sum; it is said which way."""
    view, group = sheet["lever"], sheet["group_23"]
    p = view.point("lever.p")
    notes = " ".join(t.string for t in view.of("heading"))
    yield from unless("90°" in notes and SENSE[case.lang][0].split()[-1] in notes, "it is not said which way")
    couple = sheet["position"].point("B") - sheet["position"].point("A")
    wanted = {"F_i2": "S2", "F_i3": "B", "F_3": "B", "F_i2_couple_B": "B", "F_i2_couple_A": "A", "_F_bal": "A"}
    yield from unless({a.name for a in view.arrows} <= set(wanted), "a reaction hangs on the lever")
    for arrow in view.arrows:
        at = view.point(f"lever.{wanted[arrow.name]}")
        yield from unless(abs(cross(arrow.unit, at - arrow.on)) < NEAR, f"{arrow.name} does not hang at its image")
        if arrow.name in ("F_i2", "F_i3", "F_3"):
            yield from unless(parallel(arrow.unit, group.arrow(arrow.name).unit), f"{arrow.name} is turned")
        if "couple" in arrow.name:
            yield from unless(abs((arrow.unit.conjugate() * couple).real) < NEAR, f"{arrow.name} is not normal to AB")
    ends = [a for a in view.arrows if "couple" in a.name]
    moment = group.turning("M_i2")
    if ends:
        first, second = sorted(ends, key=lambda a: a.name)
        yield from unless(parallel(first.unit, -second.unit), "the couple is not a pair")
        sense = math.copysign(1.0, cross(couple, second.unit))
        yield from unless(moment is not None and sense == moment[1], "the couple turns against M_i2")
    for arrow in view.arrows:
        if arrow.name != "_F_bal":
            yield from _lever_arm(case, sheet, arrow, p)
    own = [part for part in _written(view) if part.strip().startswith("pa =")]
    printed = [h for part in own for h in numbers_of(part, case.lang)]
    drawn = any(shows(h, abs(view.point("lever.A") - p), NEAR) for h in printed)
    yield from unless(drawn, "the arm pa of the balancing force is not printed as it is drawn")
    yield from _lever_sum(case, sheet, view, p)


def _lever_arm(case: Case, sheet: Sheet, arrow: Arrow, p: complex) -> Faults:
    """An arm runs from p, or, as a dimension, from a line that extends p along the force; its mm are in the table.

    Its letter stands on the lever, with these mm where there are few arms.
    """
    view = sheet["lever"]
    foot = arrow.on + arrow.unit * ((p - arrow.on) / arrow.unit).real
    if abs(foot - p) < 0.05:
        return
    arms = [s for s in view.strokes if any(k == "arm" for k, _ in s.path) and s.role == "thin"]
    starts = [p, *(a for s in view.lines("extension") for a in _on(s.points, p, arrow.unit, arms))]
    drawn = [s for s in arms for a in starts if same(s.points[0], a) and same(s.points[1], foot + a - p)]
    yield from unless(bool(drawn), f"{arrow.name} has no arm")
    own = [part for part in _written(view) if ARMS[arrow.name] in part]
    yield from unless(bool(own), f"the arm of {arrow.name} has no letter")
    rows = [row[3] for row in table(sheet["results_lever"]) if row[2] == ARMS[arrow.name]]
    said = [part.rpartition("=")[2] for part in own if "=" in part and part.rpartition("=")[2].strip()[:1].isdigit()]
    printed = [h for part in (*rows, *said) for h in numbers_of(part, case.lang)[:1]]
    right = [shows(h, abs(foot - p), NEAR) for h in printed]
    yield from unless(bool(rows) and all(right), f"the mm of {arrow.name} are not printed")


def _written(view: View) -> list[str]:
    """What letters and notes of a view say, each by itself."""
    return [part for place in ("label", "heading") for t in view.of(place) for part in t.string.split(";")]


def _on(extension: tuple[complex, ...], p: complex, along: complex, arms: list[Stroke]) -> Iterator[complex]:
    """Beginnings of arms on a line that extends p along a force."""
    start, end = extension
    if same(start, p) and abs(cross(along, end - start)) < NEAR:
        begun = (s.points[0] for s in arms)
        yield from (a for a in begun if abs(cross(along, a - p)) < NEAR and 0 < abs(a - p) < abs(end - start))


def _lever_sum(case: Case, sheet: Sheet, view: View, p: complex) -> Faults:
    """The signs of the printed sum are those of the moments as drawn, and F h with these signs adds up to zero."""
    signs = {a.name: math.copysign(1.0, cross(a.on - p, a.unit)) for a in view.arrows}
    sizes = {a.name: abs(cross(a.on - p, a.unit)) for a in view.arrows}
    (line,) = [t for t in lines_of(sheet["equations_lever"]) if t.startswith("ΣM")]
    terms = line.partition("0:")[2].rpartition("=")[0].replace("− ", "−").replace("+ ", "+").split()
    printed = {ON_LEVER.get(t.lstrip("+−").partition("·")[0], "_F_bal"): -1.0 if t[0] == "−" else 1.0 for t in terms}
    present = {name for name, size in sizes.items() if size > 0.01}
    fits = present <= set(printed) <= {*sizes, "_F_bal"}
    yield from unless(fits, f"the sum has {sorted(printed)}, on the lever are {sorted(present)}")
    flips = {printed[name] * signs[name] for name in set(printed) & present}
    yield from unless(len(flips) <= 1, f"the signs of the sum are not those of the drawing: {line}")


def _heading(view: View, symbol: str) -> str:
    """The heading that states a scale factor, from its number on."""
    found = [t.string for t in view.of("heading") if t.string.startswith(symbol)]
    return found[0].partition("=")[2].partition(" (")[0] if found else ""


OWN: tuple[Callable[[Case, Sheet], Faults], ...] = (
    l1_letters_and_supports,
    l2_construction_and_structure,
    l3_to_l6_ends,
    l7_carried_vectors,
    l8_group_apart,
    l9_arms,
    l10_force_plan,
    l11_driver,
    l12_lever,
)
# where a plan is a point its senses and its lever say nothing
UNSURE = (linkage_points.l7_senses, linkage_points.l12_lever)


def mechanism_faults(case: Case, sheet: Sheet, special: bool = False) -> list[str]:
    """All faults of a sheet by the points L1 to L13, those of any linkage and of the slider-crank."""
    general = [judge for judge in linkage_points.JUDGES if not (special and judge in UNSURE)]
    faults = [f"{case} {judge.__name__}: {fault}" for judge in (*general, *OWN) for fault in judge(case, sheet)]
    return [*faults, *(f"{case}: {fault}" for fault in overlaps(sheet))]
