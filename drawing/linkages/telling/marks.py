"""Steps that make marks, told: points of the mechanism, ends of vectors, where lines and arcs meet, templates."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterator, Mapping

from ....plans.board import POSITION, Step
from ....plans.linkages.legs import guide_letters
from ....plans.names import ORIGIN, role
from ..calculations.equations import size_of
from ..calculations.kinematics import triangles
from ..calculations.tables import printed_segment
from ..figures.lever import hung_on_lever, letter_of
from .teller import Teller, Told

LINES = ("lay", "back")
FIRST_PATH, OF_PATH = 6, 4  # where the paths of a template's joints begin among its operands, operands of a path


def _pole(teller: Teller, step: Step) -> str:
    return teller.say("lever" if step.plan == "lever" else "pole", point=teller.mark(step.name))


def _place(teller: Teller, step: Step) -> str:
    """A point of the frame, or a guide of the frame with its angle."""
    place, guide, letters = teller.place(step.name), role(step.name).of, guide_letters(teller.scene.program)
    if not role(step.name).hidden:
        return teller.say("place", point=teller.mark(step.name), place=place)
    if role(step.name).kind != ORIGIN or guide not in letters:
        return ""
    angle = _degrees(teller, cmath.phase(complex(teller.scene.solved.values[guide])))
    return teller.say("guide_drawn", line=letters[guide], place=place, angle=angle)


def _lay(teller: Teller, step: Step) -> str:
    """Laid off along a line: a link's length, or a vector; a zero vector is a point."""
    start, direction, size = step.operands
    edge = teller.reading.between(start, step.name)
    b = teller.mark(step.name)
    line = teller.line(direction, back=step.verb == "back")
    if role(start).kind == ORIGIN:
        return teller.say("on_guide", line=teller.plain_line(direction), point=b, mm=teller.drawn(size, step.plan))
    a = teller.mark(start)
    if edge is not None and teller.scene.vanishes(edge.name):
        return teller.say("zero", vector=teller.scene.letter(edge.name), start=a, end=b)
    parts = {"start": a, "length": teller.segment(f"{a}{b}", size, step.plan)}
    if edge is None:
        return teller.say("lay", line=teller.angle(direction) or line, **parts)
    return teller.say("vector", line=line, vector=teller.scene.letter(edge.name), **parts)


def _chain(teller: Teller, step: Step) -> str:
    """A vector that is known in full, hung on another one."""
    start, vector = step.operands
    a, b = teller.mark(start), teller.mark(step.name)
    if teller.scene.vanishes(vector):
        return teller.say("zero", vector=teller.scene.letter(vector), start=a, end=b)
    line = teller.along(vector)
    parts = {"length": teller.segment(f"{a}{b}", vector, step.plan), "vector": teller.hung(vector)}
    return teller.say("vector", start=a, line=line, **parts) if line else teller.say("chain", start=a, **parts)


def _meet(teller: Teller, step: Step) -> str:
    p, u, q, w = step.operands
    first, second = (_through(teller, mark, line) for mark, line in ((p, u), (q, w)))
    return teller.say("meet", first=first, second=second, point=teller.mark(step.name))


def _through(teller: Teller, mark: str, direction: str) -> str:
    """Return a line through a mark; one that is a guide needs no mark."""
    if role(mark).hidden:
        return teller.say("guide", line=teller.plain_line(direction))
    return teller.say("through", line=teller.line(direction), point=teller.mark(mark))


def _arc(teller: Teller, step: Step) -> str:
    centre, radius, through, direction, _ = step.operands
    parts = {"centre": teller.mark(centre), "mm": teller.radius(radius), "point": teller.mark(step.name)}
    return teller.say("arc", line=_through(teller, through, direction), **parts)


def _arcs(teller: Teller, step: Step) -> str:
    first, radius, second, other, _ = step.operands
    parts = {"first": teller.mark(first), "one": teller.radius(radius), "second": teller.mark(second)}
    return teller.say("arcs", other=teller.radius(other), point=teller.mark(step.name), **parts)


def _divide(teller: Teller, step: Step) -> str:
    """A point on the line of a link: on the mechanism itself by its distance, on a plan by similarity."""
    start, end, part, whole = step.operands
    a, b, s = (teller.mark(mark) for mark in (start, end, step.name))
    if step.plan == POSITION:
        return teller.say("on_link", point=s, link=f"{a}{b}", length=teller.segment(f"{a}{s}", part, POSITION))
    ratio = " : ".join(teller.scene.words.symbol(role(name).shown) for name in (part, whole))
    return teller.say("divide", point=s, segment=f"{a}{b}", ratio=ratio)


def _similar(teller: Teller, step: Step) -> str:
    """The third point of a link: on the mechanism by its distances from two others, on a plan by similarity."""
    start, end, *_ = step.operands
    a, b, s = (teller.mark(mark) for mark in (start, end, step.name))
    if step.plan == POSITION:
        one, other = (teller.distance(mark, step.name) for mark in (start, end))
        return teller.say("corner", point=s, segment=f"{a}{b}", first=f"{a}{s}", one=one, second=f"{b}{s}", other=other)
    plan, link = triangles(teller.scene, step)
    return teller.say("similar", point=s, segment=f"{a}{b}", plan=plan, link=link)


def _same(teller: Teller, step: Step) -> str:
    one, other = teller.mark(step.name), teller.mark(step.operands[0])
    return "" if one == other or role(step.name).hidden else teller.say("same", point=one, other=other)


def _read(teller: Teller, step: Step) -> str:
    """A vector that is measured, not laid off: its millimetres times the scale factor."""
    tail, tip = step.operands
    edge = teller.reading.between(tail, tip)
    if edge is None or edge.name != step.name or teller.reading.is_hung(edge):
        return ""
    name = role(step.name).shown  # a force that balances has an intermediate vector
    item, words = teller.scene.solved.quantities.get(name), teller.scene.words
    if item is None:
        return ""
    parts = {"segment": f"{teller.mark(tail)}{teller.mark(tip)}", "symbol": words.symbol(name)}
    if size_of(teller.scene, name) == 0.0:
        return teller.say("point", **parts)
    mm, number, value = printed_segment(teller.scene, item)
    parts |= {"mm": f"{mm} {words.unit(words.display.paper)}", "sum": f"{mm}{'/' if words.per_unit else '·'}{number}"}
    return teller.say("read", value=f"{value} {words.unit(words.display.unit(item.unit))}", **parts)


def _tangent(teller: Teller, step: Step) -> str:
    """The line of a slotted link, through the pivot and the block's pin, or past the pivot at a distance."""
    centre, point, offset, *_ = step.operands
    a, b = teller.mark(centre), teller.mark(point)
    if size_of(teller.scene, offset) == 0.0:
        return teller.say("joined", line=f"{a}{b}", start=a, end=b)
    return teller.say("tangent", line=teller.line(step.name), centre=a, mm=teller.radius(offset), point=b)


def _template(teller: Teller, step: Step) -> str:
    """A joint of a link of which a template is laid on the paths of its joints, told with the first of them."""
    joint, where, point = step.operands[0], step.operands[1:], teller.mark(step.name)
    laid = [other for other in teller.scene.program.which(("template",)) if other.operands[1:] == where]
    if laid[0].name != step.name:
        return teller.say("template_more", point=point)
    names = {other.operands[0]: teller.mark(other.name) for other in laid}
    legs = [step.operands[i : i + OF_PATH] for i in range(FIRST_PATH, len(step.operands), OF_PATH)]
    paths = ", ".join(_path(teller, names[leg[0]], leg) for leg in legs)
    return teller.say("template", link="".join(names.values()), paths=paths, point=names[joint])


def _path(teller: Teller, joint: str, leg: tuple[str, ...]) -> str:
    """Return where a leg lets a joint be: on an arc, or on a line."""
    _, start, radius, direction = leg
    if size_of(teller.scene, radius) == 0.0:
        return teller.say("path_line", point=joint, line=teller.plain_line(direction))
    mm = teller.on_paper(size_of(teller.scene, radius) / teller.scene.scales[POSITION].mu)
    return teller.say("path_arc", point=joint, centre=teller.mark(start), mm=mm)


def _incline(teller: Teller, step: Step) -> str:
    """A guide on a moving link: the angle from the link's own direction to its."""
    letters, values, base = guide_letters(teller.scene.program), teller.scene.solved.values, step.operands[0]
    if step.name not in letters:
        return ""
    turn, own = (cmath.phase(complex(values[name])) for name in (step.name, base))
    angle = _degrees(teller, turn - own)
    return teller.say("guide_on_link", line=letters[step.name], base=teller.plain_line(base), angle=angle)


def _degrees(teller: Teller, angle: float) -> str:
    """Return the angle of a line, 0 to 180 degrees."""
    degrees = round(math.degrees(angle) % 180.0, 2) % 180.0
    return f"{teller.scene.words.short(degrees)}°"


TOLD: Mapping[str, Callable[[Teller, Step], str]] = {
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
    "incline": _incline,
    "template": _template,
}


def lever_told(teller: Teller) -> Iterator[Told]:
    """Go through the steps of Zhukovsky's lever: the velocity plan turned, then what hangs on its ends, with arms."""
    for step in teller.scene.program.on("lever"):
        if step.verb == "pole":
            yield Told(step, _pole(teller, step), before=True)
    yield from _turned(teller)
    hung: dict[str, list[Step]] = {}
    for step in teller.scene.program.which(("moment",)):
        if step.operands[2] == "lever.p":
            hung.setdefault(step.operands[1], []).append(step)
    for mark, moments in hung.items():
        yield _hung(teller, mark, moments)
    yield from _balance(teller)


def _turned(teller: Teller) -> Iterator[Told]:
    """Tell which segments are turned."""
    for step in teller.scene.program.on("lever"):
        if step.verb == "normal":
            segment = f"{teller.mark('velocity.p')}{teller.mark(step.operands[0])}"
            yield Told(step, teller.say("turned", segment=segment))


def _hung(teller: Teller, mark: str, moments: list[Step]) -> Told:
    """Tell the forces on one end of the lever, and their arms about its pole."""
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
    return Told(moments[0], text)


def _balance(teller: Teller) -> Iterator[Told]:
    """Tell the force that balances, at the end of the driver's velocity and normal to it when turned."""
    point = teller.scene.mechanism.driver.point
    step = teller.reading.made.get(f"lever.{point}")
    if step is not None and step.verb == "normal":
        segment = f"{teller.mark('velocity.p')}{teller.mark(f'velocity.{point}')}"
        balance = teller.reading.made[hung_on_lever(teller.scene)[-1][0]]
        said = {"segment": segment, "vector": teller.scene.letter(balance.name)}
        yield Told(balance, teller.say("lever_balance", point=teller.mark(f"velocity.{point}"), **said))
