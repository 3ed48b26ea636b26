"""What a page that moves needs of a linkage: its solver, its views as shapes between named points, its steps in words.

Nothing here has a place of its own: every end of a shape is the name of a point, a mark or a direction of the program,
and the page finds where it is by the same program, written down as JavaScript.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ...plans.board import POSITION
from ...plans.boards.batch import script_of
from ...plans.linkages.cycle import Cycle
from ...plans.linkages.loads import BEGIN, END
from ...plans.linkages.mechanism import FRAME, Link, Prismatic, start_names
from ...plans.linkages.solved import SolvedLinkage
from ...plans.names import magnitude, role
from ...plans.quantities import Quantity
from ...scales.scale import UNITS, Scale
from ..formats import STYLES
from ..moving import Data, html
from ..moving import number as number_of
from ..notes.blocks import REFERS
from ..symbols import unit
from ..words import Given, Words
from .calculations.forces import BALANCE, Couple, hung_on_lever, letter_of
from .figures.cycle import main_output
from .figures.lever import is_main, lever_lines
from .figures.links import NEAR, Skeleton, guide_of, pins_of, skeleton
from .reading import lettered
from .scene import Scene, plan_heading
from .steps import drawn_by, drawn_views, told_of
from .telling import Teller

FIRST = 0xE000  # a letter of private use stands in a sentence where the page puts a number
NEARS = 90  # places over the cycle at which a template of a group of class III begins
REFERRED = re.compile(REFERS.format(".*?"))  # to equations, which the page has not
BENT = 1e-3  # sine of an angle, or part of a line, that is none
MILLIMETRES = 100.0  # parts of a plan's longest vector that a millimetre is while the page is made
End = str | list[Any]


@dataclass(frozen=True, slots=True)
class _Live(Teller):
    """A teller in whose sentences the numbers are left open: what stands there is in `asked`, in order."""

    asked: list[list[str]] = field(default_factory=list, compare=False)

    def ask(self, kind: str, *names: str) -> str:
        """Return a sign that the page replaces by a number."""
        self.asked.append([kind, *names])
        return chr(FIRST + len(self.asked) - 1)

    def drawn(self, name: str, plan: str = POSITION) -> str:
        """Return how long a quantity is drawn."""
        return f"{self.ask('mm', name, plan)} {self.words.unit(self.words.display.paper)}"

    def apart(self, one: str, other: str) -> str:
        """Return how far two points of the mechanism are drawn from one another."""
        return f"{self.ask('apart', one, other)} {self.words.unit(self.words.display.paper)}"

    def across(self, name: str) -> str:
        """Return how long an arm is drawn."""
        return f"{self.ask('mm', name, 'lever')} {self.words.unit(self.words.display.paper)}"

    def between(self, couple: Couple) -> str:
        """Return how long the arm of a couple is drawn: as far as its marks are apart on the plan of velocities."""
        marks = (f"velocity.{role(mark).of}" for mark in couple.marks)
        return f"{self.ask('apart', *marks, 'lever')} {self.words.unit(self.words.display.paper)}"

    def place(self, name: str) -> str:
        """Return the coordinates of a point."""
        unit = self.words.unit(self.words.display.paper)
        return self.say("coordinates", x=self.ask("x", name), y=self.ask("y", name), unit=unit)

    def angle(self, direction: str) -> str:
        """Return the angle of the driver where it stands now; nothing for other lines."""
        turn = self.made.get(direction)
        if turn is None or not Teller.angle(self, direction):
            return ""
        return self.say("angle", symbol=self.words.symbol(turn.operands[0]), value=self.ask("place"))

    def sense(self, rate: str) -> str:
        """Return in which sense a link turns."""
        return self.ask("sense", rate)

    def read_off(self, item: Quantity) -> dict[str, str]:
        """Return what a segment of a plan says, by its millimetres."""
        words, plan = self.words, self.figure_of(item.name)
        unit = words.unit(words.display.unit(item.unit))
        paper = words.unit(words.display.paper)
        return {
            "mm": f"{self.ask('mm', item.name, plan)} {paper}",
            "sum": f"{self.ask('mm', item.name, plan)}·{self.ask('mu', plan)}",
            "value": f"{self.ask('value', item.name)} {unit}",
        }


def moving_linkage(
    solved: SolvedLinkage, cycle: Cycle, givens: Mapping[str, Given], words: Words, bounds: Mapping[str, str]
) -> Data:
    """Return what the page needs of a mechanism with this cycle; the `solved` position is the one that it begins in.

    `bounds` are what the givens must be, by their names: the key of the message for what they may not.
    """
    words = lettered(words, solved)
    scene = Scene(solved, words, STYLES["A4"], givens, _scales(solved))
    board = {name: float(value) for name, value in cycle.givens.items()}
    teller = _Live(scene.solved, words, scene.style, givens, scene.scales, texts=Teller.of(scene).texts)
    views = [*_views(teller)]
    drive = cycle.drive
    span = cycle.range
    own = role(drive.variable).shown
    data = {
        "board": {name: number_of(value) for name, value in board.items()},
        "near": _near(cycle),
        "turned": [start_names(start.link)[2:4] for start in cycle.mechanism.starts] if cycle.drive.follower else [],
        "drive": {
            "name": drive.variable,
            "symbol": html(words.symbol(own) if own != "driver" else words.symbol("phi_1")),
            "turns": drive.turns,
            "sense": drive.sense,
            "start": float(cycle.givens[drive.variable]),
            "low": min(span.low, span.high),
            "high": max(span.low, span.high),
            "speed": cycle.speed,
            "by": 1e3,
            "unit": words.unit("mm"),
            "digits": 1 if drive.turns else 2,
            "crank": [str(getattr(cycle.mechanism.driver, "pivot", "")), str(cycle.mechanism.driver.point)],
        },
        "givens": [*_givens(scene, cycle, bounds)],
        "stroke": _stroke(cycle),
        "views": views,
        "asked": teller.asked,
        "quantities": [*_quantities(scene)],
        "shown": [*_first_shown(scene, cycle)],
        "senses": [words["said.ccw"], words["said.cw"]],
    }
    used = {*_texts(data)}
    names = [name for name in cycle.program.names if name in used]
    return {"solve": script_of(cycle.program, board, names), "names": names, **data}


def _texts(data: Any) -> Iterator[str]:
    """Go through all texts of some data, names among them."""
    if isinstance(data, str):
        yield data
    elif isinstance(data, dict | list | tuple):
        for item in data.values() if isinstance(data, dict) else data:
            yield from _texts(item)


def _scales(solved: SolvedLinkage) -> dict[str, Scale]:
    """Return scale factors to which shapes are looked at; those of the page follow from what it shows."""
    found = {}
    for plan, symbol in solved.scale_of_plan.items():
        marks = (name for name in solved.program.names if "." in name and role(name).plan == plan)
        values = (solved.values[name] for name in marks)
        size = max((abs(v) for v in values if isinstance(v, complex) and v == v), default=0.0)
        size = solved.extent if plan == POSITION else size
        found[plan] = Scale(symbol, (size or 1.0) / MILLIMETRES, UNITS[role(symbol).of])
    return found


def _near(cycle: Cycle) -> Data | None:
    """Return where templates of groups of class III lie, about, all over the cycle."""
    if cycle.drive.follower is None:
        return None
    span = cycle.range
    places = np.linspace(min(span.low, span.high), max(span.low, span.high), NEARS + 1)
    poses = cycle.drive.follower.near(places)
    return {name: [number_of(value, 6) for value in np.broadcast_to(row, places.shape)] for name, row in poses.items()}


def _givens(scene: Scene, cycle: Cycle, bounds: Mapping[str, str]) -> Iterator[Data]:
    """Go through the numbers that may be changed, as the task gives them; names of the board follow each of them."""
    for name, given in scene.givens.items():
        if isinstance(given.value, str) or name == cycle.drive.variable:
            continue
        board = [other for other in (name, magnitude(name)) if other in cycle.givens]
        if not board or not given.value:  # what is zero is none of the program's numbers
            continue
        yield {
            "name": name,
            "board": board,
            "symbol": html(scene.words.symbol(name)),
            "value": given.value,
            "unit": html(scene.words.unit(given.unit)),
            "si": number_of(cycle.givens[board[0]] / given.value) if cycle.givens[board[0]] else 1.0,
            "bound": bounds.get(name, ""),
            "fixed": cycle.drive.follower is not None and name in cycle.mechanism.coordinates,
        }


def _stroke(cycle: Cycle) -> Data | None:
    """Return what the ends of the working stroke are found by, where a load needs them."""
    if END not in cycle.program.needs:
        return None
    assert cycle.mechanism.stroke is not None
    output = next(output for output in cycle.outputs if output.link == cycle.mechanism.stroke.link)
    return {"begin": BEGIN, "end": END, "place": output.place, "slides": output.slides}


def _quantities(scene: Scene) -> Iterator[Data]:
    """Go through the results that the page lists: symbol, unit and plan."""
    for item in scene.quantities.values():
        if item.kind == "point" or item.name not in scene.made or role(item.name).hidden:
            continue
        plan = scene.figure_of(item.name)
        yield {
            "name": item.name,
            "symbol": html(scene.words.symbol(item.name)),
            "unit": html(scene.words.unit(scene.words.display.unit(item.unit))),
            "by": number_of(scene.words.display.value(1.0, item.unit)),
            "plan": plan if plan in scene.scales else "",
        }


def _first_shown(scene: Scene, cycle: Cycle) -> Iterator[str]:
    """Go through what the diagrams show at first: velocity and acceleration of the output, what balances the driver."""
    motion = main_output(cycle)
    link = motion.output.link if motion else scene.numbers[-1]
    points = [point for point in scene.mechanism.link(link).points if point not in scene.mechanism.frame_points]
    turns = motion is not None and not motion.output.slides
    rates = [f"omega_{link}"] if turns else [f"V_{point}" for point in points]
    changes = [f"epsilon_{link}"] if turns else [f"a_{point}" for point in points]
    for names in (rates, changes, ["M_bal", "F_bal"]):
        yield from [name for name in names if name in scene.quantities][:1]


def _views(teller: _Live) -> Iterator[Data]:
    """Go through the views: the mechanism, its plans, the lever; each with its shapes and its steps."""
    for view in drawn_views(teller):
        if view not in teller.scales:  # compound motion is told on the sheet
            continue
        told = [*told_of(teller, view)]
        since = dict.fromkeys(teller.program.names, 0)
        for count in range(len(told), -1, -1):
            since |= {name: count for name, drawn in drawn_by(teller, view, told, count).items() if drawn}
        shapes = [*shapes_of(teller, view)]
        for shape in shapes:
            shape["from"] = since.get(shape.pop("step", ""), 0)
        scale = teller.scales[view]
        yield {
            "name": view,
            "heading": html(plan_heading(teller.words, teller.solved.structure, view)),
            "symbol": html(teller.words.symbol(scale.symbol)),
            "per": html(per(teller, scale)),
            "by": number_of(teller.words.display.value(1.0, scale.unit)),
            "shapes": shapes,
            "steps": [html(REFERRED.sub("", step.text)) for step in told],
        }


def shapes_of(scene: Scene, view: str) -> Iterator[Data]:
    """Go through the shapes of a view, the mechanism, a plan or the lever; `step` names what draws each of them."""
    return _mechanism(scene) if view == POSITION else _lever(scene) if view == "lever" else _plan(scene, view)


def per(scene: Scene, scale: Scale) -> str:
    """Return the unit of a scale factor."""
    unit, paper = (scene.words.unit(name) for name in (scene.words.display.unit(scale.unit), scene.words.display.paper))
    return f"({unit})/{paper}" if "/" in unit else f"{unit}/{paper}"


def _mechanism(scene: Scene) -> Iterator[Data]:
    """Go through the shapes of the mechanism: guides, links, blocks, pins, pivots, centres of mass, letters."""
    sliding = [pair for pair in scene.mechanism.pairs if isinstance(pair, Prismatic)]
    for pair in sliding:
        if FRAME in pair.links:
            yield {"k": "guide", "at": pair.point, "u": scene.solved.guide_name(pair), "step": pair.point}
    for link in scene.mechanism.links:
        yield from _link(scene, link)
    for pair in sliding:
        guide = scene.solved.guide_name(pair)
        yield {"k": "block", "at": pair.point, "u": guide, "link": pair.links[0], "step": pair.point}
    pins = dict.fromkeys(point for own in scene.numbers for point in pins_of(scene, own))
    for point in pins:
        kind = "pivot" if point in scene.mechanism.frame_points else "pin"
        yield {"k": kind, "at": point, "step": point}
    for link in scene.mechanism.links:
        if link.centre and link.centre not in pins and link.centre in scene.made:
            yield {"k": "centre", "at": link.centre, "step": link.centre}
    drawn = {*pins, *(link.centre for link in scene.mechanism.links), *(pair.point for pair in sliding)}
    for point in scene.points:
        if point in scene.made:
            if point not in drawn:
                yield {"k": "pin", "r": 0.8, "at": point, "step": point}
            yield {"k": "letter", "at": point, "text": html(scene.words.mark(point)), "step": point}


def _link(scene: Scene, link: Link) -> Iterator[Data]:
    """Go through lines and rigid corners of a link, and its number beside the first line."""
    figure, own = skeleton(scene, link.number), {"link": link.number, "step": scene.last(link.points)}
    bars = [(_end(scene, figure, a), _end(scene, figure, b)) for a, b in figure.strokes]
    for a, b in bars:
        yield {"k": "bar", "a": a, "b": b, **own}
    for corner, *sides in figure.corners:
        if abs((sides[0].conjugate() * sides[1]).imag) > BENT:
            ends = [_along(scene, figure, corner, side) for side in sides]
            yield {"k": "corner", "at": _end(scene, figure, corner), "ends": ends, **own}
    for a, b in bars[:1]:
        yield {"k": "number", "ends": [a, b], "text": str(link.number), **own}


def _end(scene: Scene, figure: Skeleton, at: complex) -> End:
    """Return where an end of a link is: at a point, or so far from one along and across a guide that the link has."""
    number, pins = figure.number, pins_of(scene, figure.number)
    points = dict.fromkeys((*scene.mechanism.link(number).points, *pins))
    blocks = (pair.point for pair in scene.sliding(number) if pair.links[0] == number)
    for point in (*points, *blocks):
        if abs(scene.mm(point) - at) < NEAR:
            return point
    guide = next(pair for pair in scene.sliding(number) if pair.links[1] == number)
    point = next(point for point in (*pins, *points) if point in scene.values)
    way = (at - scene.mm(point)) / guide_of(scene, guide) * scene.scales[POSITION].mu
    return [point, scene.solved.guide_name(guide), number_of(way.real, 9), number_of(way.imag, 9)]


def _along(scene: Scene, figure: Skeleton, corner: complex, side: complex) -> End:
    """Return the other end of the line of a link that leaves a corner to this side."""
    for ends in figure.strokes:
        for start, end in (ends, ends[::-1]):
            foot = (corner - start) / (end - start)
            off = abs(foot.imag) * abs(end - start)
            if off < NEAR and foot.real < 1.0 - BENT and abs(unit(end - start) - side) < BENT:
                return _end(scene, figure, end)
    return _end(scene, figure, corner)


def _plan(scene: Scene, plan: str) -> Iterator[Data]:
    """Go through the shapes of a plan: lines that meet, vectors, marks and their letters."""
    reading = scene.reading
    for step, _, start, direction in reading.meetings(plan):
        yield {"k": "line", "a": start, "u": direction, "b": step.name, "step": step.name}
    sides = [*reading.triangles(plan), *(step.operands[:2] for step in scene.program.on(plan) if step.verb == "divide")]
    for marks in sides:
        for i, one in enumerate(marks):
            yield from ({"k": "side", "a": other, "b": one, "step": scene.last((one, other))} for other in marks[:i])
    seen: dict[tuple[str, str], Data] = {}
    for edge in reading.on(plan):
        letter = html(scene.letter(edge.name))
        if (edge.tail, edge.tip) in seen:
            seen[edge.tail, edge.tip]["text"] += f" = {letter}"
            continue
        shape = {"k": "vector", "a": edge.tail, "b": edge.tip, "q": role(edge.name).shown, "text": letter}
        seen[edge.tail, edge.tip] = shape | {"step": reading.drawn_with(edge)}
    yield from seen.values()
    poles = [step.name for step in scene.program.on(plan) if step.verb == "pole"]
    for mark in dict.fromkeys((*poles, *(end for ends in seen for end in ends))):
        kind = "pole" if mark in poles else "mark"
        yield {"k": kind, "at": mark, "text": html(scene.words.mark(mark)), "step": mark}


def _lever(scene: Scene) -> Iterator[Data]:
    """Go through the shapes of the lever: the plan of velocities turned, forces on its ends, their arms."""
    driven, hung = scene.mechanism.driver.point, hung_on_lever(scene)
    images = [step.name for step in scene.program.on("lever") if step.verb == "normal"]
    last = images[-1]
    for line in lever_lines(scene):
        a, b = (_image(scene, end) for end in (line.tail, line.tip))
        yield {"k": "side", "a": a, "b": b, "main": is_main(scene, line), "step": last}
    for name, mark in hung:
        at, step = _image(scene, mark), name if name in scene.made else last
        yield {"k": "force", "at": at, "v": name, "q": role(name).shown, "text": html(scene.letter(name)), "step": step}
        if name not in BALANCE:
            yield {"k": "arm", "pole": "lever.p", "at": at, "v": name, "step": step}
    marks = dict.fromkeys(
        (*images, f"lever.{driven}", *(end for line in lever_lines(scene) for end in (line.tail, line.tip)))
    )
    for mark in ("lever.p", *(mark for mark in marks if mark != "lever.p")):
        text = scene.words.mark("velocity.p") if mark == "lever.p" else letter_of(scene, mark)
        kind = "pole" if mark == "lever.p" else "mark"
        yield {"k": kind, "at": _image(scene, mark), "text": html(text), "step": last if kind == "mark" else ""}


def _image(scene: Scene, mark: str) -> End:
    """Return a mark of the lever: that of the velocity plan turned by 90 degrees where nothing hangs on it."""
    return mark if mark in scene.values else ["i", f"velocity.{role(mark).of}"]
