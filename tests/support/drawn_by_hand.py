"""A student's sheet, drawn with plain complex numbers in millimetres of paper: hand, calculator, what is written down.

It shares nothing with the package: what it draws judges how the package marks.
"""

from __future__ import annotations

import cmath
import math
import random
from dataclasses import dataclass, field
from itertools import pairwise

POINT, DIRECTION, READING = 0.25, 0.5, 0.25  # rms of a usual hand: mm a coordinate, degrees, mm of a length
GRID = 0.5  # mm and degrees to which a ruler and a protractor are read


@dataclass(frozen=True, slots=True)
class Slip:
    """A mistake: its number in the list of mistakes, and where it is made; `way` is which of several ways."""

    id: str
    at: str = ""
    way: str = ""


class Hand:
    """Pencil, protractor, ruler and calculator; without dice all of them are exact, in SI to a scale of 1."""

    def __init__(self, dice: random.Random | None = None) -> None:
        self.dice = dice
        self.digits = dice.choice((3, 4)) if dice else 0

    def _gauss(self, rms: float) -> float:
        return self.dice.gauss(0.0, rms) if self.dice else 0.0

    def spot(self, z: complex) -> complex:
        return z + complex(self._gauss(POINT), self._gauss(POINT))

    def ray(self, along: complex) -> complex:
        """Return the unit direction of a line drawn parallel to `along`; of nothing at all the x axis."""
        size = abs(along)
        return cmath.rect(1.0, math.radians(self._gauss(DIRECTION))) * (along / size if size else 1.0)

    def lay(self, start: complex, along: complex, mm: float) -> complex:
        """Lay off a length."""
        return self.spot(start + self.ray(along) * (mm + self._gauss(READING) if mm else 0.0))

    def cross(self, p: complex, u: complex, q: complex, w: complex) -> complex:
        """Mark where the line through p along u crosses the line through q along w."""
        u, w = self.ray(u), self.ray(w)
        p, q = p + 1j * u * self._gauss(POINT), q + 1j * w * self._gauss(POINT)
        return self.spot(p + u * (turn(q - p, w) / turn(u, w)))

    def arc(self, centre: complex, radius: float, q: complex, w: complex, side: int) -> complex:
        """Mark where the circle crosses the line through q along w, the forward crossing for side = 1."""
        w, radius = self.ray(w), radius + self._gauss(READING)
        q = q + 1j * w * self._gauss(POINT)
        foot = q + w * ((centre - q) * w.conjugate()).real
        return self.spot(foot + w * (side * math.sqrt(radius**2 - abs(foot - centre) ** 2)))

    def arcs(self, a: complex, r: float, b: complex, s: float, side: int) -> complex:
        """Mark where two circles cross, to the left of a -> b for side = 1."""
        r, s = r + self._gauss(READING), s + self._gauss(READING)
        way = b - a
        along = (abs(way) ** 2 + r * r - s * s) / (2.0 * abs(way))
        return self.spot(a + way / abs(way) * complex(along, side * math.sqrt(r * r - along * along)))

    def length(self, p: complex, q: complex) -> float:
        return abs(self._grid(abs(q - p) + self._gauss(READING)))

    def arm(self, about: complex, at: complex, along: complex) -> float:
        """Measure the arm of a force along a line drawn through `at`, mm, signed by the sense of its moment."""
        drawn = turn(self.spot(at) - about, self.ray(along))
        return math.copysign(abs(self._grid(abs(drawn) + self._gauss(READING))), drawn)

    def degrees(self, vector: complex) -> float:
        return self._grid(math.degrees(cmath.phase(vector)) + self._gauss(DIRECTION)) % 360.0

    def _grid(self, x: float) -> float:
        return round(x / GRID) * GRID if self.dice else x

    def number(self, x: float) -> float:
        return float(f"{x:.{self.digits}g}") if self.dice else x


def turn(a: complex, b: complex) -> float:
    return (a.conjugate() * b).imag


@dataclass(slots=True)
class Line:
    """What is written of one quantity: mm of paper, value in SI (of a vector its size), degrees of a vector."""

    value: float
    mm: float | None = None
    degrees: float | None = None
    vector: complex | None = None  # as drawn, SI


def named_value(name: str) -> bool:
    """Whether the value of an arm is written, not its millimetres alone: not on the lever."""
    return not name.startswith("h_lever")


def transposed(x: float) -> float:
    """Return a number with the first two neighbouring digits that differ exchanged."""
    text = f"{x:.4g}"
    digits = [i for i, c in enumerate(text.partition("e")[0]) if c.isdigit()]
    pairs = [(i, k) for i, k in pairwise(digits) if text[i] != text[k]]
    for i, k in sorted(pairs, key=lambda pair: text[pair[1]] == "0" and pair[0] == digits[0]):
        if float(text):
            return float(text[:i] + text[k] + text[i + 1 : k] + text[i] + text[k + 1 :])
    return x


@dataclass(slots=True)
class Sheet:
    """One student's work: the scale factors by plan, SI per mm, and the lines by quantity."""

    hand: Hand
    givens: dict[str, float]
    slips: tuple[Slip, ...] = ()
    mus: dict[str, float] = field(default_factory=dict)
    elsewhere: Sheet | None = None  # the same student's next position
    lines: dict[str, Line] = field(default_factory=dict)
    plans: dict[str, str] = field(default_factory=dict)  # on which plan a line is measured

    def slip(self, id: str, at: str = "") -> Slip | None:
        return next((s for s in self.slips if s.id == id and s.at in ("", at)), None)

    def mu(self, plan: str) -> float:
        return self.mus.get(plan, 1.0)

    def size(self, name: str) -> float:
        return self.lines[name].value

    def vector(self, name: str) -> complex:
        """Return a force as it is gone on with: the size that is written, along what is drawn."""
        line = self.lines[name]
        assert line.vector is not None
        return line.vector / abs(line.vector) * line.value if line.vector else 0j

    def write(self, name: str, value: float, mm: float | None = None, vector: complex | None = None) -> float:
        """Write a line down; return its value."""
        value = self.hand.number(value)
        if self.slip("M123", name):
            value = transposed(value)
        degrees = None if vector is None else self.hand.degrees(vector)
        self.lines[name] = Line(value, mm, degrees, vector)
        return value

    def calculated(self, name: str, plan: str, value: float, vector: complex) -> float:
        """Write down a vector that is calculated, and will be laid off."""
        value = self.write(name, value, None, vector)
        self.on_paper(name, plan)
        return value

    def read(self, name: str, plan: str, tail: complex, tip: complex) -> float:
        """Measure a segment of a plan and write its value down."""
        self.plans[name] = plan
        if self.slip("M22", name) and self.elsewhere:
            there = self.elsewhere.lines[name].vector or 0j
            tail, tip = 0j, there / self.mu(plan)
        mm, mu = self.hand.length(tail, tip), self.mu(plan)
        if self.slip("M20", name):
            mm /= 10.0
        value = mm * mu
        if self.slip("M14", plan):
            value = mm / mu
        for id in ("M15", "M74"):
            if other := self.slip(id, plan):
                value = mm * self.mu(other.way)
        if self.slip("M56", name):
            there = self.lines["V" + name[1:]]
            mm, tail, tip = there.mm or 0.0, 0j, (there.vector or 0j) / mu
            value = mm * mu
        return self.write(name, value, mm, (tip - tail) * mu)

    def arm(self, name: str, plan: str, about: complex, at: complex, along: complex) -> float:
        """Measure an arm and write it down; return it in SI, signed by the sense of the moment."""
        if self.slip("M66", name) or self.slip("M120", name):
            sign = math.copysign(1.0, turn(at - about, along))
            mm = sign * self.hand.length(about, at)
        else:
            mm = self.hand.arm(about, at, along)
        self.plans[name] = plan
        value = self.write(name, abs(mm) * self.mu(plan), abs(mm))
        if not named_value(name):
            value = abs(mm) * self.mu(plan)  # who writes millimetres alone goes on with them
        return math.copysign(value, mm)

    def rate(self, name: str, of: str, length: float, mm: float, sense: float) -> float:
        """Calculate an angular velocity or acceleration from a velocity or tangential acceleration."""
        for id in ("M28", "M43", "M44"):
            if other := self.slip(id, name):
                of = other.way
        if wrong := self.slip("M117", name):
            length = self.givens[wrong.way]
        if self.slip("M17", name):
            length = mm  # the millimetres of the drawing as they are
        sense = math.copysign(1.0, sense) * (-1.0 if self.slip("M29", name) or self.slip("M45", name) else 1.0)
        return self.write(name, sense * self.size(of) / length)

    def normal(self, name: str, of: str, length: float, omega: float, mm: float) -> float:
        """Calculate a normal part of acceleration from the velocity that was read, v^2 / l."""
        speed, other = self.size(of), self.slip("M40", name)
        if other:
            speed = abs(self.size(other.way)) * (length if other.way == "omega_1" else 1.0)
        value = speed * speed / length
        if self.slip("M39", name) or self.slip("M47", name) or (self.slip("M54", name) and self.way("M54") == "none"):
            value = 0.0
        if wrong := self.slip("M41", name):
            value = speed / length if wrong.way == "v/l" else speed * length
        if self.slip("M115", name):
            value = abs(omega) * length
        if self.slip("M116", name):
            value = omega * omega
        if self.slip("M16", name):
            value = (self.lines[of].mm or 0.0) ** 2 / mm * self.mu("acceleration")
        return value

    def outward(self, name: str) -> float:
        """Return 1 where a normal part is drawn away from its centre, else -1."""
        away = self.slip("M38", name) or (self.slip("M54", name) and self.way("M54") == "away")
        return 1.0 if away else -1.0

    def way(self, id: str) -> str:
        return next(s.way for s in self.slips if s.id == id)

    def meet(self, plan: str, name: str, p: complex, u: complex, q: complex, w: complex) -> complex:
        """Mark the end of a relative vector from p across u (a link), on a line through q along w."""
        u = u if self.slip({"velocity": "M25", "acceleration": "M42"}[plan], name) else 1j * u
        if self.slip("M27", f"{plan} {name}"):
            w = 1j * w
        if self.slip({"velocity": "M26", "acceleration": "M121"}[plan], name):
            p, q = q, p
        return self.hand.cross(p, u, q, w)

    def divided(self, plan: str, name: str, p: complex, q: complex, part: float) -> complex:
        """Mark the centre of mass of a link on its image."""
        wrong = self.slip("M30", name) if plan == "velocity" else self.slip("M55", name)
        if wrong:
            part = 1.0 - part
        if self.slip("M31", f"{plan} {name}"):
            part = 0.5
        return self.hand.lay(p, q - p, self.hand.length(p, q) * part)

    def inertia(self, name: str, mass: float, of: str) -> complex:
        """Calculate a force of inertia; return it."""
        if self.slip("M63", name):
            mass *= 9.81
        if other := self.slip("M122", name):
            of = other.way
        along = self.lines[of].vector or 0j
        self.write(name, mass * self.size(of), None, along if self.slip("M57", name) else -along)
        return self.vector(name)

    def on_paper(self, name: str, plan: str) -> None:
        """Write down to what length a known force is drawn."""
        self.plans[name] = plan
        line = self.lines[name]
        line.mm = line.value / self.mu(plan)
        if self.hand.dice:
            line.mm = round(line.mm, 1) if abs(line.mm) >= 1.0 else float(f"{line.mm:.2g}")

    def chain(self, plan: str, start: complex, *names: str) -> complex:
        """Hang known forces on one another; return the end."""
        for name in names:
            force = self.vector(name)
            if self.slip("M58", name):
                continue
            along = -force if self.slip("M59", name) else force
            start = self.hand.lay(start, along, abs(force) / self.mu(plan))
        return start


def moment_sum(sheet: Sheet, name: str, forces: list[tuple[str, float]], couples: list[str]) -> float:
    """Return the moments of forces (name, arm with the sign of the moment) and couples."""
    whole = 0.0
    for force, arm in forces:
        part = sheet.size(force) * arm
        whole += -part if sheet.slip("M118", f"{name} {force}") else part
    for couple in couples:
        if wrong := sheet.slip("M60", couple):
            whole += 0.0 if wrong.way == "none" else -sheet.size(couple)
        else:
            whole += sheet.size(couple)
    return whole


def tangential(sheet: Sheet, name: str, whole: float, length: float, plan: str, normal: complex) -> complex:
    """Write a tangential reaction down; return it as a vector in mm of the force plan."""
    size = whole / length * (-1.0 if sheet.slip("M69", name) else 1.0)
    along = normal * math.copysign(1.0, size)
    sheet.calculated(name, plan, abs(size), along)
    return along / abs(along) * (sheet.size(name) / sheet.mu(plan))


def reaction(sheet: Sheet, name: str, plan: str, tail: complex, tip: complex) -> complex:
    """Read a reaction off the force plan; return it."""
    if sheet.slip("M75", name):
        tail, tip = tip, tail
    sheet.read(name, plan, tail, tip)
    if wrong := sheet.slip("M70", name):
        sheet.lines[name] = sheet.lines[wrong.way]
    return sheet.vector(name)


def opposite(sheet: Sheet, name: str, of: str, plan: str = "") -> complex:
    """Write down the reaction opposite to another."""
    line = sheet.lines[of]
    vector = (line.vector or 0j) * (1.0 if sheet.slip("M71", name) else -1.0)
    sheet.write(name, line.value, None, vector)
    if plan:
        sheet.on_paper(name, plan)
    return sheet.vector(name)


def lever_arm(sheet: Sheet, force: str, along: complex, v: complex, name: str = "") -> float:
    """Return the moment of a force on the turned plan; v is its point in mm of the velocity plan."""
    if not along:
        return 0.0
    at = v if sheet.slip("M77") else 1j * v
    return abs(along) * sheet.arm(name or f"h_lever_{force}", "velocity", 0j, at, along)


def lever_couple(sheet: Sheet, moment: str, ends: list[tuple[str, complex]], link: complex, length: float) -> float:
    """Hang a moment as two forces on the ends of its link: (letter, point of the velocity plan); return its moment."""
    pair = moment.replace("M_", "F_") + "_couple"
    if sheet.slip("M79", moment):
        wrong = sheet.way("M79")
        length = 1.0 if wrong == "whole" else math.inf
    sign = -1.0 if sheet.slip("M80", moment) else 1.0
    size = sheet.write(pair, sheet.size(moment) / length * sign)
    whole = 0.0
    if not size:
        return whole
    for (letter, v), side in zip(ends, (1.0, -1.0), strict=False):
        along = 1j * link * math.copysign(1.0, size) * side
        name = f"h_lever_{moment}_{letter}"
        whole += abs(size) * sheet.arm(name, "velocity", 0j, 1j * v, along)
    return whole
