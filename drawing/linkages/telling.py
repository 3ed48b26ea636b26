"""Plans told step by step in words: points, ends of vectors, where lines and arcs meet, templates, the lever."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import NamedTuple

from ...plans.board import POSITION, Step
from ...plans.linkages.legs import guide_letters
from ...plans.names import ORIGIN, role
from ...scales.packaged import packaged
from .. import notes
from ..printed import HUNDREDTHS, POINT, Input, Symbol, calculation
from .calculations.equations import Product, ends_of, factor, is_given, line_of, paper, size_of, triangles
from .calculations.tables import printed_segment
from .figures.lever import hung_on_lever, letter_of, moments_on_lever
from .reading import Reading
from .scene import Scene

DOWN = 270.0  # degrees
FIRST_PATH, OF_PATH = 6, 4  # where the paths of a template's joints begin among its operands, operands of a path


class Told(NamedTuple):
    """A sentence, the step that it tells of, and `others` that draw in it beside this one.

    What is there `before` only sets a drawing up, as a pole does: a handout shows it from the start.
    """

    step: Step
    text: str
    before: bool = False
    others: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Teller:
    """Tells steps in the words of one language."""

    scene: Scene
    reading: Reading
    texts: Mapping[str, str]

    @classmethod
    def of(cls, scene: Scene, texts: Mapping[str, str] | None = None) -> Teller:
        """Return who tells the steps of a linkage; the words of the scene's language where no `texts` are said."""
        said = packaged(notes.__name__, "texts", scene.words.language) if texts is None else texts
        return cls(scene, scene.reading, said)

    def say(self, key: str, **parts: str) -> str:
        """Return a sentence."""
        return self.texts[f"step.{key}"].format(**parts)

    def mark(self, name: str) -> str:
        """Return the letter of a mark."""
        return self.scene.words.mark(name)

    def segment(self, letters: str, name: str, plan: str) -> str:
        """Return a segment by its letters with the length at which it is drawn; lengths may have the same letters."""
        text = self.drawn(name, plan)
        return text if text.startswith((f"{letters}/", f"{letters}·")) else f"{letters} = {text}"

    def drawn(self, name: str, plan: str) -> str:
        """Return how long a quantity is drawn on a plan: by its scale factor, with the numbers put in."""
        words, scale = self.scene.words, self.scene.scales[plan]
        if role(name).hidden and role(name).shown not in self.scene.solved.quantities:
            return self.on_paper(size_of(self.scene, name) / scale.mu)
        value, mu = factor(self.scene, name), paper(words, scale)
        length = Product((value, replace(mu, power=-mu.power)))
        inputs = [Input(value.value, value.exact), Input(mu.value, exact=True)]
        texts, result = calculation(words, lambda *x: length.of(x), inputs, HUNDREDTHS)
        numbers, unit = length.of([*map(Symbol.of, texts)]), words.unit(words.display.paper)
        return f"{length.in_letters} = {numbers} = {result} {unit}"

    def on_paper(self, mm: float) -> str:
        """Return a length on paper with its unit."""
        words = self.scene.words
        return f"{words.number(words.display.segment(mm), 2)} {words.unit(words.display.paper)}"

    def line(self, direction: str, back: bool = False) -> str:
        """Return a line by its direction, with the sense in which a normal part is laid off."""
        text, made = line_of(self.scene, direction), self.reading.made.get(direction)
        if back and made is not None and made.verb in ("direction", "turn") and text.startswith("∥"):
            start, end = (self.mark(point) for point in ends_of(self.reading, direction))
            return f"{text} ({end} → {start})"
        return text

    def plain_line(self, direction: str) -> str:
        """Return a line by its letters alone, such as a guide."""
        return self.line(direction).removeprefix("∥ ")

    def angle(self, direction: str) -> str:
        """Return the angle of the driver as the task gives it; nothing for other lines."""
        made = self.reading.made.get(direction)
        name, words = made.operands[0] if made is not None and made.verb == "turn" else "", self.scene.words
        given = self.scene.givens.get(name) if is_given(self.scene, name) else None
        if given is None or isinstance(given.value, str):
            return ""
        value = f"{words.short(given.value)}{'°' if given.unit == 'deg' else words.unit(given.unit)}"
        return self.say("angle", symbol=words.symbol(name), value=value)

    def along(self, vector: str) -> str:
        """Return how a vector that is hung on others lies, by the law that gives it; nothing where that is said so."""
        made = self.reading.made.get(vector)
        if made is None:
            return ""
        if made.verb == "read":  # laid off along a line on another plan
            laid = self.reading.made[made.operands[1]]
            own = laid.verb in ("lay", "back") and laid.operands[0] == made.operands[0]
            return self.line(laid.operands[1], back=laid.verb == "back") if own else ""
        match made.law:
            case "transport_speed" | "transport_tangential" | "transport_normal":  # of a turn about a pin
                pin, point = (self.mark(mark) for mark in self.reading.made[made.operands[1]].operands)
                if made.law == "transport_normal":
                    return f"∥ {pin}{point} ({point} → {pin})"
                return self.say("in_sense", line=f"⊥ {pin}{point}", rate=self.scene.words.symbol(made.operands[0]))
            case "coriolis":
                rate, turned = made.operands
                return self.say("turned_by", vector=self.scene.letter(turned), rate=self.scene.words.symbol(rate))
            case "inertia_force" | "resisting_force" | "resisting_along":
                return self.say("against", motion=self.scene.letter(made.operands[1]))
            case "weight":
                return self.say("down")
            case "along":
                return self._given(made)
        return ""

    def _given(self, made: Step) -> str:
        """Return the line of a load: that of the plan along which it acts, or its angle."""
        line = self.reading.made.get(made.operands[1])
        if line is not None and line.verb != "turn":
            return self.line(made.operands[1])
        angle = math.degrees(cmath.phase(complex(self.scene.solved.values[made.name]))) % 360.0
        down = abs(angle - DOWN) < 1e-9
        return self.say("down") if down else self.say("inclined", angle=self.scene.words.short(round(angle, 2)))


def _pole(teller: Teller, step: Step) -> str:
    return teller.say("lever" if step.plan == "lever" else "pole", point=teller.mark(step.name))


def _place(teller: Teller, step: Step) -> str:
    words, at = teller.scene.words, teller.scene.mm(step.name)
    guide, letters = role(step.name).of, guide_letters(teller.scene.program)
    x, y = (words.short(round(words.display.segment(part), 2)) for part in (at.real, at.imag))
    place = teller.say("coordinates", x=x, y=y, unit=words.unit(words.display.paper))
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
    start, vector = step.operands
    a, b = teller.mark(start), teller.mark(step.name)
    if teller.scene.vanishes(vector):
        return teller.say("zero", vector=teller.scene.letter(vector), start=a, end=b)
    line, letter, made = teller.along(vector), teller.scene.letter(vector), teller.reading.made.get(vector)
    if made is not None and made.law == "opposite":  # a reaction, and the one that it answers
        letter = f"{letter} = −{teller.scene.letter(made.operands[0])}"
    parts = {"length": teller.segment(f"{a}{b}", vector, step.plan), "vector": letter}
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
    parts = {"centre": teller.mark(centre), "mm": teller.drawn(radius, POSITION), "point": teller.mark(step.name)}
    return teller.say("arc", line=_through(teller, through, direction), **parts)


def _arcs(teller: Teller, step: Step) -> str:
    first, radius, second, other, _ = step.operands
    parts = {"first": teller.mark(first), "one": teller.drawn(radius, POSITION), "second": teller.mark(second)}
    return teller.say("arcs", other=teller.drawn(other, POSITION), point=teller.mark(step.name), **parts)


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
        sizes = (abs(teller.scene.mm(mark) - teller.scene.mm(step.name)) for mark in (start, end))
        one, other = (teller.on_paper(size if size >= POINT else 0.0) for size in sizes)
        return teller.say("corner", point=s, segment=f"{a}{b}", first=f"{a}{s}", one=one, second=f"{b}{s}", other=other)
    plan, link = triangles(teller.scene, step)
    return teller.say("similar", point=s, segment=f"{a}{b}", plan=plan, link=link)


def _same(teller: Teller, step: Step) -> str:
    one, other = teller.mark(step.name), teller.mark(step.operands[0])
    return "" if one == other or role(step.name).hidden else teller.say("same", point=one, other=other)


def _read(teller: Teller, step: Step) -> str:
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
    centre, point, offset, *_ = step.operands
    a, b = teller.mark(centre), teller.mark(point)
    if size_of(teller.scene, offset) == 0.0:
        return teller.say("joined", line=f"{a}{b}", start=a, end=b)
    return teller.say("tangent", line=teller.line(step.name), centre=a, mm=teller.drawn(offset, POSITION), point=b)


def _template(teller: Teller, step: Step) -> str:
    """A joint of a link of which a template is laid on the paths of its joints, told with the first of them."""
    joint, *where = step.operands
    laid = [other for other in teller.scene.program.which(("template",)) if [*other.operands[1:]] == where]
    if laid[0].name != step.name:
        return teller.say("template_more", point=teller.mark(step.name))
    names = {other.operands[0]: teller.mark(other.name) for other in laid}
    legs = [step.operands[i : i + OF_PATH] for i in range(FIRST_PATH, len(step.operands), OF_PATH)]
    paths = ", ".join(_path(teller, names[leg[0]], leg) for leg in legs)
    return teller.say("template", link="".join(names.values()), paths=paths, point=names[joint])


def _path(teller: Teller, joint: str, leg: tuple[str, ...]) -> str:
    _, start, radius, direction = leg
    if size_of(teller.scene, radius) == 0.0:
        return teller.say("path_line", point=joint, line=teller.plain_line(direction))
    mm = teller.on_paper(size_of(teller.scene, radius) / teller.scene.scales[POSITION].mu)
    return teller.say("path_arc", point=joint, centre=teller.mark(start), mm=mm)


def _incline(teller: Teller, step: Step) -> str:
    letters, values, base = guide_letters(teller.scene.program), teller.scene.solved.values, step.operands[0]
    if step.name not in letters:
        return ""
    turn, own = (cmath.phase(complex(values[name])) for name in (step.name, base))
    said = {"line": letters[step.name], "base": teller.plain_line(base)}
    return teller.say("guide_on_link", angle=_degrees(teller, turn - own), **said)


def _degrees(teller: Teller, angle: float) -> str:
    return f"{teller.scene.words.short(round(math.degrees(angle) % 180.0, 2) % 180.0)}°"


TOLD: Mapping[str, Callable[[Teller, Step], str]] = {
    **{"pole": _pole, "place": _place, "lay": _lay, "back": _lay, "chain": _chain, "meet": _meet, "arc": _arc},
    **{"arcs": _arcs, "divide": _divide, "similar": _similar, "same": _same, "read": _read, "tangent": _tangent},
    **{"incline": _incline, "template": _template},
}


def lever_told(teller: Teller) -> Iterator[Told]:
    """Go through the steps of Zhukovsky's lever: the velocity plan turned, then what hangs on its ends, with arms."""
    for step in teller.scene.program.on("lever"):
        if step.verb == "pole":
            yield Told(step, _pole(teller, step), before=True)
        elif step.verb == "normal":
            segment = f"{teller.mark('velocity.p')}{teller.mark(step.operands[0])}"
            yield Told(step, teller.say("turned", segment=segment))
    hung: dict[str, list[Step]] = {}
    for step in moments_on_lever(teller.scene):
        hung.setdefault(step.operands[1], []).append(step)
    for mark, moments in hung.items():
        yield _hung(teller, mark, moments)
    yield from _balance(teller)


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
    point = teller.scene.mechanism.driver.point
    step = teller.reading.made.get(f"lever.{point}")
    if step is not None and step.verb == "normal":
        segment = f"{teller.mark('velocity.p')}{teller.mark(f'velocity.{point}')}"
        balance = teller.reading.made[hung_on_lever(teller.scene)[-1][0]]
        said = {"segment": segment, "vector": teller.scene.letter(balance.name)}
        yield Told(balance, teller.say("lever_balance", point=teller.mark(f"velocity.{point}"), **said))
