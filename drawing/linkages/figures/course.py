"""The sheet of positions: plans of velocities and accelerations of all of them, and what is found over the cycle."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from itertools import accumulate
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ....plans.laws import TURN
from ....plans.linkages.cycle import Cycle
from ....plans.linkages.mechanism import FRAME
from ....plans.names import role
from ....plans.quantities import BALANCES, unit_of
from ....scales.scale import Scale, rounded, steps
from ...dimensions import Axis, Field, axes, curve
from ...printed import value_text
from ...shapes import Circle, Pen
from ...tables import table
from ...view import Canvas, View
from ..scene import Scene
from .cycle import PEAK, SECTIONS, TALL, cut, main_output, output_point, standing
from .plan import TOGETHER, headed, told_apart

Array = NDArray[Any]
WIDE = {5.0: 385.0, 3.5: 165.0}  # mm of the plans of all positions beside one another, by the height of letters
HIGH = {5.0: 480.0, 3.5: 200.0}  # and over one another
AROUND = 2.2  # heights of a letter around a plan, for its letters
LEAST = 10.0  # mm that are left for plans beside their letters
Reach = tuple[float, float, float, float]
STEADY = 1e-6  # part of its size within which a rate is the same all round
BETWEEN = 0.01  # part of the height of a diagram
ALIKE = 9  # decimals, SI, to which links turn alike
LENGTH = {5.0: 240.0, 3.5: 150.0}  # mm of the axis of the driver
GAP = 16.0  # mm between diagrams


def plans_view(scene: Scene, cycle: Cycle, plan: str) -> View:
    """Draw the plans of a kind of all positions to one scale factor, their poles, numbered as these, on a grid."""
    canvas, usual = scene.canvas(), scene.scales[plan]
    numbered = standing(scene, cycle, cycle.angles.tolist(), plan)
    every = [(number, stand, _reach(stand, plan)) for number, stand in numbered]
    usual_reach = float(np.median([max(reach) for _, _, reach in every]))
    stands = [item for item in every if max(item[2]) <= PEAK * usual_reach]
    mu, poles = _grid([reach for _, _, reach in stands], scene)
    scale = Scale(usual.symbol, mu, usual.unit)
    for pole, (number, stand, _) in zip(poles, stands, strict=True):
        _small_plan(canvas, replace(stand, scales={**stand.scales, plan: scale}), plan, pole, number)
    heading = (scene.words[f"heading.positions_{plan}"].format(n=len(stands)), scene.words.scale(scale))
    left = ", ".join(str(number) for number, _, reach in every if max(reach) > PEAK * usual_reach)
    return canvas.finish(f"{plan}_positions", heading, (scene.words["said.left"].format(numbers=left),) if left else ())


def _reach(stand: Scene, plan: str) -> Reach:
    """Return how far a plan reaches from its pole to the left, right, below and above, SI."""
    marks = [stand.solved.point(mark) for mark in _marks(stand, plan)]
    across, up = [0.0, *(z.real for z in marks)], [0.0, *(z.imag for z in marks)]
    return -min(across), max(across), -min(up), max(up)


def _marks(scene: Scene, plan: str) -> list[str]:
    return list(dict.fromkeys(edge.tip for edge in scene.reading.on(plan) if scene.defined(edge.tip)))


def _grid(plans: Sequence[Reach], scene: Scene) -> tuple[float, list[complex]]:
    """Return the round scale factor with which so many plans are largest, each in the middle of its cell, and poles."""
    wide, high = WIDE[scene.style.label], HIGH[scene.style.label]
    around, needed, lines = AROUND * scene.style.text, dict[int, float](), dict[int, tuple[list[float], list[float]]]()
    for count in range(1, len(plans) + 1):
        columns, rows = lines[count] = _lines(plans, count)
        sums = (sum(columns), wide - 2.0 * around * len(columns)), (sum(rows), high - 2.0 * around * len(rows))
        needed[count] = max(size / room if room > LEAST else math.inf for size, room in sums)
    least = min(needed.values(), default=math.inf)
    mu = steps(least)[0] if math.isfinite(least) else 1.0
    # of all that have room at the round factor those that take the least of the page
    taken = {
        count: math.prod(sum(line) / mu + 2.0 * around * len(line) for line in lines[count])
        for count in needed
        if needed[count] <= mu
    }
    count = min(taken, key=lambda count: taken[count], default=1)
    across, up = ([*accumulate(size / mu + 2.0 * around for size in line)] for line in _lines(plans, count))
    columns, rows = ([size / mu for size in line] for line in _lines(plans, count))
    poles = list[complex]()
    for k, (left, right, below, above) in enumerate(plans):
        i, j = k % count, k // count
        middle = complex(across[i] - 0.5 * columns[i], -up[j] + 0.5 * rows[j])
        poles.append(middle + 0.5 * complex(left - right, below - above) / mu)
    return mu, poles


def _lines(plans: Sequence[Reach], count: int) -> tuple[list[float], list[float]]:
    """Return how wide the widest plan of each of so many columns is, and how high the highest one of each row."""
    sizes = [(left + right, below + above) for left, right, below, above in plans]
    rows = (sizes[k : k + count] for k in range(0, len(sizes), count))
    return [max(size[0] for size in sizes[k::count]) for k in range(count)], [max(s[1] for s in row) for row in rows]


def _small_plan(canvas: Canvas, scene: Scene, plan: str, pole: complex, number: int) -> None:
    """Draw one plan about its pole, thin, with the letters of the points of links."""
    vectors = (scene.vector(edge, pole) for edge in dict.fromkeys(scene.reading.on(plan)))
    drawn = [vector for vector in vectors if abs(vector.tip - vector.tail) > 1e-6]
    canvas.add(*(replace(headed(vector, scene.style.arrow), pen=Pen.THIN) for vector in told_apart(drawn)))
    for step in (step for step in scene.program.on(plan) if step.verb == "pole"):
        canvas.add(scene.point(pole, step.name))
        canvas.label(f"{scene.words.mark(step.name)}_{{{number}}}", pole, priority=1)
    at: dict[complex, list[str]] = {}
    for mark in _marks(scene, plan):
        place = scene.mm(mark) + pole
        near = next((other for other in at if abs(other - place) < TOGETHER), place)
        at.setdefault(near, []).append(mark)
    middle = sum(at) / len(at) if at else pole
    for place, marks in at.items():  # those of no point of a link have no letters, which a plan on its own has
        canvas.add(Circle(place, 0.3, Pen.THIN, fill="black"))
        letters = [scene.words.mark(mark) for mark in marks if role(mark).of in scene.points]
        if letters and abs(place - pole) > TOGETHER:
            canvas.label(", ".join(letters), place, prefer=place - middle, height=scene.style.text, optional=True)


def course_of(cycle: Cycle) -> list[tuple[str, ...]]:
    """Return what diagrams over the cycle show beside the main output: how links turn, what balances the driver.

    What belongs to a link stands in one diagram over another; of links that turn alike the first one on the frame has
    them, or the first one, and what is the same all round is in none.
    """
    main, driver = main_output(cycle), cycle.mechanism.driver.link
    on_frame = {number for pair in cycle.mechanism.pairs if FRAME in pair.links for number in pair.links}
    shown = {driver, main.output.link if main is not None and not main.output.slides else driver}
    links = (link.number for link in cycle.mechanism.links if link.number not in shown)
    parts: list[tuple[str, ...]] = [(f"omega_{n}", f"epsilon_{n}") for n in links]
    parts.append(tuple(name for name in BALANCES if name in cycle.quantities)[:1])
    varying = (tuple(name for name in part if _varies(cycle.values.get(name))) for part in parts)
    found: dict[bytes, tuple[str, ...]] = {}
    for part in filter(None, varying):
        key, number = cycle.values[part[0]].round(ALIKE).tobytes(), role(part[0]).of
        found[key] = part if number.isdigit() and int(number) in on_frame else found.get(key, part)
    return [*found.values()]


def _varies(values: Array | None) -> bool:
    if values is None or not np.isfinite(values).any():
        return False
    return float(np.nanmax(values) - np.nanmin(values)) > STEADY * float(np.nanmax(np.abs(values)))


def course_view(scene: Scene, cycle: Cycle, names: Sequence[str]) -> View:
    """Draw quantities over the way of the driver from the first position on, each with its extremes."""
    canvas, style, length = scene.canvas(), scene.style, LENGTH[scene.style.label]
    turns, span, low = cycle.drive.turns, cycle.range, 0.0
    whole, sense = abs(span.high - span.low), 1.0 if span.high >= span.low else -1.0
    across = Scale("mu_phi" if turns else "mu_s", rounded(whole / length, 6), "rad" if turns else "m")
    ways = np.linspace(0.0, whole, 2 * SECTIONS + 1)
    found, extremes = cycle.at(span.low + sense * ways, names), cycle.extremes(names)
    stations = [abs(at - span.low) for at in cycle.angles.tolist()]
    divisions = {at: str(k) for k, at in enumerate(stations)} | ({whole: str(len(stations))} if turns else {})
    symbol = scene.words.symbol(role(cycle.drive.variable).shown)
    for number, name in enumerate(names):
        values, _ = cut(found[name], found[name])
        least, most = min(0.0, float(np.nanmin(values))), max(0.0, float(np.nanmax(values)))
        up = Scale(f"mu_{name}", steps((most - least) / (TALL * length))[0], unit_of(name))
        low -= up.drawn(most) + GAP + 2.0 * style.label if number else 0.0
        letter = f"{scene.words.symbol(name)};  {scene.words.scale(up)}"
        field = Field(1j * low, Axis(symbol, across, 0.0, whole, divisions), Axis(letter, up, least, most, {}))
        axes(canvas, field)
        curve(canvas, field, zip(ways.tolist(), values.tolist(), strict=True), name)
        past = BETWEEN * (most - least)  # an extreme lies between the places through which the curve is drawn
        for extreme in (end for end in extremes.get(name, ()) if least - past <= end.value <= most + past):
            way = sense * (extreme.at - span.low)
            _mark(canvas, scene, field.at(way % TURN if turns else way, extreme.value), extreme.value)
        low += up.drawn(least)
    of = ", ".join(scene.words.symbol(name) for name in names)
    heading = (scene.words["heading.course"].format(names=of), scene.words.scale(across))
    return canvas.finish(f"course_{names[0]}", heading)


def extremes_table(scene: Scene, cycle: Cycle) -> View:
    """Return the table of the largest and smallest values over the cycle, with the places of the driver."""
    words, found, main = scene.words, course_of(cycle), main_output(cycle)
    if main is not None:
        point, link = output_point(cycle), main.output.link
        found.insert(0, (f"V_{point}", f"a_{point}") if main.output.slides else (f"omega_{link}", f"epsilon_{link}"))
    names = [name for part in found for name in part if name in cycle.quantities]
    at = words.symbol(role(cycle.drive.variable).shown)
    rows = [[words[f"table.{key}"] for key in ("quantity", "unit")]]
    rows[0][1:1] = [words["sweep.most"], at, words["sweep.least"], at]
    for name, ends in cycle.extremes(names).items():
        of, row = unit_of(name), [words.symbol(name)]
        for end in ends:
            place = math.degrees(end.at % TURN) if cycle.drive.turns else 1e3 * end.at
            row += [
                value_text(words, words.display.value(end.value, of)),
                words.number(place, 1) + ("°" if cycle.drive.turns else f" {words.unit('mm')}"),
            ]
        rows.append([*row, words.unit(words.display.unit(of))])
    return table("extremes", words["heading.extremes"], rows, scene.style)


def _mark(canvas: Canvas, scene: Scene, at: complex, value: float) -> None:
    """Mark an extreme and say its value."""
    canvas.add(Circle(at, scene.style.node, Pen.THIN, fill="white", role="extreme"))
    canvas.small(value_text(scene.words, value), at, 1j if value > 0.0 else -1j, 1.0)
