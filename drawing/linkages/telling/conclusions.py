"""What a note of a linkage concludes: extreme velocities, accelerations, reactions, balance, how sharply lines meet."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping

from ....plans.boards.exact import SMALL
from ....plans.laws import dot
from ....plans.linkages.mechanism import MOMENT, Driver
from ....plans.linkages.solved import disagreement
from ....plans.names import FORCES, role
from ....plans.quantities import Quantity
from ....plans.references import point_of
from ...printed import value_text
from ..at_point import is_at_point
from ..calculations.equations import rate_of, sensed, size_of, stated
from ..calculations.tables import printed_segment
from ..scene import Scene, plan_heading
from .teller import Teller

PLANS = ("velocity", "acceleration")
RATES = {"velocity": "omega", "acceleration": "epsilon"}
BALANCES = ("M_bal", "F_bal")
SAME = 1e-9  # part by which values may differ that are the same by construction
SMALL_ANGLE = 20  # degrees, as `SMALL`


def conclusions(teller: Teller) -> Iterator[str]:
    """Go through the sentences for the end of the note: what the plans that are drawn have shown."""
    for plan in PLANS:
        if plan in teller.scene.scales:
            yield from _extremes(teller, f"conclusion.{plan}", _absolute(teller, plan))
            yield from _fastest(teller, RATES[plan])
    yield from _both_ways(teller)
    if any(role(plan).kind == FORCES for plan in teller.scene.scales):
        quantities = teller.scene.solved.quantities
        yield from _extremes(teller, "conclusion.reactions", [n for n in quantities if _pair(n)])
        for name in BALANCES:
            yield from _balance(teller, name)
    for name in BALANCES:
        yield from _compared(teller, name)
    yield from _angles(teller)


def _absolute(teller: Teller, plan: str) -> list[str]:
    """Return the absolute vectors of a plan: those of the points of links."""
    points = {point for link in teller.scene.solved.mechanism.links for point in link.points}
    kind = "V" if plan == "velocity" else "a"
    names = dict.fromkeys(f"{kind}_{point}" for point in points)
    return [name for name in teller.scene.solved.quantities if name in names]


def _extremes(teller: Teller, key: str, names: Iterable[str]) -> Iterator[str]:
    """Tell the largest and the smallest of some vectors; of forces on one another only one."""
    scene = teller.scene
    listed = tuple(names)
    found = {name: size_of(scene, name) for name in listed if _other_side(scene, name) not in listed}
    moving = sorted((name for name in found if found[name] > 0.0), key=lambda name: found[name])
    if moving and not math.isclose(found[moving[0]], found[moving[-1]], rel_tol=SAME):
        low, high = (_alike(teller, found, name) for name in (moving[0], moving[-1]))
        yield teller.texts[key].format(high=high, low=low)
    elif moving:
        yield teller.texts[f"{key}_one"].format(value=_alike(teller, found, moving[0]))


def _pair(name: str) -> tuple[int, ...]:
    """Return the links of a whole reaction, that which acts first; nothing where a quantity is none."""
    quantity = role(name)
    return quantity.links if quantity.kind == "R" and not quantity.part else ()


def _other_side(scene: Scene, name: str) -> str:
    """Return the reaction that stands for this one, too, since both are as large; nothing where it is itself that."""
    pair = _pair(name)
    return scene.solved.mechanism.pair("R", pair[1], pair[0]) if pair and pair[0] > pair[1] else ""


def _alike(teller: Teller, found: Mapping[str, float], name: str) -> str:
    """Return the symbols of all quantities that are as large as one, with its value as the tables print it."""
    scene, item = teller.scene, teller.scene.solved.quantities[name]
    alike = [other for other in found if math.isclose(abs(found[other]), abs(found[name]), rel_tol=SAME)]
    symbol = " = ".join(dict.fromkeys(scene.words.symbol(other) for other in alike))
    if not scene.figure_of(name):
        return stated(scene.words, symbol, abs(found[name]), item.unit)
    return f"{symbol} = {printed_segment(scene, item)[2]} {scene.words.unit(scene.words.display.unit(item.unit))}"


def _fastest(teller: Teller, rate: str) -> Iterator[str]:
    """Tell which of the links that are moved turns fastest, or speeds up most."""
    scene = teller.scene
    driver = str(scene.solved.structure.driver)
    names = [f"{rate}_{link.number}" for link in scene.solved.mechanism.links if str(link.number) != driver]
    values = {name: rate_of(scene, name) for name in names if name in scene.solved.quantities}
    fastest = max(values, key=lambda name: abs(values[name]), default=None)
    if fastest is None or values[fastest] == 0.0:
        return
    value, sense = _alike(teller, values, fastest), sensed(scene.words, values[fastest])
    yield teller.texts[f"conclusion.{rate}"].format(value=value, sense=sense)


def _both_ways(teller: Teller) -> Iterator[str]:
    """Tell that the theorems of compound motion give what the plans give."""
    gap = disagreement(teller.scene.solved)
    if gap is not None:
        part = teller.scene.words.number(100.0 * gap, 2)
        yield teller.texts["conclusion.compound"].format(part=part)


def _balance(teller: Teller, name: str) -> Iterator[str]:
    """Tell which way what balances the driver acts, and what that means."""
    scene, words = teller.scene, teller.scene.words
    item, driver = scene.solved.quantities.get(name), scene.solved.mechanism.driver
    by_moment = isinstance(driver, Driver) and driver.balance == MOMENT
    if item is None or not item.value or by_moment != (name == "M_bal"):
        return
    speed = f"omega_{driver.link}" if by_moment else f"V_{driver.point}"
    force = item.value if by_moment else scene.solved.values["_F_bal"]
    power = dot(complex(force), complex(scene.solved.values[speed]))
    yield teller.texts[f"conclusion.{name}_{'drives' if power > 0.0 else 'brakes'}"].format(
        value=stated(words, words.symbol(name), abs(item.value), item.unit),
        sense=sensed(words, item.value),
        symbol=words.symbol(name),
        speed=words.symbol(speed, bar=not by_moment),
    )


def _compared(teller: Teller, name: str) -> Iterator[str]:
    """Compare what balances the driver by the force plans and by the lever."""
    words, quantities = teller.scene.words, teller.scene.solved.quantities
    by_plans, by_lever = quantities.get(name), quantities.get(f"{name}_lever")
    if by_plans is None or by_lever is None or not by_plans.value or by_lever.value is None:
        return
    first, second = (_with_unit(teller, item) for item in (by_plans, by_lever))
    part = abs(by_plans.value - by_lever.value) / abs(by_plans.value)
    symbols = words.symbol(name), words.symbol(f"{name}_lever")
    yield teller.texts["note.balance"].format(
        symbol=symbols[0], value=first, other=symbols[1], lever=second, part=words.number(100.0 * part, 2)
    )


def _with_unit(teller: Teller, item: Quantity) -> str:
    words = teller.scene.words
    return f"{value_text(words, abs(item.value or 0.0))} {words.unit(item.unit)}"


def _angles(teller: Teller) -> Iterator[str]:
    """Tell where lines meet at less than 20 degrees, or at which angle the flattest ones do."""
    words = teller.scene.words
    # compound motion meets the same lines once more
    drawn_plans = {plan for plan in teller.scene.scales if not is_at_point(plan)}
    drawn = {mark: sine for mark, sine in teller.scene.solved.sines.items() if role(mark).plan in drawn_plans}
    flat = sorted((mark for mark in drawn if 0.0 < drawn[mark] < SMALL), key=lambda mark: drawn[mark])
    if flat:
        listed = "; ".join(_met(teller, mark, drawn[mark]) for mark in flat)
        loss = words.short(float(f"{1.0 / drawn[flat[0]]:.2g}"))
        yield teller.texts["conclusion.flat"].format(points=listed, loss=loss, limit=SMALL_ANGLE)
    elif drawn:
        mark = min(drawn, key=lambda mark: drawn[mark])
        yield teller.texts["conclusion.sharp"].format(point=_met(teller, mark, drawn[mark]), limit=SMALL_ANGLE)


def _met(teller: Teller, mark: str, sine: float) -> str:
    """Return a point with its plan and the angle at which its lines meet."""
    words, solved = teller.scene.words, teller.scene.solved
    heading = plan_heading(words, solved.structure, role(mark).plan)
    angle = words.short(math.degrees(math.asin(min(sine, 1.0))), 3)
    return f"{words.mark(point_of(solved.program, mark))} ({heading[:1].lower()}{heading[1:]}, {angle}°)"
