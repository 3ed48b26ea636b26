"""The plans of a linkage told step by step, in words, from the recorded program: for the explanatory note."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Mapping, Sequence

from ...plans.board import POSITION
from ...plans.boards.exact import SMALL
from ...plans.laws import dot
from ...plans.linkages.mechanism import MOMENT, Driver
from ...plans.linkages.solved import disagreement
from ...plans.names import FORCES, role
from ...plans.quantities import point_of
from ..figure import GIVEN
from ..handouts import Shown
from ..notes.blocks import Block, Equations, Heading, Story
from ..printed import DIGITS, value_text
from .asking import meanings
from .calculations.equations import kinematics_lines, printed_segment, rate_of, sensed, size_of, stated
from .calculations.forces import LOADS, balance, differ, force_lines, force_parts, lines_by_plan
from .compound import block_name, compound_lines, compound_told
from .figures.compound import figures_of
from .figures.plan import ENLARGED
from .ladders import links_apart
from .scene import Scene, is_at_point, plan_heading
from .telling import Teller, Told, lever_told, tell

SET = ("pole", "place")  # verbs that set a drawing up
PLANS = {"velocity": ("V", "omega"), "acceleration": ("a", "epsilon")}  # kinds of vectors and of rates
BALANCES = ("M_bal", "F_bal")
SAME = 1e-9  # part by which values may differ that are the same by construction
SMALL_ANGLE = 20  # degrees, as `SMALL`


def story(scene: Scene, texts: Mapping[str, str]) -> Story:
    """Return what the note of a linkage says, in sentences by key: equations and steps of plans, what numbers mean."""
    teller, lengths = Teller.of(scene, texts), set[str]()
    steps = {view: [told.text for told in told_of(teller, view)] for view in drawn_views(teller)}
    plans = [plan for plan in PLANS if plan in scene.scales]
    equations = {plan: kinematics_lines(scene, plan, lengths) for plan in plans}
    views = {"equations_kinematics", *(f"equations_{plan}" for plan in plans)}
    for view, points in figures_of(scene).items():
        equations[view] = [line for at in points for line in compound_lines(scene, at.coupler, at.kind, at.point)]
        views |= {block_name(at.coupler, at.kind) for at in points}
    before: dict[str, tuple[Block, ...]] = {}
    if any(role(plan).kind == FORCES for plan in steps):
        groups = scene.solved.structure.groups
        apart = {number for group in groups for number in links_apart(scene.solved, group)}
        equations |= lines_by_plan(scene, apart)
        views |= {"equations_forces", *(f"equations_forces_{part}" for part in force_parts(scene.solved))}
        loads = Heading(scene.words["heading.equations_loads"]), Equations(tuple(map(tuple, force_lines(scene, LOADS))))
        before[f"group_{groups[-1].name}"] = loads
    ends = tuple(_conclusions(teller))
    return Story(steps, equations, frozenset(views), ends, before, meanings=meanings(scene))


def drawn_views(teller: Teller) -> list[str]:
    """Return the views whose drawing is told step by step, in order: the plans, the figures of compound motion."""
    plans = [plan for plan in teller.program.plans if plan in teller.scales and not is_at_point(plan)]
    forces = next((at for at, plan in enumerate(plans) if role(plan).kind == FORCES), len(plans))
    return [*plans[:forces], *figures_of(teller), *plans[forces:]]


def told_of(teller: Teller, view: str) -> Iterator[Told]:
    """Return the steps of a view, each with its sentence."""
    if points := figures_of(teller).get(view):
        return compound_told(teller, points)
    return lever_told(teller) if view == "lever" else _plan(teller, view)


def _plan(teller: Teller, plan: str) -> Iterator[Told]:
    centres = {at.coupler.centre for points in figures_of(teller).values() for at in points}
    for step in teller.program.on(plan):
        hidden = role(step.name).hidden and step.verb not in ("place", "read")
        arm = plan == POSITION and step.verb == "read"  # that a calculation takes
        text = "" if hidden or arm or step.name in centres else tell(teller, step)
        if text:
            yield Told(step, text, before=step.verb in SET)


def begun(scene: Scene, steps: int, plans: Collection[str]) -> dict[str, Shown]:
    """Return for every view what its first steps draw, as the note numbers them; poles and pivots are there before.

    None is drawn before the views of the `plans` have found what it takes: an acceleration before its velocities.
    """
    teller = Teller.of(scene)
    every = {view: list(told_of(teller, view)) for view in drawn_views(teller)}
    parts = {
        view: FORCES if role(view).kind == FORCES else view if view in scene.scales else "compound" for view in every
    }
    done = dict.fromkeys(every, steps) | {view: len(every[view]) for view in every if parts[view] not in plans}
    before: dict[str, int] = {}
    while done != before:
        drawn = {view: drawn_by(teller, view, every[view], done[view]) for view in every}
        found = _found(teller, drawn)
        before, done = done, {}
        for view, told in every.items():
            left_out = (n for n, one in enumerate(told[: before[view]]) if one.step.name not in found)
            done[view] = next(left_out, before[view])
    seen = {view: [name for name, is_drawn in drawn[view].items() if is_drawn] for view in every}
    known = found.union(*seen.values()) - ({*teller.made} - found)
    return {view: _shown(known.intersection(seen[view]), len(every[view]) <= done[view]) for view in every}


def drawn_by(teller: Teller, view: str, every: Sequence[Told], steps: int) -> dict[str, bool]:
    """Return for the steps of a view by name whether they are among the first ones."""
    drawn, before = dict[str, bool](), ""
    for number, told in enumerate(every, 1):
        drawn |= dict.fromkeys((told.step.name, *told.others), told.before or number <= steps)
    for step in teller.program.on(view):  # what nothing is said of is drawn with what stands before it
        before = step.name if step.name in drawn else before
        drawn.setdefault(step.name, drawn.get(before, True))  # before all of them: it is given
    return drawn


def _found(teller: Teller, drawn: Mapping[str, Mapping[str, bool]]) -> set[str]:
    """Return what is known when so much is drawn: what is drawn, or calculated, from what is known."""
    known = dict[str, bool]()
    for marks in drawn.values():
        known |= {name: is_drawn and known.get(name, True) for name, is_drawn in marks.items()}
    found = set[str]()
    for step in teller.program:
        if known.get(step.name, True) and all(name in found or name not in teller.made for name in step.operands):
            found.add(step.name)
    return found


def _shown(drawn: set[str], whole: bool) -> Shown:
    # what is zero, or too short, is told when all is drawn, and drawn larger
    return Shown(frozenset(drawn | ({GIVEN, ENLARGED} if whole else {GIVEN})), notes=whole)


def _conclusions(teller: Teller) -> Iterator[str]:
    """Go through the sentences for the end of the note: what the plans that are drawn have shown."""
    for plan, (kind, rate) in PLANS.items():
        if plan in teller.scales:
            names = [name for name in teller.quantities if _of_point(name, kind)]
            yield from _extremes(teller, f"conclusion.{plan}", names)
            rates = [f"{rate}_{number}" for number in teller.numbers if number != teller.solved.structure.driver]
            values = {name: rate_of(teller, name) for name in rates if name in teller.quantities}
            fastest = max(values, key=lambda name: abs(values[name]), default="")
            if values.get(fastest):
                value, sense = _alike(teller, values, fastest), sensed(teller.words, values[fastest])
                yield teller.texts[f"conclusion.{rate}"].format(value=value, sense=sense)
    gap = disagreement(teller.solved)
    if gap is not None:  # by which the theorems of compound motion give what the plans give
        yield teller.texts["conclusion.compound"].format(part=teller.words.number(100.0 * gap, 2))
    if any(role(plan).kind == FORCES for plan in teller.scales):
        quantities = teller.quantities
        yield from _extremes(teller, "conclusion.reactions", [n for n in quantities if _pair(n)])
        for name in BALANCES:
            yield from _balance(teller, name)
    for name in BALANCES:
        yield from _compared(teller, name)
    yield from _angles(teller)


def _of_point(name: str, kind: str) -> bool:
    """Whether a quantity is the velocity or the acceleration of a point itself, such as `V_A3`; no part of one."""
    quantity = role(name)
    return quantity.kind == kind and not (quantity.hidden or quantity.about or quantity.part)


def _extremes(teller: Teller, key: str, names: Sequence[str]) -> Iterator[str]:
    """Tell the largest and the smallest of some vectors; of forces on one another only one."""
    pairs = filter(None, map(_pair, names))
    twice = {teller.mechanism.pair("R", pair[1], pair[0]) for pair in pairs}  # both are as large
    sizes = {n: size_of(teller, n) for n in names if not (n in twice and _pair(n)[0] > _pair(n)[1])}
    moving = sorted((name for name in sizes if sizes[name] > 0.0), key=lambda name: sizes[name])
    if moving:
        low, high = (_alike(teller, sizes, name) for name in (moving[0], moving[-1]))
        one = math.isclose(sizes[moving[0]], sizes[moving[-1]], rel_tol=SAME)
        yield teller.texts[f"{key}_one" if one else key].format(value=low, high=high, low=low)


def _pair(name: str) -> tuple[int, ...]:
    """Return the links of a whole reaction, that which acts first; nothing where a quantity is none."""
    quantity = role(name)
    return quantity.links if quantity.kind == "R" and not quantity.part else ()


def _alike(teller: Teller, found: Mapping[str, float], name: str) -> str:
    """Return the symbols of all quantities that are as large as one, with its value as the tables print it."""
    item = teller.quantities[name]
    alike = [other for other in found if math.isclose(abs(found[other]), abs(found[name]), rel_tol=SAME)]
    symbol = " = ".join(dict.fromkeys(teller.words.symbol(other) for other in alike))
    if not teller.figure_of(name):
        return stated(teller.words, symbol, abs(found[name]), item.unit)
    return f"{symbol} = {printed_segment(teller, item)[2]} {teller.words.unit(teller.words.display.unit(item.unit))}"


def _balance(teller: Teller, name: str) -> Iterator[str]:
    words = teller.words
    item, driver = teller.quantities.get(name), teller.mechanism.driver
    by_moment = isinstance(driver, Driver) and driver.balance == MOMENT
    if item is None or not item.value or by_moment != (name == "M_bal"):
        return
    speed = f"omega_{driver.link}" if by_moment else f"V_{driver.point}"
    force = item.value if by_moment else teller.values["_F_bal"]
    power = dot(complex(force), complex(teller.values[speed]))
    yield teller.texts[f"conclusion.{name}_{'drives' if power > 0.0 else 'brakes'}"].format(
        value=stated(words, words.symbol(name), abs(item.value), item.unit),
        sense=sensed(words, item.value),
        symbol=words.symbol(name),
        speed=words.symbol(speed, bar=not by_moment),
    )


def _compared(teller: Teller, name: str) -> Iterator[str]:
    words, quantities, found = teller.words, teller.quantities, balance(teller)
    by_lever = f"{name}_lever"
    if name not in found or by_lever not in found or found[name] == found[by_lever] == 0.0:
        return
    said = {"symbol": words.symbol(name), "other": words.symbol(by_lever)}
    for key, one in (("value", name), ("lever", by_lever)):
        said[key] = f"{value_text(words, found[one], DIGITS + 1)} {words.unit(quantities[one].unit)}"
    yield teller.texts["note.balance"].format(part=differ(teller, found)[0], **said)


def _angles(teller: Teller) -> Iterator[str]:
    """Tell where lines meet at less than 20 degrees, or at which angle the flattest ones do."""
    words = teller.words
    plans = {plan for plan in teller.scales if not is_at_point(plan)}  # compound motion meets the same lines
    drawn = {mark: sine for mark, sine in teller.solved.sines.items() if role(mark).plan in plans}
    flat = sorted((mark for mark in drawn if 0.0 < drawn[mark] < SMALL), key=lambda mark: drawn[mark])
    if flat:
        listed = "; ".join(_met(teller, mark, drawn[mark]) for mark in flat)
        loss = words.short(float(f"{1.0 / drawn[flat[0]]:.2g}"))
        yield teller.texts["conclusion.flat"].format(points=listed, loss=loss, limit=SMALL_ANGLE)
    elif drawn:
        mark = min(drawn, key=lambda mark: drawn[mark])
        yield teller.texts["conclusion.sharp"].format(point=_met(teller, mark, drawn[mark]), limit=SMALL_ANGLE)


def _met(teller: Teller, mark: str, sine: float) -> str:
    words, solved = teller.words, teller.solved
    heading = plan_heading(words, solved.structure, role(mark).plan)
    angle = words.short(math.degrees(math.asin(min(sine, 1.0))), 3)
    return f"{words.mark(point_of(solved.program, mark))} ({heading[:1].lower()}{heading[1:]}, {angle}°)"
