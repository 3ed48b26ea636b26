"""Who tells the steps of a linkage's plans: the words of one language for segments, lines and vectors."""

from __future__ import annotations

import cmath
import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

from ....plans.board import POSITION, Step
from ....plans.names import role
from ....scales.packaged import packaged
from ... import notes
from ...printed import HUNDREDTHS, POINT, Input, Symbol, calculation
from ..calculations.equations import Product, ends_of, factor, is_given, line_of, paper, size_of
from ..figures.inset import At, figures_of
from ..reading import Reading
from ..scene import Scene

DOWN = 270.0  # degrees


@dataclass(frozen=True, slots=True)
class Told:
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
    figures: Mapping[str, tuple[At, ...]]  # of compound motion, by the name of the view

    @classmethod
    def of(cls, scene: Scene, texts: Mapping[str, str] | None = None) -> Teller:
        """Return who tells the steps of a linkage; the words of the scene's language where no `texts` are said."""
        said = packaged(notes.__name__, "texts", scene.words.language) if texts is None else texts
        return cls(scene, scene.reading, said, figures_of(scene))

    def say(self, key: str, **parts: str) -> str:
        """Return a sentence."""
        return self.texts[f"step.{key}"].format(**parts)

    def mark(self, name: str) -> str:
        """Return the letter of a mark."""
        return self.scene.words.mark(name)

    def distance(self, start: str, end: str) -> str:
        """Return the length of a segment on its plan, with its unit."""
        scale = self.scene.scales[role(end).plan]
        size = abs(self.scene.solved.point(end) - self.scene.solved.point(start))
        return self.on_paper(size / scale.mu if size >= POINT * scale.mu else 0.0)

    def radius(self, name: str) -> str:
        """Return a length of the mechanism as it is taken into the compass."""
        return self.drawn(name, POSITION)

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
        return (
            f"{length.in_letters} = {length.of([*map(Symbol.of, texts)])} = {result} {words.unit(words.display.paper)}"
        )

    def on_paper(self, mm: float) -> str:
        """Return a length on paper with its unit."""
        words = self.scene.words
        return f"{words.number(words.display.segment(mm), 2)} {words.unit(words.display.paper)}"

    def place(self, mark: str) -> str:
        """Return the coordinates of a mark of the mechanism on paper."""
        words, at = self.scene.words, self.scene.mm(mark)
        x, y = (words.short(round(words.display.segment(part), 2)) for part in (at.real, at.imag))
        return self.say("coordinates", x=x, y=y, unit=words.unit(words.display.paper))

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
        if made is None or made.verb != "turn" or not is_given(self.scene, name := made.operands[0]):
            return ""
        given = self.scene.givens.get(name)
        if given is None or isinstance(given.value, str):
            return ""
        words = self.scene.words
        value = f"{words.short(given.value)}{'°' if given.unit == 'deg' else words.unit(given.unit)}"
        return self.say("angle", symbol=words.symbol(name), value=value)

    def hung(self, vector: str) -> str:
        """Return the letter of a vector that is hung on others; of a reaction the one that it answers, too."""
        made, letter = self.reading.made.get(vector), self.scene.letter(vector)
        return (
            letter if made is None or made.law != "opposite" else f"{letter} = −{self.scene.letter(made.operands[0])}"
        )

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
            case "transport_speed" | "transport_tangential" | "transport_normal":
                return self._on_arm(made)
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

    def _on_arm(self, made: Step) -> str:
        """Return the line of a part of a turn about a pin: normal to its arm, or along it towards the pin."""
        arm = self.reading.made[made.operands[1]]
        pin, point = (self.mark(mark) for mark in arm.operands)
        if made.law == "transport_normal":
            return f"∥ {pin}{point} ({point} → {pin})"
        return self.say("in_sense", line=f"⊥ {pin}{point}", rate=self.scene.words.symbol(made.operands[0]))

    def _given(self, made: Step) -> str:
        """Return the line of a load: that of the plan along which it acts, or its angle."""
        line = self.reading.made.get(made.operands[1])
        if line is not None and line.verb != "turn":
            return self.line(made.operands[1])
        angle = math.degrees(cmath.phase(complex(self.scene.solved.values[made.name]))) % 360.0
        down = abs(angle - DOWN) < 1e-9
        return self.say("down") if down else self.say("inclined", angle=self.scene.words.short(round(angle, 2)))
