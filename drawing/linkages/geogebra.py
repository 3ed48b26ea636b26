"""The construction of a linkage for GeoGebra: mechanism and plans beside each other, moved by the driver's slider.

Points and vectors follow from the recorded program (`plans.boards.geogebra`), the shapes between them are those of
pages that move, the steps are told in the words of the note.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from ...plans.board import POSITION, Program
from ...plans.boards.exact import run
from ...plans.boards.geogebra import GeoGebraBoard, Item, Labels
from ...plans.laws import TURN, dot
from ...plans.linkages.compound import ACCELERATION, TOTAL, VELOCITY
from ...plans.linkages.cycle import Cycle
from ...plans.linkages.loads import BEGIN, END
from ...plans.linkages.mechanism import start_names
from ...plans.linkages.parts import SYMBOLS
from ...plans.names import FORCES, Name, by_lever, magnitude, role, vector
from ...plans.quantities import F_BAL, M_BAL
from ...scales.units import unit
from ..geogebra import (
    APART,
    AXIS,
    DASHED,
    DOTTED,
    GRIP,
    HIDDEN,
    MARGIN,
    RING,
    SUPPORT,
    THIN,
    Arranged,
    Box,
    Look,
    arranged,
    indexed,
    packed,
    string,
    tag,
    tex,
)  # fmt: skip
from ..printed import POINT
from .moving import NEARS, REFERRED, per, shapes_of
from .scene import Scene, is_at_point, plan_heading
from .steps import drawn_views, told_of
from .telling import Teller

Shape = Mapping[str, Any]
Numbers = dict[str, tuple[str, float]]  # labels and units in SI by the names of the board
LOOKED_AT = 36  # positions whose plans make room for themselves
USUAL = 0.6  # part of them, the smallest; near a singular position a plan is of any size
BLOCK, FORCE, RUN = 7.0, 25.0, 12.0  # mm: half a block, a force on the lever, a guide beyond its slider
HAIR = Look(seen=True, colour=THIN, width=1)
ARROW = Look(seen=True, labelled=True, width=3)
SHAPES = {  # looks of what is drawn between points, by kind
    "bar": Look(seen=True, width=5),
    "guide": replace(HAIR, dashes=AXIS),
    "block": Look(seen=True, width=13, colour=(170, 170, 170)),
    "line": replace(HAIR, dashes=DASHED),
    "side": HAIR,
    "vector": ARROW,
    "force": ARROW,
    "arm": replace(HAIR, dashes=DASHED),
}
MARK = Look(seen=True, labelled=True)
GRABBED = replace(MARK, size=4, colour=GRIP, lists=True)
POINTS = {"pin": replace(MARK, size=4, style=RING), "pivot": replace(MARK, size=6, style=SUPPORT)}
NEWLINE = "\n"
WORD = re.compile("[a-z]{4}")
RATES, BALANCES = ("omega", "epsilon"), (M_BAL, F_BAL, by_lever(M_BAL), by_lever(F_BAL))


class Construction:
    """A mechanism with its plans as objects of GeoGebra, in order of construction.

    Parameters
    ----------
    scene : Scene
        What is drawn, in the position that the slider begins in, with scale factors by plan.
    cycle : Cycle
        The same over the range of its driver.
    """

    def __init__(self, scene: Scene, cycle: Cycle) -> None:
        self.teller, self.cycle, self.words = Teller.of(scene), cycle, scene.words
        self.program: Program = cycle.program.needed_for(scene.program.names)
        self.objects: list[tuple[Item, Look]] = []
        self._labels = Labels()
        self._shapes = {plan: [*self._shapes_of(plan)] for plan in self.program.plans}
        self._positions = [*self._looked_at(), scene.values]
        self._boxes = {plan: self._box(plan) for plan in self.program.plans}
        self._room: Arranged = arranged({p: (box, len(self._listed(p))) for p, box in self._boxes.items()})
        self._needs = {*self._needed()}
        free, self.scales = self._numbers(), self._scale_numbers()
        constants = {name: float(x) for name, x in cycle.givens.items() if name in self._needs - free.keys()}
        self.board = GeoGebraBoard(constants, free, self.scales, self._label, self._labels.take)
        self.board.write(self.program)
        self._construct()
        self._values()

    def packed(self, titles: tuple[str, str]) -> bytes:
        """Return the file; `titles` are the names of mechanism and variant, there from the first step on."""
        stroke = self.words["geogebra.stroke"] if END in self._needs else ""
        about = " ".join(filter(None, (self.words["geogebra.about"], stroke)))
        head = [
            self._texted(string(text), f"(0, {row * self._room.line:.6g})")
            for row, text in ((3, ". ".join(titles)), (2, about))
        ]
        return packed([*head, *self.objects], titles[0], self._room.box)

    def _needed(self) -> Iterator[str]:
        """Go through what the program needs; a rate with its sense may be called like the one that is given."""
        made: set[str] = set()
        for step in self.program:
            yield from (name for name in step.operands if name not in made)
            made.add(step.name)

    def _add(self, item: Item, look: Look = HIDDEN) -> None:
        self.objects.append((item, look))

    def _label(self, name: str, seen: bool) -> str:
        if "." in name or name in self.teller.points:
            return self._labels.take(self._letter(name), _sign(role(name).plan))
        symbol, beside = self.words.symbol(role(name).shown), role(name).of
        if WORD.search(symbol):  # of the program, in English: it would stand in the list of steps
            symbol, beside = symbol[0], ""
        return self._labels.take(symbol if seen else f"{symbol}_{{0}}", beside)

    def _letter(self, name: str) -> str:
        """Return the letter of a mark."""
        return role(name).of if is_at_point(role(name).plan) else self.words.mark(name)

    # numbers that may be changed

    def _numbers(self) -> Numbers:
        """Add the driver's slider, the data, what else is no number of the task's own construction."""
        driver = self.cycle.drive.variable
        free = {driver: self._driver()}
        for name, given in self.teller.givens.items():
            board = [other for other in (name, magnitude(name)) if other in self._needs and other not in free]
            if board and not isinstance(given.value, str):
                free[board[0]] = self._number(self.words.symbol(name), given.value, given.unit)
        for name, key in ((BEGIN, "geogebra.begin"), (END, "geogebra.end")):
            if name in self._needs:
                free[name] = self._number(f"s_{{{self.words[key]}}}", float(self.cycle.givens[name]), "")
        return free | dict(self._near(free[driver]))

    def _number(self, symbol: str, value: float, of: str) -> tuple[str, float]:
        """Add a number of the data, which a slider may change, in its own unit; an angle in radians."""
        angle = of == "deg"
        value = math.radians(value) if angle else value
        ends = {"min": f"{min(0.0, 2 * value):.6g}", "max": f"{max(2 * abs(value), 1.0):.6g}"}
        caption = ", ".join(filter(None, (indexed(symbol), "" if angle or not of else indexed(self.words.unit(of)))))
        more = tag("value", val=repr(value)) + tag("slider", **ends, width=150, fixed=True, horizontal=True)
        item = Item(self._labels.take(symbol), "angle" if angle else "numeric")
        self._add(item, Look(lists=True, caption=caption, more=more))
        return item.label, 1.0 if angle or not of else unit(of).to_si(1.0)

    def _driver(self) -> tuple[str, float]:
        """Add the slider of the driver: an angle around the circle, or a travel in mm between its limits."""
        drive, room = self.cycle.drive, self._room
        own = role(drive.variable).shown
        symbol = self.words.symbol(own if own != "driver" else "phi_1")
        start, si = float(self.cycle.givens[drive.variable]), 1.0 if drive.turns else 1e-3
        low, high = (0.0, TURN) if drive.turns else sorted((self.cycle.range.low / si, self.cycle.range.high / si))
        at = {"x": 0, "y": f"{room.line:.6g}", "absoluteScreenLocation": False}
        more = (
            tag("value", val=repr(start % TURN if drive.turns else start / si)),
            tag("slider", min=repr(low), max=repr(high), width=250, fixed=True, horizontal=True, **at),
            tag("animation", step=repr(TURN / 360.0 if drive.turns else 0.5), speed=1, type=int(drive.turns)),
        )
        item = Item(self._labels.take(symbol), "angle" if drive.turns else "numeric")
        self._add(item, replace(GRABBED, width=6, more="".join(more)))
        return item.label, si

    def _near(self, driver: tuple[str, float]) -> Iterator[tuple[str, tuple[str, float]]]:
        """Add where templates of groups of class III lie, about: between places that are known all over the cycle."""
        drive, (low, high) = self.cycle.drive, sorted((self.cycle.range.low, self.cycle.range.high))
        if drive.follower is None:
            return
        places = np.linspace(low, high, NEARS + 1)
        part = f"({driver[0]} * {driver[1]!r} - ({low:.15f})) / {high - low:.15f}"
        at = self._helper("numeric", "k", f"({part} - floor({part})) * {NEARS}" if drive.turns else f"{part} * {NEARS}")
        found = {}
        for name, row in drive.follower.near(places).items():
            if not np.any(row):  # it went astray nowhere
                found[name] = "0"
                continue
            values = [f"{value:.9f}" for value in np.broadcast_to(row, places.shape)]
            among = self._helper("list", "L", f"{{{', '.join((*values, values[-1]))}}}")
            one, other = (f"Element[{among}, floor({at}) + {n}]" for n in (1, 2))
            found[name] = self._helper("numeric", "k", f"{one} + ({at} - floor({at})) * ({other} - {one})")
        for start in self.cycle.mechanism.starts:  # a direction between two others is shorter
            turn = start_names(start.link)[2:4]
            size = self._helper(
                "numeric", "k", f"sqrt({' + '.join(f'{found[name]} * {found[name]}' for name in turn)})"
            )
            found |= {name: f"({found[name]} / {size})" for name in turn}
        yield from ((name, (label, 1.0)) for name, label in found.items())

    def _helper(self, kind: str, letter: str, said: str) -> str:
        item = Item(self._labels.take(letter), kind, "", said)
        self._add(item)
        return item.label

    def _scale_numbers(self) -> dict[str, str]:
        """Add the scale factors, SI units in a millimetre; return their labels by plan."""
        labels: dict[str, str] = {}
        for scale in (self.teller.scales[plan] for plan in self.program.plans):
            if scale.symbol not in labels:
                symbol = self.words.symbol(scale.symbol)
                labels[scale.symbol] = self._labels.take(symbol, role(scale.symbol).about)
                caption = indexed(f"{symbol}, {self.words.unit(scale.unit)}/{self.words.unit('mm')}")
                look = Look(lists=True, caption=caption, more=tag("value", val=repr(scale.mu)))
                self._add(Item(labels[scale.symbol], "numeric"), look)
        return {plan: labels[self.teller.scales[plan].symbol] for plan in self.program.plans}

    # the construction

    def _construct(self) -> None:
        """Add what the program makes; behind each step the shapes that can be drawn then, and what is told of it."""
        told = {one.step.name: one.text for v in drawn_views(self.teller) for one in told_of(self.teller, v)}
        waiting = [shape for shapes in self._shapes.values() for shape in shapes]
        ends = {str(shape["at"]): POINTS[shape["k"]] for shape in waiting if shape["k"] in POINTS}
        read = {shape["q"] for shape in waiting if self._is_read(shape)}  # vectors whose own objects are seen
        waiting = [shape for shape in waiting if shape["k"] in SHAPES and not self._is_read(shape)]
        made, stop = set[str](), -1
        for item in self.board.items:
            self._add_item(item, ends, read)
            made |= {item.name} - {""}
            now = [shape for shape in waiting if _names(shape) <= made]
            waiting = [shape for shape in waiting if shape not in now]
            for shape in now:
                self._draw(shape)
            stop = self._stop(stop, told.get(item.name, ""))

    def _stop(self, stop: int, told: str) -> int:
        """Let the bar stop behind a step of which something is told, and the vectors that it shows beside it.

        Returns where it stops last.
        """
        last, look = self.objects[-1]
        if told:
            said = indexed(REFERRED.sub("", told))
        elif stop < 0 or not look.seen or look.stops or last.kind == "conic":
            return stop
        else:
            before, seen = self.objects[stop]
            said, self.objects[stop] = seen.caption, (before, replace(seen, caption="", stops=False))
        self.objects[-1] = last, replace(look, caption=said, stops=True)
        return len(self.objects) - 1

    def _is_read(self, shape: Shape) -> bool:
        """Whether a vector of a plan is one that the program reads: its object draws it."""
        step = self.program.by_name.get(shape["q"]) if shape["k"] == "vector" else None
        return step is not None and step.verb == "read" and step.operands == (shape["a"], shape["b"])

    def _add_item(self, item: Item, ends: Mapping[str, Look], read: set[str]) -> None:
        """Add what a step has made: points and vectors are seen, arcs thinly, what only helps is hidden."""
        name = role(item.name)
        plan = name.plan if item.name else POSITION
        if item.kind == "point" and not (item.said or item.command):
            at = self._room.places[plan]
            more = tag("coords", x=f"{at.real:.6g}", y=f"{at.imag:.6g}", z="1.0")
            look = replace(ends.get(item.name, GRABBED), colour=GRIP, lists=True, more=more)
            if item.name:
                self._add_lettered(item, look, self._letter(name))
            else:
                self._add(item, replace(look, labelled=False))
            return self._heading(plan, item.label)
        if item.kind == "point" and item.name and (plan != POSITION or item.name in self.teller.points):
            return self._add_lettered(item, ends.get(item.name, MARK), self._letter(name))
        if item.command == "Vector" and item.name in read:
            return self._add_lettered(item, ARROW, self.words.symbol(name.shown), item.inputs)
        return self._add(item, replace(HAIR, dashes=DOTTED) if item.kind == "conic" else HIDDEN)

    def _add_lettered(self, item: Item, look: Look, letter: str, ends: Sequence[str] = ()) -> None:
        """Add an object with its letter: its label, or a text where that may not be its label."""
        bare = not letter.startswith("\\") and "^" not in letter and item.label == Labels().take(letter)
        self._add(item, replace(look, labelled=look.labelled and bare))
        if not bare:
            self._text(string(tex(letter)), f"({ends[0]} + {ends[1]}) / 2" if ends else f"{item.label} + (2, 2)", True)

    def _draw(self, shape: Shape) -> None:
        """Add a shape between what has been made."""
        kind, letter, command = shape["k"], "", "Segment"
        if kind == "guide":
            ends = self._guide(shape)
        elif kind == "block":
            at, u = self._end(shape["at"]), self.board.labels[shape["u"]]
            ends = f"{at} - {BLOCK:g} * {u}", f"{at} + {BLOCK:g} * {u}"
        elif kind == "force":
            at, v, letter = self._end(shape["at"]), self.board.labels[shape["v"]], self.teller.letter(shape["q"])
            ends = at, f"{at} + {FORCE:g} / Length[{v}] * {v}"
        elif kind == "arm":
            p, at, v = self._end(shape["pole"]), self._end(shape["at"]), self.board.labels[shape["v"]]
            along = f"((x({p}) - x({at})) * x({v}) + (y({p}) - y({at})) * y({v})) / Length[{v}]^2"
            ends = p, f"{at} + {along} * {v}"
        else:
            ends = self._end(shape["a"]), self._end(shape["b"])
            letter = self.words.symbol(shape["q"]) if kind == "vector" else ""
        look = replace(SHAPES[kind], width=3) if shape.get("main") else SHAPES[kind]
        if letter:
            label = self._labels.take(letter, _sign(role(shape["step"]).plan))
            return self._add_lettered(Item(label, "vector", "", "", "Vector", ends), look, letter, ends)
        return self._add(Item(self._labels.take(kind[0]), "segment", "", "", command, ends), look)

    def _guide(self, shape: Shape) -> tuple[str, str]:
        """Return the ends of a guide on the frame, as far as its slider runs over the cycle."""
        at, guide, mu = shape["at"], shape["u"], self.teller.scales[POSITION].mu
        operands, u = self.program.by_name[at].operands, self.board.labels[guide]
        before = operands[: operands.index(guide)] if guide in operands else (at,)
        start = next(name for name in reversed(before) if name in self.board.labels)  # a mark on it
        runs = [dot(values[guide], values[at] - values[start]) / mu for values in self._positions]
        low, high = min(filter(math.isfinite, runs)) - RUN, max(filter(math.isfinite, runs)) + RUN
        return f"{self._end(start)} + ({low:.6g}) * {u}", f"{self._end(start)} + ({high:.6g}) * {u}"

    def _end(self, end: Any) -> str:
        """Return where an end of a shape is, as an expression."""
        labels, scales = self.board.labels, self.scales
        if isinstance(end, str):
            return labels[end]
        if end[0] == "i":  # the image of a mark of the velocity plan on the lever
            p, at, pole = (labels[name] for name in ("velocity.p", end[1], "lever.p"))
            part = f"{scales['velocity']} / {scales['lever']}"
            return f"{pole} + {part} * (y({p}) - y({at}), x({at}) - x({p}))"
        at, u, mu = labels[end[0]], labels[end[1]], scales[POSITION]
        along, across = (f"({way:.9f} / {mu})" for way in end[2:])
        return f"{at} + {along} * {u} + {across} * (-y({u}), x({u}))"

    # texts

    def _text(self, said: str, at: str, latex: bool = False) -> None:
        self._add(*self._texted(said, at, latex))

    def _texted(self, said: str, at: str, latex: bool = False) -> tuple[Item, Look]:
        parts = tag("isLaTeX", val=latex), tag("font", serif=latex, size=-1 if latex else 0, style=0)
        look = Look(seen=True, more="".join((*parts, tag("startPoint", exp=at))))
        return Item(self._labels.take("t"), "text", "", said), look

    def _heading(self, plan: str, origin: str) -> None:
        """Add the heading of a plan over it, with its scale factor."""
        words, scale, (left, _, _, high) = self.words, self.teller.scales[plan], self._boxes[plan]
        name = indexed(f"{self._called(role(plan))}{NEWLINE}{words.symbol(scale.symbol)} = ")
        value = _times(self.scales[plan], words.display.value(1.0, scale.unit))
        said = f"{string(name)} + ({value}) + {string(indexed(f' {per(self.teller, scale)}'))}"
        self._text(said, f"{origin} + ({left:.6g}, {high + 1.6 * self._room.line:.6g})")

    def _called(self, plan: Name) -> str:
        if plan.kind == ACCELERATION:
            return self.words["heading.compound_acceleration"].format(point=plan.of)
        if plan.kind == VELOCITY:
            return f"{self.words['heading.compound_velocity']}: {plan.of}"
        return plan_heading(self.words, self.teller.solved.structure, plan)

    def _values(self) -> None:
        """Add what has been found, in SI: beside each plan its quantities, beside the mechanism all others."""
        for plan, (_, _, right, high) in self._boxes.items():
            rows = f" + {string(NEWLINE)} + ".join(map(self._value, self._listed(plan)))
            if rows:
                at = f"({right + 0.5 * APART:.6g}, {high - self._room.line:.6g})"
                self._text(rows, f"{self.board.origin(plan)} + {at}")

    def _listed(self, plan: str) -> list[str]:
        """Return the names of the quantities that stand beside a plan."""
        found = [name for name in self.teller.quantities if name in self.program.by_name]
        if plan == POSITION:
            return [name for name in found if role(name).kind in RATES or name in BALANCES]
        shown = [name for name in found if self.teller.solved.shown_on.get(name) == plan]
        return [name for name in shown if not role(name).part and role(name).kind != "h"]

    def _value(self, name: str) -> str:
        """Return a line with a value; a segment that is a point is nothing."""
        words, item, value = self.words, self.teller.quantities[name], self.board.labels[name]
        if item.kind == "vector":
            value = f"Length[{value}]"
        if self.board.drawn(name):
            value = f"If[{value} < {POINT:.7f}, 0, {value}] * {self.scales[self.program.by_name[name].plan]}"
        value = _times(value, words.display.value(1.0, item.unit))
        of = indexed(f" {words.unit(words.display.unit(item.unit))}")
        return f"{string(f'{indexed(words.symbol(name))} = ')} + ({value}) + {string(of)}"

    # where plans stand

    def _shapes_of(self, plan: str) -> Iterator[Shape]:
        """Go through the shapes of a plan; of compound motion its vectors, and the lines that meet."""
        if not is_at_point(plan):
            yield from shapes_of(self.teller, plan)
            return
        reading = self.teller.reading
        for step, _, start, direction in reading.meetings(plan):
            yield {"k": "line", "a": start, "u": direction, "b": step.name, "step": step.name}
        for edge in reading.on(plan):  # the total has the name of the quantity that it shows
            name = role(edge.name)
            shown = vector(name.kind, role(plan).of) if name.part == TOTAL else name.shown
            drawn = {"k": "vector", "a": edge.tail, "b": edge.tip, "q": shown}
            yield {**drawn, "step": reading.drawn_with(edge)}

    def _looked_at(self) -> Iterator[Mapping[str, Any]]:
        """Go through positions over the cycle, each by its values."""
        low, high = sorted((self.cycle.range.low, self.cycle.range.high))
        places = low + (high - low) * np.arange(LOOKED_AT) / (LOOKED_AT - 1 + self.cycle.drive.turns)
        return (run(self.program, {**self.cycle.givens, **row}).values for row in self.cycle.each(places))

    def _box(self, plan: str) -> Box:
        """Return the box of a drawing about its origin, mm, in the positions in which it is of a usual size."""
        marks = [name for name in self.program.names if role(name).plan == plan]
        marks = [name for name in marks if plan != POSITION or name in self.teller.points]
        mu, boxes = self.teller.scales[plan].mu, list[Box]()
        for values in self._positions:
            at = np.array([0j, *(complex(values[name]) / mu for name in marks if name in values)])
            at = at[np.isfinite(at)]
            boxes.append((at.real.min(), at.imag.min(), at.real.max(), at.imag.max()))
        usual = sorted(boxes, key=lambda box: max(box[2] - box[0], box[3] - box[1]))[: math.ceil(USUAL * len(boxes))]
        left, low, right, high = zip(*(boxes if plan == POSITION else [*usual, boxes[-1]]), strict=True)
        margin = MARGIN + (FORCE if plan == "lever" else 0.0)
        return min(left) - margin, min(low) - margin, max(right) + margin, max(high) + margin


def _sign(plan: Name) -> str:
    """Return what tells labels of a plan from like ones of another."""
    return (
        f"F{plan.of}"
        if plan.kind == FORCES
        else SYMBOLS.get(plan, "L" if plan == "lever" else f"{plan.kind[0]}{plan.of}")
    )


def _names(shape: Shape) -> set[str]:
    """Return the names of the program that a shape needs."""
    found = (
        {"velocity.p", "lever.p"} if any(end[0] == "i" for end in _ends(shape) if not isinstance(end, str)) else set()
    )
    for end in _ends(shape):
        found |= {end} if isinstance(end, str) else {end[1]} if end[0] == "i" else {*end[:2]}
    return found


def _ends(shape: Shape) -> list[Any]:
    return [shape[key] for key in ("a", "b", "at", "pole", "u", "v", "step") if shape.get(key)]


def _times(value: str, by: float) -> str:
    return value if by == 1.0 else f"{value} * {by:g}"
