"""Plans told step by step in words: points, ends of vectors, where lines and arcs meet, templates, the lever."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import NamedTuple

from ...plans.board import POSITION, Step
from ...plans.linkages.legs import guide_letters
from ...plans.linkages.mechanism import positive
from ...plans.names import ORIGIN, role
from ...plans.quantities import Quantity
from ...scales.packaged import packaged
from .. import notes
from ..notes.blocks import REFERS
from ..printed import POINT, Input, Symbol, as_printed, calculation, recomputes, ruler_decimals, segment_text
from .calculations import equations
from .calculations.forces import Couple, couples_on_lever, found_by, hung_on_lever, letter_of, moments_on_lever
from .reading import ends_of
from .scene import NORMAL_TO, Scene, sided

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
class Teller(Scene):
    """A scene whose steps are told in the sentences of one language."""

    texts: Mapping[str, str] = field(kw_only=True)

    @classmethod
    def of(cls, scene: Scene, texts: Mapping[str, str] | None = None) -> Teller:
        """Return a scene with these sentences, or with those of its own language."""
        sentences = texts or packaged(notes.__name__, "texts", scene.words.language)
        return cls(scene.solved, scene.words, scene.style, scene.givens, scene.scales, texts=sentences)

    def say(self, key: str, **parts: str) -> str:
        """Return a sentence."""
        return self.texts[f"step.{key}"].format(**parts)

    def mark(self, name: str) -> str:
        """Return the letter of a mark."""
        return self.words.mark(name)

    def lettered(self, letters: str, name: str, plan: str) -> str:
        """Return a segment by its letters with the length at which it is drawn; lengths may have the same letters."""
        text = self.drawn(name, plan)
        return text if text.startswith((f"{letters}/", f"{letters}·")) else f"{letters} = {text}"

    def given_by(self, name: str) -> str:
        """Return what refers to the equation of a quantity."""
        return REFERS.format(self.words.symbol(role(name).shown))

    def drawn(self, name: str, plan: str = POSITION) -> str:
        """Return how long a quantity is drawn on a plan: by its scale factor, with the numbers put in."""
        words, scale = self.words, self.scales[plan]
        if role(name).hidden and role(name).shown not in self.quantities:
            return self.on_paper(equations.size_of(self, name) / scale.mu)
        value, mu = equations.factor(self, name), equations.paper(words, scale)
        length = equations.Product((value, replace(mu, power=-mu.power)))
        inputs = [Input(value.value, value.exact, fixed=True, told=value.told), Input(mu.value, exact=True, fixed=True)]
        places = ruler_decimals(words, length.of([value.value, mu.value]))
        texts, result = calculation(words, lambda *x: length.of(x), inputs, places)
        unit, item = words.unit(words.display.paper), self.quantities.get(role(name).shown)
        printed, by, _ = ("", "", "") if item is None else equations.printed_segment(self, item, plan)
        if item is None or not printed or by != words.short(mu.value):  # or it is longer, in a detail
            printed = result
        elif not recomputes(as_printed(lambda *x: length.of(x), inputs), printed):  # the other way round it does
            product = f"{printed}{'/' if words.per_unit else '·'}{by} = {value.told or texts[0]}"
            return f"{length.in_letters} = {printed} {unit} ({product} {words.unit(words.display.unit(item.unit))})"
        return f"{length.in_letters} = {length.of([*map(Symbol.of, texts)])} = {printed} {unit}"

    def on_paper(self, mm: float) -> str:
        """Return a length on paper with its unit."""
        words = self.words
        return f"{segment_text(words, words.display.segment(mm))} {words.unit(words.display.paper)}"

    def apart(self, one: str, other: str) -> str:
        """Return how far two points of the mechanism are drawn from one another."""
        size = abs(self.mm(one) - self.mm(other))
        return self.on_paper(size if size >= POINT else 0.0)

    def across(self, arm: str) -> str:
        """Return how long an arm of the lever is drawn, 0 where there is none."""
        if not self.defined(arm) or equations.size_of(self, arm) == 0.0:
            return "0"
        return f"{self.segment(arm)} {self.words.unit(self.words.display.paper)}"

    def between(self, couple: Couple) -> str:
        """Return how long the arm of a couple on the lever is drawn."""
        return f"{self.length(couple.arm(self) / self.scales['lever'].mu)} {self.words.unit(self.words.display.paper)}"

    def place(self, name: str) -> str:
        """Return the coordinates at which a point of the frame is drawn."""
        words, at = self.words, self.mm(name)
        x, y = (words.short(round(words.display.segment(part), 2)) for part in (at.real, at.imag))
        return self.say("coordinates", x=x, y=y, unit=words.unit(words.display.paper))

    def read_off(self, item: Quantity) -> dict[str, str]:
        """Return what a segment of a plan is read as: its mm, their product with the scale factor, the value.

        Of one that is too short to be read there are no mm.
        """
        words = self.words
        mm, number, value = equations.printed_segment(self, item)
        parts = {
            "mm": f"{mm} {words.unit(words.display.paper)}" if mm else "",
            "sum": f"{mm}{'/' if words.per_unit else '·'}{number}",
        }
        return {**parts, "value": f"{value} {words.unit(words.display.unit(item.unit))}"}

    def sense(self, rate: str) -> str:
        """Return in which sense a link turns, or turns ever faster."""
        return equations.sensed(self.words, equations.rate_of(self, rate))

    def line(self, direction: str, back: bool = False) -> str:
        """Return how a line lies, in words, with the sense in which a normal part is laid off."""
        (sign, letters), made = sided(self, direction), self.made.get(direction)
        if sign == NORMAL_TO:
            return self.say("normal_to", line=letters)
        if back and made is not None and made.verb in ("direction", "turn"):
            start, end = (self.mark(point) for point in ends_of(self.reading, direction))
            return self.say("parallel_from", line=letters, start=end, end=start)
        return self.say("parallel_to", line=letters)

    def plain_line(self, direction: str) -> str:
        """Return a line by its letters alone, such as a guide."""
        sign, letters = sided(self, direction)
        return letters if sign != NORMAL_TO else self.line(direction)

    def through(self, mark: str, direction: str) -> str:
        """Return a line through a mark; one that is a guide needs no mark."""
        if role(mark).hidden:
            return self.say("guide", line=self.plain_line(direction))
        return self.say("through", line=self.line(direction), point=self.mark(mark))

    def angle(self, direction: str) -> str:
        """Return the angle of the driver as the task gives it; nothing for other lines."""
        made = self.made.get(direction)
        name, words = made.operands[0] if made is not None and made.verb == "turn" else "", self.words
        given = self.givens.get(name) if equations.is_given(self, name) else None
        if given is None or isinstance(given.value, str):
            return ""
        value = f"{words.short(given.value)}{'°' if given.unit == 'deg' else words.unit(given.unit)}"
        return self.say("angle", symbol=words.symbol(name), value=value)

    def along(self, vector: str) -> str:
        """Return how a vector that is hung on others lies, by the law that gives it; nothing where that is said so."""
        made = self.made.get(vector)
        if made is None:
            return ""
        if made.verb == "read":  # laid off along a line on another plan
            laid = self.made[made.operands[1]]
            own = laid.verb in ("lay", "back") and laid.operands[0] == made.operands[0]
            return self.line(laid.operands[1], back=laid.verb == "back") if own else ""
        match made.law:
            case "transport_speed" | "transport_tangential" | "transport_normal":  # of a turn about a pin
                pin, point = (self.mark(mark) for mark in self.made[made.operands[1]].operands)
                if made.law == "transport_normal":
                    return self.say("parallel_from", line=f"{pin}{point}", start=point, end=pin)
                across = self.say("normal_to", line=f"{pin}{point}")
                return self.say("in_sense", line=across, rate=self.words.symbol(made.operands[0]))
            case "coriolis":
                rate, turned = made.operands
                return self.say("turned_by", vector=self.letter(turned), rate=self.words.symbol(rate))
            case "inertia_force" | "resisting_force" | "resisting_along":
                return self.say("against", motion=self.letter(made.operands[1]))
            case "weight":
                return self.say("down")
            case "along":
                return self._given(made)
        return ""

    def _given(self, made: Step) -> str:
        """Return the line of a load: that of the plan along which it acts, or its angle."""
        line = self.made.get(made.operands[1])
        if line is not None and line.verb != "turn":
            return self.line(made.operands[1])
        angle = math.degrees(cmath.phase(complex(self.values[made.name]))) % 360.0
        down = abs(angle - DOWN) < 1e-9
        return self.say("down") if down else self.say("inclined", angle=self.words.short(round(angle, 2)))


def _place(teller: Teller, step: Step) -> str:
    guide, letters, place = role(step.name).of, guide_letters(teller.program), teller.place(step.name)
    if not role(step.name).hidden:
        return teller.say("place", point=teller.mark(step.name), place=place)
    if role(step.name).kind != ORIGIN or guide not in letters:
        return ""
    angle = _degrees(teller, cmath.phase(complex(teller.values[guide])))
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
    if edge is not None and teller.vanishes(edge.name):
        return teller.say("zero", vector=teller.letter(edge.name), start=a, end=b)
    parts = {"start": a, "length": teller.lettered(f"{a}{b}", size, step.plan)}
    if edge is None:  # on the mechanism, along the line on which it begins
        sign, letters = sided(teller, direction)
        line = teller.say("along", line=letters) if sign != NORMAL_TO and a in letters else line
        return teller.say("lay", line=teller.angle(direction) or line, **parts)
    return teller.say("vector", line=line, vector=teller.letter(edge.name), by=teller.given_by(edge.name), **parts)


def _chain(teller: Teller, step: Step) -> str:
    start, vector = step.operands
    a, b = teller.mark(start), teller.mark(step.name)
    if teller.vanishes(vector):
        return teller.say("zero", vector=teller.letter(vector), start=a, end=b)
    line, letter, made = teller.along(vector), teller.letter(vector), teller.made.get(vector)
    if made is not None and made.law == "opposite":  # a reaction, and the one that it answers
        letter = f"{letter} = −{teller.letter(made.operands[0])}"
    parts = {"length": teller.lettered(f"{a}{b}", vector, step.plan), "vector": letter, "by": teller.given_by(vector)}
    return teller.say("vector", start=a, line=line, **parts) if line else teller.say("chain", start=a, **parts)


def _similar(teller: Teller, step: Step) -> str:
    """The third point of a link: on the mechanism by its distances from two others, on a plan by similarity."""
    start, end, *_ = step.operands
    a, b, s = (teller.mark(mark) for mark in (start, end, step.name))
    if step.plan == POSITION:
        one, other = (teller.apart(mark, step.name) for mark in (start, end))
        return teller.say("corner", point=s, segment=f"{a}{b}", first=f"{a}{s}", one=one, second=f"{b}{s}", other=other)
    plan, link = equations.triangles(teller, step)
    return teller.say("similar", point=s, segment=f"{a}{b}", plan=plan, link=link)


def _read(teller: Teller, step: Step) -> str:
    tail, tip = step.operands
    edge = teller.reading.between(tail, tip)
    if edge is None or edge.name != step.name or teller.reading.is_hung(edge):
        return ""
    name = role(step.name).shown  # a force that balances has an intermediate vector
    item = teller.quantities.get(name)
    if item is None:
        return ""
    start, end, symbol = teller.mark(tail), teller.mark(tip), teller.words.symbol(name)
    if equations.size_of(teller, name) == 0.0:
        return teller.say("point", start=start, end=end, symbol=symbol)
    read = teller.read_off(item)
    told = teller.say("read" if read["mm"] else "read_short", segment=f"{start}{end}", symbol=symbol, **read)
    return told + "".join(_turns(teller, step, user) for user in teller.reading.users(step.name))


def _turns(teller: Teller, step: Step, user: Step) -> str:
    """Return how the sense of a rate follows from the vector that it is read from."""
    vector, rate = role(step.name), role(user.name)
    if user.law != "turning" or not vector.about or not rate.of.isdigit() or not equations.rate_of(teller, user.name):
        return ""
    ends = {"point": teller.mark(vector.of), "centre": teller.mark(vector.about), "link": rate.of}
    symbol, sense = teller.words.symbol(user.name), teller.sense(user.name)
    by = teller.given_by(user.name)
    return teller.say("turns", vector=teller.letter(step.name), rate=symbol, sense=sense, by=by, **ends)


def _template(teller: Teller, step: Step) -> str:
    """A joint of a link of which a template is laid on the paths of its joints, told with the first of them."""
    joint, *where = step.operands
    laid = [other for other in teller.program.which(("template",)) if [*other.operands[1:]] == where]
    if laid[0].name != step.name:
        return teller.say("template_more", point=teller.mark(step.name))
    names = {other.operands[0]: teller.mark(other.name) for other in laid}
    paths = []
    for i in range(FIRST_PATH, len(step.operands), OF_PATH):
        own, start, radius, direction = step.operands[i : i + OF_PATH]
        if (size := equations.size_of(teller, radius)) == 0.0:
            paths.append(teller.say("path_line", point=names[own], line=teller.plain_line(direction)))
        else:
            mm = teller.on_paper(size / teller.scales[POSITION].mu)
            paths.append(teller.say("path_arc", point=names[own], centre=teller.mark(start), mm=mm))
    return teller.say("template", link="".join(names.values()), paths=", ".join(paths), point=names[joint])


def _incline(teller: Teller, step: Step) -> str:
    letters, values, base = guide_letters(teller.program), teller.values, step.operands[0]
    if step.name not in letters:
        return ""
    turn, own = (cmath.phase(complex(values[name])) for name in (step.name, base))
    said = {"line": letters[step.name], "base": teller.plain_line(base)}
    return teller.say("guide_on_link", angle=_degrees(teller, turn - own), **said)


def _degrees(teller: Teller, angle: float) -> str:
    return f"{teller.words.short(round(math.degrees(angle) % 180.0, 2) % 180.0)}°"


TOLD: Mapping[str, Callable[[Teller, Step], str]] = {
    **{"place": _place, "lay": _lay, "back": _lay, "chain": _chain, "similar": _similar},
    **{"read": _read, "incline": _incline, "template": _template},
}


def tell(teller: Teller, step: Step) -> str:
    """Return the sentence that tells a step, nothing where none does."""
    if step.verb in TOLD:
        return TOLD[step.verb](teller, step)
    say, mark, drawn, point = teller.say, teller.mark, teller.drawn, step.name
    match (step.verb, *step.operands):
        case ("pole",):
            return say("lever" if step.plan == "lever" else "pole", point=mark(point))
        case "meet", p, u, q, w:
            by = REFERS.format(" ".join(found_by(teller, step)))
            return say("meet", first=teller.through(p, u), second=teller.through(q, w), point=mark(point), by=by)
        case "arc", centre, radius, start, along, _:
            line = teller.through(start, along)
            return say("arc", line=line, centre=mark(centre), mm=drawn(radius), point=mark(point))
        case "arcs", first, radius, second, other, _:
            ends = {"first": mark(first), "second": mark(second), "point": mark(point)}
            return say("arcs", one=drawn(radius), other=drawn(other), **ends)
        case "divide", start, end, part, whole:  # on the mechanism by its distance, on a plan by similarity
            a, b, s = map(mark, (start, end, point))
            beyond = "" if positive(part) == part else "_beyond"  # as of a second crank, across the shaft
            if step.plan == POSITION:
                length = teller.lettered(f"{a}{s}", positive(part), POSITION)
                return say(f"on_link{beyond}", point=s, link=f"{a}{b}", start=a, length=length)
            ratio = " : ".join(teller.words.symbol(role(positive(name)).shown) for name in (part, whole))
            return say(f"divide{beyond}", point=s, segment=f"{a}{b}", start=a, ratio=ratio)
        case "same", other if mark(other) != mark(point) and not role(point).hidden:
            return say("same", point=mark(point), other=mark(other))
        case "tangent", centre, end, offset, *_:
            a, b = mark(centre), mark(end)
            if equations.size_of(teller, offset) == 0.0:
                return say("joined", line=f"{a}{b}", start=a, end=b)
            return say("tangent", line=teller.line(point), centre=a, mm=drawn(offset), point=b)
    return ""


def lever_told(teller: Teller) -> Iterator[Told]:
    """Go through the steps of Zhukovsky's lever: the velocity plan turned, then what hangs on its ends, with arms."""
    mark, pole = teller.mark, teller.mark("velocity.p")
    for step in teller.program.on("lever"):
        if step.verb == "pole":
            yield Told(step, tell(teller, step), before=True)
        elif step.verb == "normal":
            yield Told(step, teller.say("turned", segment=f"{pole}{mark(step.operands[0])}"))
    couples = couples_on_lever(teller)
    paired = {moment for couple in couples.values() for moment in couple.moments}
    hung: dict[str, list[Step]] = {}
    for step in (step for step in moments_on_lever(teller) if step.name not in paired):
        hung.setdefault(step.operands[1], []).append(step)
    for end, moments in hung.items():
        arms = [user.name for moment in moments for user in teller.reading.users(moment.name) if user.verb == "arm"]
        listed = ", ".join(f"{teller.words.symbol(arm)} = {teller.across(arm)}" for arm in arms)
        forces = ", ".join(teller.letter(moment.operands[0]) for moment in moments)
        yield Told(moments[0], teller.say("lever_forces", point=letter_of(teller, end), forces=forces, arms=listed))
    for moment, couple in couples.items():
        letters = couple.letters(teller)
        arm = f"{''.join(letters)} = {teller.between(couple)}"
        parts = {"points": ", ".join(letters), "forces": ", ".join(map(teller.letter, couple.forces)), "arms": arm}
        yield Told(teller.made[moment], teller.say("lever_couple", **parts))
    driven = f"velocity.{teller.mechanism.driver.point}"
    turned = teller.made.get(f"lever.{teller.mechanism.driver.point}")
    if turned is not None and turned.verb == "normal":
        balance = teller.made[hung_on_lever(teller)[-1][0]]
        parts = {"segment": f"{pole}{mark(driven)}", "vector": teller.letter(balance.name), "point": mark(driven)}
        yield Told(balance, teller.say("lever_balance", **parts))
