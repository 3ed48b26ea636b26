"""Equations of velocities and accelerations, with their numbers, told step by step from the recorded program."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from ....plans.board import POSITION, Step
from ....plans.linkages.compound import found_here
from ....plans.linkages.mechanism import ZERO
from ....plans.names import POLE, role
from ....plans.quantities import unit_of
from ...printed import Input, calculation
from ..figures.plan import on_link
from ..scene import Scene
from .equations import (
    Lines,
    Product,
    distance,
    factor,
    line_note,
    line_through,
    meeting,
    noted,
    rate_of,
    segment,
    sensed,
    size_by_law,
    size_of,
    stated,
    summed,
    worked,
)

PLANS = ("velocity", "acceleration")
TOLD = ["circular_speed", "centripetal", "circular_acceleration", "normal_part", "turning", "coriolis"]
TOLD += ["transport_speed", "transport_normal", "transport_tangential"]
BEFORE_MEETING = ("normal_part", "coriolis")
STAGES = {"V": "velocity", "omega": "velocity", "a": "acceleration", "epsilon": "acceleration"}


def kinematics_text(scene: Scene, plans: Sequence[str], before: Sequence[str]) -> Lines:
    """Return the equations of plans; lengths that those of the plans `before` take have been told with these."""
    steps = [step for step in scene.program if step.law]
    told = {name for step in steps if stage_of(step) in before for name in step.operands}
    lines = [line for plan in plans for line in kinematics_lines(scene, plan, told)]
    if "velocity" in (*plans, *before):
        return lines
    given = (step for step in steps if step.law == "signed" and role(step.name).kind == "omega")
    return [*(line for step in given for line in _turning_alike(scene, step)), *lines]  # the crank's omega alone


def kinematics_lines(scene: Scene, plan: str, told: set[str] | None = None) -> Lines:
    """Return the equations of one plan in order of construction, the vector equation of a group before its numbers.

    `told` are the lengths of which other lines have told already.
    """
    told, apart = told if told is not None else set(), found_here(scene.program)
    lines, held = Lines(), Lines()  # these of a group's known parts, which come after its vector equation
    for step in (s for s in scene.program if stage_of(s) == plan and s.name not in apart):
        if step.verb == "meet":
            lines += [*_special_point(scene, step), meeting(scene, step), *held]
            held.clear()
        elif step.law in TOLD:
            here = held if step.law in BEFORE_MEETING or _is_met(scene, step) else lines
            here += [*_lengths(scene, step, told), _formula(scene, step)]
        elif step.law == "given":
            lines.append(_given(scene, step))
        elif step.law in ("signed", "same_turning"):
            lines += _turning_alike(scene, step)
        elif step.verb in ("divide", "similar"):
            lines += _similarity(scene, step)
        elif step.verb == "read":
            lines += _absolute(scene, step)
        if role(step.name).kind == "epsilon" and step.law != "same_turning":
            lines.append(_comparison(scene, step.name))
    return lines


def stage_of(step: Step) -> str:
    """Return the plan to which a step of the kinematics belongs; nothing for other steps."""
    if step.plan != POSITION or step.verb == "read":
        return step.plan
    return STAGES.get(role(step.name).kind, "") if step.verb == "calc" else ""


def _is_met(scene: Scene, step: Step) -> bool:
    """Whether a line that finds a point begins at the end of the vector of a step, where no point has its end."""
    users, absolute = scene.reading.users, scene.reading.absolute
    ends = (user.name for user in users(step.name) if user.verb == "chain" and absolute(user.name) is None)
    return any(user.verb == "meet" for end in ends for user in users(end))


def _lengths(scene: Scene, step: Step, told: set[str]) -> Iterator[tuple[str, ...]]:
    """Go through the lengths for a step that are not given, each told once.

    They are measured on the plan of the mechanism, or follow from the coordinates of a link's joints.
    """
    for name in step.operands:
        made = scene.reading.made.get(name)
        if made is None or made.verb != "measure" or name in told:
            continue
        told.add(name)
        symbol = scene.words.symbol(role(name).shown)
        if role(made.operands[0]).hidden:
            yield (stated(scene.words, symbol, size_of(scene, name), "m"),)
        else:
            yield worked(scene.words, symbol, [distance(scene, *made.operands)], "m")


def _formula(scene: Scene, step: Step) -> tuple[str, ...]:
    """Return what a law gives, with its numbers, and how the vector lies.

    It says in which sense a link turns, which way a normal part is laid off, how that of Coriolis is turned.
    """
    words, reading, name = scene.words, scene.reading, scene.reading.visible(step.name)
    line = size_by_law(scene, words.symbol(name), step, unit_of(name))
    if step.law == "turning":
        return noted(line, sensed(words, rate_of(scene, name)))
    if step.law == "normal_part":
        back = next(s for s in reading.users(step.name) if s.verb == "back")
        start, end = (words.mark(point) for point in reading.made[back.operands[1]].operands[:2])
        return noted(line, f"{scene.letter(name)} ∥ {start}{end} ({end} → {start})")
    if step.law == "coriolis":
        omega, v = step.operands
        parts = {"part": scene.letter(name), "vector": scene.letter(v), "omega": words.symbol(omega)}
        first, *rest = words["said.coriolis"].format(**parts).split("|")
        return (*noted(line, first), *rest)
    return line


def _turning_alike(scene: Scene, step: Step) -> Lines:
    """Return a rate that is given, from revolutions per minute where it is so, or that of another link."""
    words, value, given = scene.words, rate_of(scene, step.name), scene.givens.get(step.operands[0])
    symbol, of, unit = words.symbol(step.name), words.symbol(step.operands[0]), unit_of(step.name)
    if given is not None and given.unit == "rpm" and not isinstance(given.value, str):
        texts, result = calculation(words, lambda n: math.pi * n / 30.0, [Input(given.value, exact=True)])
        line = [f"{symbol} = π{of}/30 =", f"π·{texts[0]}/30 =", f"{result} {words.unit(unit)}"]
    else:
        line = [stated(words, f"{symbol} = {of}" if step.law == "same_turning" else symbol, abs(value), unit)]
    return [noted(line, sensed(words, value))]


def _special_point(scene: Scene, step: Step) -> Lines:
    """Say where a point stands that no link has, such as Assur's special point, when it is found for the first time."""
    point, reading = role(step.name).of, scene.reading
    lettered = {point for link in scene.mechanism.links for point in link.points}
    made = reading.made.get(point)
    if step.plan != "velocity" or made is None or made.verb != "meet" or point in lettered:
        return []
    p, u, q, w = made.operands
    lines = f"{line_through(scene, p, u)} ∩ {line_through(scene, q, w)}"
    return [(scene.words["said.special_point"].format(point=scene.words.mark(point)), lines)]


def _given(scene: Scene, step: Step) -> tuple[str, ...]:
    """Return a velocity or acceleration of the driver that the task states along its guide."""
    words, name, given = scene.words, scene.reading.visible(step.name), step.operands[0]
    if given == ZERO:
        return (f"{words.symbol(name)} = 0",)
    head = " = ".join(dict.fromkeys((words.symbol(name), words.symbol(given))))
    line = stated(words, head, float(scene.solved.values[given]), unit_of(name))
    laid = next(user for user in scene.reading.users(step.name) if user.verb == "lay")
    return noted((line,), line_note(scene, name, laid.operands[1]))


def triangles(scene: Scene, step: Step) -> tuple[str, str]:
    """Return the triangle on a plan that is similar to one of a link, and that one, by the letters of their corners."""
    words, plan = scene.words, (step.operands[0], step.operands[1], step.name)
    return "".join(map(words.mark, plan)), "".join(map(words.mark, on_link(scene.program, plan)))


def _similarity(scene: Scene, step: Step) -> Lines:
    """Return where a point of a link stands on a plan by the theorem of similarity."""
    words, (start, end, first, second) = scene.words, step.operands
    if step.verb == "similar":
        plan, link = triangles(scene, step)
        return [tuple(words["said.similar"].format(plan=plan, link=link).split("|"))]
    if size_of(scene, first) == 0.0:
        return []
    a, b, s = map(words.mark, (start, end, step.name))
    ab = segment(scene, f"{a}{b}", step.plan, abs(scene.solved.point(end) - scene.solved.point(start)))
    ratio = Product((ab, factor(scene, first), factor(scene, second, -1)))
    return [worked(words, f"{a}{s}", [ratio], words.display.paper)]


def _absolute(scene: Scene, step: Step) -> Lines:
    """Return the absolute vector of a point that was hung from parts, or moves like another."""
    reading, (tail, tip) = scene.reading, step.operands
    made, whole = reading.made[tip], reading.absolute(tip)
    if role(tail).kind != POLE or made.name == tail:
        return []
    if made.verb == "same":
        other = reading.absolute(made.operands[0])
        parts = [] if other is None else [other]
    else:
        parts = reading.parts(whole) if whole is not None and whole.name == step.name else []
    return [summed(scene, step.name, [edge.name for edge in parts])] if parts else []


def _comparison(scene: Scene, rate: str) -> tuple[str, ...]:
    words, link = scene.words, role(rate).of
    omega, epsilon = rate_of(scene, f"omega_{link}"), rate_of(scene, rate)
    still = "said.translates" if omega == 0.0 else "said.steady"
    key = still if omega * epsilon == 0.0 else "said.speeds_up" if omega * epsilon > 0 else "said.slows_down"
    symbols = {"omega": words.symbol(f"omega_{link}"), "epsilon": words.symbol(rate)}
    return tuple(words[key].format(link=link, **symbols).split("|"))
