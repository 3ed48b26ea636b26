"""Vector equations of the plans: both ways to a point that two lines find, and closed sums of forces.

They are read off the recorded steps, so that an equation has the vectors that are drawn, and no other.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from ....plans.board import POSITION, Step
from ....plans.linkages.parts import SYMBOLS
from ....plans.names import CORIOLIS, NORMAL, POLE, role, vector
from ..letters import guide_letters
from ..reading import Edge, Reading, read
from ..scene import Scene
from .equations import by_direction, known, noted


@dataclass(frozen=True, slots=True)
class Side:
    """One way from the pole to a point: vectors known in full, then one along the line `direction`."""

    knowns: tuple[str, ...]
    unknown: str
    direction: str


def meeting(scene: Scene, step: Step) -> tuple[str, ...]:
    """Return the equation that two lines of a plan solve, and along which lines its unknown vectors lie.

    Both sides lead from the pole to the point where the lines meet; its absolute vector stands before them unless it is
    itself the unknown of one side.
    """
    reading = read(scene.solved.program)
    p, u, q, w = step.operands
    sides = sorted((_side(reading, step, p, u), _side(reading, step, q, w)), key=lambda side: len(side.knowns))
    whole = reading.absolute(step.name)
    texts = [" + ".join((*_double(scene, side.knowns), by_direction(_bar(scene, side.unknown)))) for side in sides]
    if whole is not None and all(side.knowns or side.unknown != whole.name for side in sides):
        texts.insert(0, _bar(scene, whole.name))
    notes = [line_note(scene, side.unknown, side.direction) for side in sides]
    return noted((texts[0], *(f"= {text}" for text in texts[1:])), *notes)


def _side(reading: Reading, step: Step, start: str, direction: str) -> Side:
    before = reading.number[step.name]
    edge = reading.between(start, step.name)
    name = edge.name if edge is not None else _named(reading, start, step.name)
    return Side(tuple(edge.name for edge in reading.way(start, before)), name, direction)


def _named(reading: Reading, start: str, tip: str) -> str:
    """Return the name of a vector that is drawn but not read: `V_XA` from a to x.

    From the end n of normal parts it is the tangential part `a_XA_t`, from that of Coriolis the sliding one `a_XB4_r`.
    """
    begin, end, part = role(start), role(tip), ""
    while begin.kind in (NORMAL, CORIOLIS):
        part = "r" if begin.kind == CORIOLIS else part or "t"
        begin = role(reading.made[begin].operands[0])
    return vector(SYMBOLS.get(end.plan, "V"), end.of, "" if begin.kind == POLE else begin.of, part)


def summed(scene: Scene, whole: str, parts: Sequence[str]) -> tuple[str, ...]:
    """Return `whole = a + b` of parts that are known in full."""
    first, *rest = _double(scene, parts)
    return (f"{_bar(scene, whole)} = {first}", *(f"+ {text}" for text in rest))


def line_note(scene: Scene, vector: str, direction: str) -> str:
    """Say along which line a vector lies: `V_BA ⊥ AB`."""
    return f"{_bar(scene, vector)} {line_of(scene, direction)}"


def line_of(scene: Scene, direction: str) -> str:
    """Return a line by the name of its direction: ∥ AB, ⊥ AB, ∥ x–x."""
    reading = read(scene.solved.program)
    step = reading.made[direction]
    if step.verb == "normal":
        return f"⊥ {_line(scene, step.operands[0])}"
    return f"∥ {_line(scene, direction)}"


def line_through(scene: Scene, point: str, direction: str) -> str:
    """Return the line through a point: AB, or (B ⊥ x–x)."""
    line = line_of(scene, direction)
    return line.removeprefix("∥ ") if line.startswith("∥ ") else f"({scene.words.mark(point)} {line})"


def _line(scene: Scene, direction: str) -> str:
    guides = guide_letters(scene.solved.program)
    if direction in guides:
        return guides[direction]
    return "".join(scene.words.mark(point) for point in ends_of(read(scene.solved.program), direction))


def ends_of(reading: Reading, direction: str) -> tuple[str, str]:
    """Return the two points of which a direction is the line."""
    step = reading.made[direction]
    if step.verb in ("direction", "tangent"):
        return step.operands[0], step.operands[1]
    # the crank is turned to its angle: its end is laid off along this direction
    lay = next(s for s in reading.users(direction) if s.verb == "lay" and s.plan == POSITION)
    return lay.operands[0], lay.name


def closed(scene: Scene, plan: str) -> Iterable[tuple[str, ...]]:
    """Go through the sums of forces of a plan: the one that closes it, then those that its chords show."""
    reading = read(scene.solved.program)
    edges = reading.on(plan)
    meet = next((step for step in scene.solved.program.on(plan) if step.verb == "meet"), None)
    if meet is None:
        last = edges[-1]
        around = path([e for e in edges if e is not last], last.tip, last.tail)
        yield _zero(scene, around, (), last.name)
        return
    p, u, q, w = meet.operands
    firm = [e for e in edges if reading.is_hung(e)]
    lines = ((reading.between(p, meet.name), u), (reading.between(meet.name, q), w))
    found = [edge for edge, _ in lines if edge is not None]
    notes = [line_note(scene, edge.name, along) for edge, along in lines if edge is not None]
    by_moments = next((e for e in edges if {e.tail, e.tip} & {p, q} and role(e.name).part == "m"), None)
    if by_moments is not None:
        whole, along = role(by_moments.name).whole, next(line for edge, line in lines if edge is None)
        yield _two_ways(scene, whole, found[0].name, notes[0], along)
        edges = tuple(sorted((e for e in edges if e is not by_moments), key=lambda e: e.name != whole))
        yield from _chords(scene, edges, [*firm, *found], ())
        return
    yield noted(_zero(scene, path(firm, q, p), [edge.name for edge in found], ""), *notes)
    yield from _chords(scene, edges, [*firm, *found], edges)


def _chords(
    scene: Scene, edges: Sequence[Edge], ready: list[Edge], others: Sequence[Edge]
) -> Iterable[tuple[str, ...]]:
    """Go through the sums of forces that the chords of a plan show, by what is ready before each, or by all others."""
    for chord in (e for e in edges if e not in ready):
        parts = path(ready, chord.tail, chord.tip)
        if _same_force(chord.name, parts):
            yield summed(scene, chord.name, parts)
        else:
            around = path([e for e in others or ready if e is not chord], chord.tip, chord.tail)
            yield _zero(scene, around, (), chord.name)
        if not others:
            ready = [*ready, chord]


def _two_ways(scene: Scene, whole: str, normal: str, note: str, along: str) -> tuple[str, ...]:
    """Return the equation of a reaction by its parts along and across its link, and along and across another line."""
    parts = [f"{whole}_t", f"{whole}_m"]
    unknowns = [normal, f"{whole}_p"]
    texts = [f"{known(_bar(scene, x))} + {by_direction(_bar(scene, y))}" for x, y in zip(parts, unknowns, strict=True)]
    equation = (f"{_bar(scene, whole)} = {texts[0]}", f"= {texts[1]}")
    return noted(equation, note, line_note(scene, unknowns[1], along))


def path(edges: Iterable[Edge], start: str, end: str) -> list[str]:
    """Return the shortest way of vectors, tip to tail, from one mark to another."""
    ways: dict[str, list[str]] = {start: []}
    queue, leaving = [start], _leaving(edges)
    for mark in queue:
        for edge in leaving.get(mark, ()):
            if edge.tip not in ways:
                ways[edge.tip] = [*ways[mark], edge.name]
                queue.append(edge.tip)
    return ways.get(end, [])


def _leaving(edges: Iterable[Edge]) -> Mapping[str, list[Edge]]:
    found: dict[str, list[Edge]] = {}
    for edge in edges:
        found.setdefault(edge.tail, []).append(edge)
    return found


def _same_force(whole: str, parts: Sequence[str]) -> bool:
    """Whether these are the parts of one reaction."""
    return bool(parts) and all(role(part).whole == whole != part for part in parts)


def _zero(scene: Scene, knowns: Sequence[str], lines: Sequence[str], unknown: str) -> tuple[str, ...]:
    """Return a sum of forces that is zero: known in full, known by direction, to be found."""
    texts = _double(scene, knowns) + [by_direction(_bar(scene, name)) for name in lines]
    texts += [_bar(scene, unknown)] if unknown else []
    return (texts[0], *(f"+ {text}" for text in texts[1:]), "= 0")


def _double(scene: Scene, names: Iterable[str]) -> list[str]:
    return [known(_bar(scene, name)) for name in names]


def _bar(scene: Scene, name: str) -> str:
    return scene.words.symbol(role(name).shown, bar=True)
