"""The plans of a linkage told step by step, in words, from the recorded program: for the explanatory note."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass

from ...plans.board import POSITION, Step
from ...scales.packaged import packaged
from .. import notes
from ..notes.blocks import Story
from ..printed import POINT, value_text
from .calculations.equations import is_given, size_of
from .calculations.kinematics import PLANS as KINEMATICS
from .calculations.kinematics import kinematics_lines
from .calculations.tables import printed_segment
from .calculations.vector_equations import ends_of, line_of
from .reading import Reading, read
from .scene import Scene

SET = ("pole", "place")  # verbs that set a drawing up
LETTERED = (POSITION, *KINEMATICS, "lever")  # plans whose marks have letters


def story(scene: Scene, texts: Mapping[str, str]) -> Story:
    """Return what the note of a linkage says: equations and steps of every plan, what balances the driver.

    Parameters
    ----------
    texts : mapping of str to str
        The sentences, by key.
    """
    lengths: set[str] = set()
    drawn = [plan for plan in KINEMATICS if plan in scene.scales]
    equations = {plan: kinematics_lines(scene, plan, lengths) for plan in drawn}
    views = ("equations_kinematics", *(f"equations_{plan}" for plan in drawn))
    return Story(told(scene, texts), equations, frozenset(views), tuple(_conclusions(scene, texts)))


def _conclusions(scene: Scene, texts: Mapping[str, str]) -> Iterator[str]:
    """Compare what balances the driver by the force plans and by the lever."""
    words, quantities = scene.words, scene.solved.quantities
    for name in ("M_bal", "F_bal"):
        by_plans, by_lever = quantities.get(name), quantities.get(f"{name}_lever")
        if by_plans is None or by_lever is None or not by_plans.value or by_lever.value is None:
            continue
        unit = words.unit(by_plans.unit)
        first, second = (f"{value_text(words, abs(item.value or 0.0))} {unit}" for item in (by_plans, by_lever))
        part = abs(by_plans.value - by_lever.value) / abs(by_plans.value)
        symbols = words.symbol(name), words.symbol(f"{name}_lever")
        yield texts["note.balance"].format(
            symbol=symbols[0], value=first, other=symbols[1], lever=second, part=words.number(100.0 * part, 2)
        )


def told(scene: Scene, texts: Mapping[str, str]) -> dict[str, list[str]]:
    """Return the steps of every plan that is drawn, in words, by the name of its view."""
    teller = Teller.of(scene, texts)
    return {plan: [text for _, text in teller.told(plan)] for plan in drawn_plans(scene)}


def drawn_plans(scene: Scene) -> list[str]:
    """Return the plans that are drawn and whose marks have letters."""
    plans = (plan for plan in scene.solved.program.plans if plan in scene.scales)
    return [plan for plan in plans if plan in LETTERED or plan.startswith("forces_")]


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
        return cls(scene, read(scene.solved.program), said)

    def told(self, plan: str) -> Iterator[tuple[Step, str]]:
        """Go through the steps of a plan that are told, each with its sentence."""
        for step in self.scene.solved.program:
            own = step.plan == plan and not step.name.startswith("_")
            if own and step.verb in TOLD and not (plan == "lever" and step.verb != "pole" and step.verb != "normal"):
                yield from ((step, text) for text in TOLD[step.verb](self, step))

    def say(self, key: str, **parts: str) -> str:
        """Return a sentence."""
        return self.texts[f"step.{key}"].format(**parts)

    def mark(self, name: str) -> str:
        """Return the letter of a mark."""
        return self.scene.words.mark(name)

    def vector(self, name: str) -> str:
        """Return the letter of a vector, with its bar."""
        return self.scene.words.symbol(name.lstrip("_"), bar=True)

    def distance(self, start: str, end: str) -> str:
        """Return the length of a segment on its plan, with its unit."""
        scale = self.scene.scales[end.rpartition(".")[0] or POSITION]
        size = abs(self.scene.solved.point(end) - self.scene.solved.point(start))
        return self._on_paper(size / scale.mu if size >= POINT * scale.mu else 0.0)

    def radius(self, name: str) -> str:
        """Return a length of the mechanism as it is taken into the compass."""
        return self._on_paper(size_of(self.scene, name) / self.scene.scales[POSITION].mu)

    def _on_paper(self, mm: float) -> str:
        words = self.scene.words
        return f"{words.number(words.display.segment(mm), 2)} {words.unit(words.display.paper)}"

    def line(self, direction: str, back: bool = False) -> str:
        """Return a line by its direction, with the sense in which a normal part is laid off."""
        text, made = line_of(self.scene, direction), self.reading.made.get(direction)
        if back and made is not None and made.verb in ("direction", "turn") and text.startswith("∥"):
            start, end = (self.mark(point) for point in ends_of(self.reading, direction))
            return f"{text} ({end} → {start})"
        return text

    def angle(self, direction: str) -> str:
        """Return the angle of the driver as the task gives it; nothing for other lines."""
        made = self.reading.made.get(direction)
        if made is None or made.verb != "turn" or not is_given(self.scene, name := made.operands[0]):
            return ""
        given = self.scene.givens.get(name)
        if given is None or isinstance(given.value, str):
            return ""
        words = self.scene.words
        value = f"{words.short(given.value)}{'°' if given.unit == 'deg' else words.unit(given.unit)}"
        return self.texts["step.angle"].format(symbol=words.symbol(name), value=value)


def _pole(teller: Teller, step: Step) -> Iterator[str]:
    lever = step.plan == "lever"
    yield teller.say("lever" if lever else "pole", point=teller.mark(step.name))


def _place(teller: Teller, step: Step) -> Iterator[str]:
    yield teller.say("place", point=teller.mark(step.name))


def _lay(teller: Teller, step: Step) -> Iterator[str]:
    """Laid off along a line: a link's length, or a vector; a zero vector is a point."""
    start, direction, _ = step.operands
    edge = teller.reading.between(start, step.name)
    a, b = teller.mark(start), teller.mark(step.name)
    if edge is not None and teller.scene.vanishes(edge.name):
        yield teller.say("zero", vector=teller.vector(edge.name), start=a, end=b)
        return
    parts = {"start": a, "segment": f"{a}{b}", "mm": teller.distance(start, step.name)}
    line = teller.line(direction, back=step.verb == "back")
    if edge is None:
        yield teller.say("lay", line=teller.angle(direction) or line, **parts)
    else:
        yield teller.say("vector", line=line, vector=teller.vector(edge.name), **parts)


def _chain(teller: Teller, step: Step) -> Iterator[str]:
    start, vector = step.operands
    a, b = teller.mark(start), teller.mark(step.name)
    if teller.scene.vanishes(vector):
        yield teller.say("zero", vector=teller.vector(vector), start=a, end=b)
    else:
        mm = teller.distance(start, step.name)
        yield teller.say("chain", start=a, segment=f"{a}{b}", mm=mm, vector=teller.vector(vector))


def _meet(teller: Teller, step: Step) -> Iterator[str]:
    p, u, q, w = step.operands
    first, second = (_through(teller, mark, line) for mark, line in ((p, u), (q, w)))
    yield teller.say("meet", first=first, second=second, point=teller.mark(step.name))


def _through(teller: Teller, mark: str, direction: str) -> str:
    """Return a line through a mark; one that is a guide needs no mark."""
    line = teller.line(direction)
    if mark.startswith("_"):
        return teller.say("guide", line=line.removeprefix("∥ "))
    return teller.say("through", line=line, point=teller.mark(mark))


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
        yield teller.say("on_link", point=s, link=f"{a}{b}", segment=f"{a}{s}", mm=teller.radius(part))
        return
    ratio = " : ".join(teller.scene.words.symbol(name.strip("_|")) for name in (part, whole))
    yield teller.say("divide", point=s, segment=f"{a}{b}", ratio=ratio)


def _similar(teller: Teller, step: Step) -> Iterator[str]:
    start, end, *_ = step.operands
    a, b, s = (teller.mark(mark) for mark in (start, end, step.name))
    key = "corner" if step.plan == POSITION else "similar"
    yield teller.say(key, point=s, segment=f"{a}{b}")


def _same(teller: Teller, step: Step) -> Iterator[str]:
    one, other = teller.mark(step.name), teller.mark(step.operands[0])
    if one != other:
        yield teller.say("same", point=one, other=other)


def _read(teller: Teller, step: Step) -> Iterator[str]:
    """A vector that is measured, not laid off: its millimetres times the scale factor."""
    tail, tip = step.operands
    edge = teller.reading.between(tail, tip)
    if edge is None or edge.name != step.name or teller.reading.is_hung(edge):
        return
    words = teller.scene.words
    segment = f"{teller.mark(tail)}{teller.mark(tip)}"
    item = teller.scene.solved.quantities.get(step.name)
    if item is None:
        return
    if size_of(teller.scene, step.name) == 0.0:
        yield teller.say("point", segment=segment, symbol=words.symbol(step.name))
        return
    mm, number, value = printed_segment(teller.scene, item)
    sign = "/" if words.per_unit else "·"
    result = f"{value} {words.unit(words.display.unit(item.unit))}"
    shown = f"{mm} {words.unit(words.display.paper)}"
    symbol, worth = words.symbol(step.name), f"{mm}{sign}{number}"
    yield teller.say("read", segment=segment, mm=shown, symbol=symbol, sum=worth, value=result)


def _turned(teller: Teller, step: Step) -> Iterator[str]:
    """A mark of the lever: the end of a velocity that is turned."""
    if step.plan == "lever":
        yield teller.say("turned", segment=f"{teller.mark('velocity.p')}{teller.mark(step.operands[0])}")


def _template(teller: Teller, step: Step) -> Iterator[str]:
    yield teller.say("template", point=teller.mark(step.name))


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
    "normal": _turned,
    "template": _template,
}
