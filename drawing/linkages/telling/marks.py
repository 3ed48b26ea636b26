"""Steps that make marks, told: points of the mechanism, ends of vectors, where lines and arcs meet, templates."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterable, Iterator, Mapping

from ....plans.board import POSITION, Step
from ....plans.linkages.legs import guide_letters
from ....plans.names import COUPLE, ORIGIN, role
from ..calculations.equations import size_of
from ..calculations.kinematics import triangles
from ..calculations.tables import printed_segment
from ..figures.lever import LeverArm, arms_on_lever, driven, hung_on_lever, images, letter_of, lines_of_lever
from .teller import Teller, Told

LINES = ("lay", "back")
FIRST_PATH, OF_PATH = 6, 4  # where the paths of a template's joints begin among its operands, operands of a path


def _pole(teller: Teller, step: Step) -> Iterator[str]:
    yield teller.say("lever" if step.plan == "lever" else "pole", point=teller.mark(step.name))


def _place(teller: Teller, step: Step) -> Iterator[str]:
    if role(step.name).hidden:
        yield from guide_told(teller, step)
    else:
        yield teller.say("place", point=teller.mark(step.name), place=teller.place(step.name))


def _lay(teller: Teller, step: Step) -> Iterator[str]:
    """Laid off along a line: a link's length, or a vector; a zero vector is a point."""
    start, direction, size = step.operands
    edge = teller.reading.between(start, step.name)
    b = teller.mark(step.name)
    line = teller.line(direction, back=step.verb == "back")
    if role(start).kind == ORIGIN:
        yield teller.say("on_guide", line=teller.plain_line(direction), point=b, mm=teller.drawn(size, step.plan))
        return
    a = teller.mark(start)
    if edge is not None and teller.scene.vanishes(edge.name):
        yield teller.say("zero", vector=teller.scene.letter(edge.name), start=a, end=b)
        return
    parts = {"start": a, "length": teller.segment(f"{a}{b}", size, step.plan)}
    if edge is None:
        yield teller.say("lay", line=teller.angle(direction) or line, **parts)
    else:
        yield teller.say("vector", line=line, vector=teller.scene.letter(edge.name), **parts)


def _chain(teller: Teller, step: Step) -> Iterator[str]:
    """A vector that is known in full, hung on another one."""
    start, vector = step.operands
    a, b = teller.mark(start), teller.mark(step.name)
    if teller.scene.vanishes(vector):
        yield teller.say("zero", vector=teller.scene.letter(vector), start=a, end=b)
        return
    line = teller.along(vector)
    parts = {"length": teller.segment(f"{a}{b}", vector, step.plan), "vector": teller.hung(vector)}
    if line:
        yield teller.say("vector", start=a, line=line, **parts)
    else:
        yield teller.say("chain", start=a, **parts)


def _meet(teller: Teller, step: Step) -> Iterator[str]:
    p, u, q, w = step.operands
    first, second = (_through(teller, mark, line) for mark, line in ((p, u), (q, w)))
    yield teller.say("meet", first=first, second=second, point=teller.mark(step.name))


def _through(teller: Teller, mark: str, direction: str) -> str:
    """Return a line through a mark; one that is a guide needs no mark."""
    if role(mark).hidden:
        return teller.say("guide", line=teller.plain_line(direction))
    return teller.say("through", line=teller.line(direction), point=teller.mark(mark))


def _arc(teller: Teller, step: Step) -> Iterator[str]:
    centre, radius, through, direction, _ = step.operands
    parts = {"centre": teller.mark(centre), "mm": teller.radius(radius), "point": teller.mark(step.name)}
    yield teller.say("arc", line=_through(teller, through, direction), **parts)


def _arcs(teller: Teller, step: Step) -> Iterator[str]:
    first, radius, second, other, _ = step.operands
    yield teller.say(
        "arcs", first=teller.mark(first), one=teller.radius(radius), second=teller.mark(second),
        other=teller.radius(other), point=teller.mark(step.name),
    )  # fmt: skip


def _divide(teller: Teller, step: Step) -> Iterator[str]:
    """A point on the line of a link: on the mechanism itself by its distance, on a plan by similarity."""
    start, end, part, whole = step.operands
    a, b, s = (teller.mark(mark) for mark in (start, end, step.name))
    if step.plan == POSITION:
        yield teller.say("on_link", point=s, link=f"{a}{b}", length=teller.segment(f"{a}{s}", part, POSITION))
        return
    ratio = " : ".join(teller.scene.words.symbol(role(name).shown) for name in (part, whole))
    yield teller.say("divide", point=s, segment=f"{a}{b}", ratio=ratio)


def _similar(teller: Teller, step: Step) -> Iterator[str]:
    """The third point of a link: on the mechanism by its distances from two others, on a plan by similarity."""
    start, end, *_ = step.operands
    a, b, s = (teller.mark(mark) for mark in (start, end, step.name))
    if step.plan == POSITION:
        one, other = (teller.distance(mark, step.name) for mark in (start, end))
        yield teller.say("corner", point=s, segment=f"{a}{b}", first=f"{a}{s}", one=one, second=f"{b}{s}", other=other)
        return
    plan, link = triangles(teller.scene, step)
    yield teller.say("similar", point=s, segment=f"{a}{b}", plan=plan, link=link)


def _same(teller: Teller, step: Step) -> Iterator[str]:
    one, other = teller.mark(step.name), teller.mark(step.operands[0])
    if one != other and not role(step.name).hidden:
        yield teller.say("same", point=one, other=other)


def _read(teller: Teller, step: Step) -> Iterator[str]:
    """A vector that is measured, not laid off: its millimetres times the scale factor."""
    tail, tip = step.operands
    edge = teller.reading.between(tail, tip)
    if edge is None or edge.name != step.name or teller.reading.is_hung(edge):
        return
    name = role(step.name).shown  # a force that balances has an intermediate vector
    item = teller.scene.solved.quantities.get(name)
    if item is None:
        return
    words, segment = teller.scene.words, f"{teller.mark(tail)}{teller.mark(tip)}"
    if size_of(teller.scene, name) == 0.0:
        yield teller.say("point", segment=segment, symbol=words.symbol(name))
        return
    mm, number, value = printed_segment(teller.scene, item)
    sign = "/" if words.per_unit else "·"
    result = f"{value} {words.unit(words.display.unit(item.unit))}"
    shown = f"{mm} {words.unit(words.display.paper)}"
    yield teller.say(
        "read", segment=segment, mm=shown, symbol=words.symbol(name), sum=f"{mm}{sign}{number}", value=result
    )


def _tangent(teller: Teller, step: Step) -> Iterator[str]:
    """The line of a slotted link, through the pivot and the block's pin, or past the pivot at a distance."""
    centre, point, offset, *_ = step.operands
    a, b = teller.mark(centre), teller.mark(point)
    if size_of(teller.scene, offset) == 0.0:
        yield teller.say("joined", line=f"{a}{b}", start=a, end=b)
    else:
        yield teller.say("tangent", line=teller.line(step.name), centre=a, mm=teller.radius(offset), point=b)


def _template(teller: Teller, step: Step) -> Iterator[str]:
    """A joint of a link of which a template is laid on the paths of its joints, told with the first of them."""
    joint, where, point = step.operands[0], step.operands[1:], teller.mark(step.name)
    laid = [other for other in teller.scene.solved.program.which(("template",)) if other.operands[1:] == where]
    if laid[0].name != step.name:
        yield teller.say("template_more", point=point)
        return
    names = {other.operands[0]: teller.mark(other.name) for other in laid}
    legs = [step.operands[i : i + OF_PATH] for i in range(FIRST_PATH, len(step.operands), OF_PATH)]
    paths = ", ".join(_path(teller, names[leg[0]], leg) for leg in legs)
    yield teller.say("template", link="".join(names.values()), paths=paths, point=names[joint])


def _path(teller: Teller, joint: str, leg: tuple[str, ...]) -> str:
    """Return where a leg lets a joint be: on an arc, or on a line."""
    _, start, radius, direction = leg
    if size_of(teller.scene, radius) == 0.0:
        return teller.say("path_line", point=joint, line=teller.plain_line(direction))
    return teller.say(
        "path_arc",
        point=joint,
        centre=teller.mark(start),
        mm=teller.on_paper(size_of(teller.scene, radius) / teller.scene.scales[POSITION].mu),
    )


def guide_told(teller: Teller, step: Step) -> Iterator[str]:
    """Tell how a guide lies: one of the frame with its mark, one of a moving link with its direction."""
    letters = guide_letters(teller.scene.solved.program)
    if step.verb == "incline":
        if step.name in letters:
            base = teller.plain_line(step.operands[0])
            yield teller.say("guide_on_link", line=letters[step.name], base=base, angle=_between(teller, step))
        return
    guide = role(step.name).of
    if role(step.name).kind == ORIGIN and guide in letters:
        angle = _degrees(teller, cmath.phase(complex(teller.scene.solved.values[guide])))
        place = teller.place(step.name)
        yield teller.say("guide_drawn", line=letters[guide], place=place, angle=angle)


def _between(teller: Teller, step: Step) -> str:
    """Return the angle from a link's own direction to that of a guide on it."""
    values = teller.scene.solved.values
    turn, base = (cmath.phase(complex(values[name])) for name in (step.name, step.operands[0]))
    return _degrees(teller, turn - base)


def _degrees(teller: Teller, angle: float) -> str:
    """Return the angle of a line, 0 to 180 degrees."""
    degrees = round(math.degrees(angle) % 180.0, 2) % 180.0
    return f"{teller.scene.words.short(degrees)}°"


TOLD: Mapping[str, Callable[[Teller, Step], Iterator[str]]] = {
    "pole": _pole,
    "place": _place,
    "lay": _lay,
    "back": _lay,
    "chain": _chain,
    "meet": _meet,
    "arc": _arc,
    "arcs": _arcs,
    "divide": _divide,
    "similar": _similar,
    "same": _same,
    "read": _read,
    "tangent": _tangent,
    "incline": guide_told,
    "template": _template,
}


def lever_told(teller: Teller) -> Iterator[Told]:
    """Go through the steps of Zhukovsky's lever: the velocity plan turned, then what hangs on its ends, with arms."""
    for step in teller.scene.solved.program.on("lever"):
        if step.verb == "pole":
            yield from (Told(step, text, before=True) for text in _pole(teller, step))
    yield from _turned(teller)
    hung: dict[str, list[Step]] = {}
    for step in teller.scene.solved.program.which(("moment",)):
        if step.operands[2] == "lever.p":
            hung.setdefault(step.operands[1], []).append(step)
    told, left = set[str](), arms_on_lever(teller.scene)
    for mark, moments in hung.items():
        told.update(moment.operands[0] for moment in moments)
        drawn = [arm for arm in left if told.issuperset(arm.forces)]
        left = [arm for arm in left if arm not in drawn]
        yield _hung(teller, mark, moments, drawn)
    yield from _balance(teller)


def _turned(teller: Teller) -> Iterator[Told]:
    """Tell which segments are turned; a line is there with both its ends, the rest of the plan with the last one."""
    scene, told = teller.scene, {"lever.p"}
    lines, marks = lines_of_lever(scene), images(scene)
    steps = [step for step in scene.solved.program.on("lever") if step.verb == "normal"]
    for step in steps:
        told |= set(marks) if step is steps[-1] else {step.name}
        drawn = {line.name for line in lines if step is steps[-1] or told.issuperset((line.start, line.end))}
        segment = f"{teller.mark('velocity.p')}{teller.mark(step.operands[0])}"
        letters = frozenset(letter_of(scene, mark) for mark in told & set(marks))
        yield Told(step, teller.say("turned", segment=segment), names=frozenset(drawn | told), letters=letters)


def _hung(teller: Teller, mark: str, moments: list[Step], drawn: Iterable[LeverArm]) -> Told:
    """Tell the forces on one end of the lever, and their arms about its pole; those `drawn` have all their forces."""
    scene = teller.scene
    words, forces = scene.words, [moment.operands[0] for moment in moments]
    arms = [user.name for moment in moments for user in teller.reading.users(moment.name) if user.verb == "arm"]
    zero = {arm for arm in arms if not scene.defined(arm) or size_of(scene, arm) == 0.0}
    sizes = ("0" if arm in zero else f"{scene.segment(arm)} {words.unit(words.display.paper)}" for arm in arms)
    text = teller.say(
        "lever_forces",
        point=letter_of(scene, mark),
        forces=", ".join(map(scene.letter, forces)),
        arms=", ".join(f"{words.symbol(arm)} = {size}" for arm, size in zip(arms, sizes, strict=True)),
    )
    couples = {role(force).of for force in forces if role(force).part == COUPLE}
    at_pole = [name for name, at in hung_on_lever(scene) if at == "lever.p" and role(name).part == COUPLE]
    hung = (*forces, *(name for name in at_pole if role(name).of in couples))
    names = frozenset(name for arm in drawn for name in (arm.line, *arm.names))
    return Told(moments[0], text, names=names, letters=frozenset(arm.said(scene) for arm in drawn), vectors=hung)


def _balance(teller: Teller) -> Iterator[Told]:
    """Tell the force that balances, at the end of the driver's velocity and normal to it when turned."""
    point = teller.scene.solved.mechanism.driver.point
    step = teller.reading.step(f"lever.{point}")
    if step is not None and step.verb == "normal":
        segment = f"{teller.mark('velocity.p')}{teller.mark(f'velocity.{point}')}"
        vector = teller.scene.letter(balance := hung_on_lever(teller.scene)[-1][0])
        text = teller.say("lever_balance", point=teller.mark(f"velocity.{point}"), segment=segment, vector=vector)
        yield Told(step, text, letters=frozenset((driven(teller.scene),)), vectors=(balance,))
