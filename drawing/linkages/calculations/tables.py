"""Tables of a linkage sheet: what is given, and what was measured and calculated; long ones cut by groups of links."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from itertools import combinations, groupby, pairwise
from typing import NamedTuple, TypeAlias

from ....plans.linkages.compound import found_here
from ....plans.linkages.solved import SolvedLinkage
from ....plans.linkages.structure import KINDS as GROUPS
from ....plans.linkages.structure import Group, Structure
from ....plans.names import COUPLE, role
from ....plans.quantities import Quantity
from ...printed import DIGITS, decimals_for
from ...tables import givens_view, table
from ...view import View
from ..reading import read
from ..scene import Scene
from .equations import RATES, Lines, drawn_on, number, opposed, printed_segment, value_shown
from .forces import on_lever

KINDS = ("velocity", "acceleration", "compound", "forces", "lever")
HEADS = {"l": "velocity", "V": "velocity", "omega": "velocity", "a": "acceleration", "epsilon": "acceleration"}
ROWS = 30  # most rows of a table
HALVED, WIDEST = 9, 181.0  # rows of a table to be written in, head and all, over which it has two halves; mm of these
PAIR = 2  # links of a reaction
UNIT = 4  # column of units
WRITABLE = 28  # rows of 8 mm that a page holds
NUMBERS = r"(?<![A-Za-hj-z\d])\d+"  # of links of two digits, not of points: 12 and 10 of `12_10`, 12 of `i12`
_Piece: TypeAlias = tuple[tuple[int, ...], list[str]]  # links of a group, names
CLASSES = {2: "II", 3: "III", 4: "IV"}


class Part(NamedTuple):
    """One table of results: the kind of plan, the names of its rows, the links they belong to ("" for all).

    Where a group of links has more rows than a table, the tables of its kind are numbered instead.
    """

    kind: str
    names: tuple[str, ...]
    links: str = ""
    number: int = 0

    @property
    def name(self) -> str:
        """The name of its view."""
        part = str(self.number) if self.number else self.links.replace(", ", "_")
        return f"results_{self.kind}_{part}" if part else f"results_{self.kind}"


def givens_table(scene: Scene) -> View:
    """Return the table of the givens in the task's own units."""
    words = scene.words
    # factors j of J_S = j m l^2 that the task fixes for all variants; links with one value share it
    shared: dict[float, list[str]] = {}
    for name in dict.fromkeys(link.inertia_factor for link in scene.mechanism.links):
        if name and name not in scene.givens and scene.defined(name):
            shared.setdefault(float(scene.values[name]), []).append(words.symbol(name))
    factors = [(" = ".join(s), words.short(value), words["table.calculated"]) for value, s in shared.items()]
    return givens_view(scene.givens, words, scene.style, factors)


def results_parts(solved: SolvedLinkage) -> tuple[Part, ...]:
    """Return the tables of results, in the order of the work; each quantity stands in one of them."""
    by_kind: dict[str, list[str]] = {kind: [] for kind in KINDS}
    number = read(solved.program).number
    # what compound motion alone finds, and the distances measured for it
    apart = found_here(solved.program) | {step.name for step in solved.program if step.verb == "distance"}
    lever = number.get("lever.p", len(number))
    for q in solved.quantities.values():
        name = role(q.name)
        if q.kind == "point" or q.value is None or q.name not in number or (name.part == COUPLE and name.about):
            continue  # of points, of given lengths, and of the second force of a couple the tables say nothing
        kind = HEADS.get(name.kind, "forces")
        by_kind["compound" if q.name in apart else "lever" if number[q.name] > lever else kind].append(q.name)
    parts = []
    for kind, names in by_kind.items():
        parts += [Part(kind, tuple(names))] if 0 < len(names) <= ROWS else _cut(solved, kind, names)
    return tuple(parts)


def _cut(solved: SolvedLinkage, kind: str, names: list[str]) -> list[Part]:
    """Cut a long table by groups of links, in the order in which the groups are dealt with."""
    groups = [(solved.structure.driver,), *(group.links for group in solved.structure.groups)]
    by_group: dict[tuple[int, ...], list[str]] = {g: [] for g in (groups[::-1] if kind == "forces" else groups)}
    for name in names:
        links = _links_of(solved, name)  # it stands with the last group of those that it concerns
        by_group[next((group for group in reversed(groups) if links & {*group}), groups[0])].append(name)
    counts = ((links, own, math.ceil(len(own) / ROWS)) for links, own in by_group.items())
    # what is too long for one table in equal pieces
    pieces = [(at, own[k * len(own) // n : (k + 1) * len(own) // n]) for at, own, n in counts for k in range(n)]
    whole, parts = all(len(own) <= ROWS for own in by_group.values()), []
    for count, run in enumerate(_evenly(pieces), start=1):
        numbers = ", ".join(map(str, sorted({number for own, _ in run for number in own})))
        rows = tuple(name for _, chunk in run for name in chunk)
        parts.append(Part(kind, rows, numbers) if whole else Part(kind, rows, number=count))
    return parts


def _evenly(pieces: list[_Piece]) -> list[list[_Piece]]:
    """Put pieces into as few tables as there can be, in their order, so that the longest is as short as it can be."""

    def longest(runs: list[list[_Piece]]) -> int:
        return max(sum(len(chunk) for _, chunk in run) for run in runs)

    for count in range(1, len(pieces) + 1):
        inner = combinations(range(1, len(pieces)), count - 1)
        ways = [[pieces[a:b] for a, b in pairwise((0, *cuts, len(pieces)))] for cuts in inner]
        best = min(ways, key=longest)
        if longest(best) <= ROWS:
            return best
    return []


def _links_of(solved: SolvedLinkage, name: str) -> set[int]:
    """Return the links that a quantity concerns: of a point the first that has it, of a reaction both."""
    mechanism, quantity = solved.mechanism, role(name)
    loads = {load.name: load.link for load in mechanism.loads} | {c.name: c.link for c in mechanism.couples}
    if name in loads or (quantity.kind == "h" and quantity.of in loads):
        return {loads.get(name) or loads[quantity.of]}
    numbers = {link.number for link in mechanism.links}
    if quantity.kind in ("V", "a"):
        links = [solved.structure.driver, *(number for group in solved.structure.groups for number in group.links)]
        with_point = (number for number in links if quantity.of in mechanism.link(number).points)
        return {next(with_point, *role(quantity.of).links)}
    if quantity.kind == "h" and len(quantity.links) == PAIR:
        return {quantity.links[1]} & numbers  # a reaction's arm stands where the link on which it acts is dealt with
    digits = re.findall(NUMBERS if mechanism.parted else r"\d", quantity.letters)
    return numbers.intersection(quantity.links or map(int, digits)) or {
        link.number for link in mechanism.links if {link.mass, link.inertia} & {name}
    }


def results_table(scene: Scene, part: Part) -> View:
    """Return a table of results."""
    words = scene.words
    heading = words[f"heading.results_{part.kind}"]
    if part.number:
        heading = f"{heading} ({part.number})"
    elif part.links:
        key = "table.of_link" if part.links.isdigit() else "table.of_links"
        heading = words[key].format(heading=heading, link=part.links, links=part.links)
    rows = _lever_rows(scene, part) if part.kind == "lever" else _rows(scene, part)
    # one too high for a page with rows to be written in has lower ones
    style = scene.style if len(rows) <= WRITABLE else replace(scene.style, row=0.0)
    whole = table(part.name, heading, rows, style)
    if not scene.style.row or len(rows) <= HALVED:
        return whole
    (head, *cells), half = rows, len(rows) // 2
    twins = zip(cells[:half], [*cells[half:], ["" for _ in head]], strict=False)
    halves = table(part.name, heading, [[*head, *head], *([*a, *b] for a, b in twins)], scene.style)
    return halves if halves.size[0] <= WIDEST else whole


def _rows(scene: Scene, part: Part) -> list[list[str]]:
    """Return quantities with what was measured; the senses of those that turn stand in a column of their own."""
    words = scene.words
    scale, paper = "scale_per_unit" if words.per_unit else "scale", words.unit(words.display.paper)
    head = [words[f"table.{key}"].format(unit=paper, paper=paper) for key in ("quantity", "segment", scale)]
    head += [words[f"table.{key}"] for key in ("value", "unit")]
    head += [words["table.angle"]] if words.notation["angles"] else []
    rows = [_row(scene, scene.quantities[name]) for name in part.names]
    senses = [_sense(scene, name) for name in part.names]
    if any(senses):
        none = words["table.calculated"]
        rows = [[*row, sense or none] for row, sense in zip(rows, senses, strict=True)]
        head.append(words["table.sense"])
    if scene.style.row:  # to be written in: units beside the quantities; headings of plans have the scale factors
        rows = [[f"{quantity}, {unit}", mm, value, *more] for quantity, mm, _, value, unit, *more in rows]
        head = [*head[:2], *head[3:UNIT], *head[UNIT + 1 :]]
    return [head, *rows]


def _sense(scene: Scene, name: str) -> str:
    """Return the sense of a turning or of a moment in short words; nothing for others, and for zero."""
    item, kind = scene.quantities[name], role(name).kind
    value = value_shown(scene, item) if kind in (*RATES, "M") else 0.0
    return _turning(scene, value)


def _turning(scene: Scene, value: float) -> str:
    if value == 0.0:
        return ""
    sense = "ccw" if value > 0.0 else "cw"
    return scene.words[f"short.{sense}" if scene.style.row else f"choice.{sense}"]


def _row(scene: Scene, q: Quantity) -> list[str]:
    words, none = scene.words, scene.words["table.calculated"]
    drawn = q if drawn_on(scene, q) in scene.scales else opposed(scene, q.name)  # its opposite is the same segment
    mm, mu, _ = ("", "", "") if drawn is None else printed_segment(scene, drawn)
    printed = [*((mm, mu) if mm else (none, none)), number(scene, q.name)]
    row = [words.symbol(q.name), *printed, words.unit(words.display.unit(q.unit))]
    if not words.notation["angles"]:
        return row
    if q.x is None or q.y is None or math.hypot(q.x, q.y) == 0.0:
        return [*row, none]
    return [*row, words.number(math.degrees(math.atan2(q.y, q.x)) % 360.0, 1)]


def _lever_rows(scene: Scene, part: Part) -> list[list[str]]:
    """Return the forces on the lever, their arms in mm, the moments of these as printed, and how they turn."""
    words, none = scene.words, scene.words["table.calculated"]
    newtons, paper = words.unit("N"), words.unit(words.display.paper)
    head = [words["table.quantity"], f"F, {newtons}", words["table.arm"], f"h, {paper}", f"F·h, {newtons}·{paper}"]
    rows, hung = [[*head, words["table.sense"]]], list(on_lever(scene))
    decimals = decimals_for(max(abs(one.moment) for one in hung), DIGITS + 1)
    for one in (one for one in hung if one.name in part.names):
        arm = [none, none] if one.arm is None else [one.arm.symbol, one.arm.text(words)]
        # what the others outweigh by far has a digit and its sense, as it has in the equation
        places = decimals if round(one.moment, decimals) else decimals_for(one.moment, 1)
        rows.append(
            [one.symbol, one.size, *arm, words.number(abs(one.moment), places), _turning(scene, one.moment) or none]
        )
    return rows


def structure_lines(scene: Scene) -> Lines:
    """Return mobility, groups and the formula of structure."""
    words, s = scene.words, scene.solved.structure
    lines: Lines = [
        (words["structure.count"].format(n=s.moving, p1=s.lower, p2=s.higher),),
        ("W = 3n − 2p_{1} − p_{2} =", f"3·{s.moving} − 2·{s.lower} − {s.higher} = {s.mobility}"),
    ]
    for group in s.groups:
        numbers = {"links": _links(group), "group_class": CLASSES[group.group_class], "order": group.order}
        parts = words["structure.group"].format(**numbers).split(", ")
        parts += [words[f"kind.{group.kind}"]] if group.kind in GROUPS else []
        lines.append((*(f"{part}," for part in parts[:-1]), parts[-1]))
    lines.append((words["structure.driver"].format(frame=words.frame, link=s.driver),))
    text, _, tail = words["structure.formula"].partition("{formula}")
    first, *rest = formula(s, words.frame)
    return [*lines, (text.strip(), first, *rest[:-1], *(f"{last}{tail}" for last in rest[-1:]))]


def formula(structure: Structure, frame: str = "0") -> list[str]:
    """Return the formula of structure in chunks: groups that hang on the same links before stand side by side, ∥."""
    chunks = [f"I({frame}, {structure.driver})"]
    level = {0: 0, structure.driver: 0}  # of each link the length of the chain that leads to it from the driver
    for group in structure.groups:
        level |= dict.fromkeys(group.links, 1 + max(level[number] for number in group.before))
    levels = groupby(sorted(structure.groups, key=lambda g: level[g.links[0]]), key=lambda g: level[g.links[0]])
    for _, groups in levels:
        texts = [f"{CLASSES[g.group_class]}_{{{g.view or g.order}}}({_links(g)})" for g in groups]
        chunks.append("→ " + " ∥ ".join(texts))
    return chunks


def _links(group: Group) -> str:
    return ", ".join(map(str, sorted(group.links)))
