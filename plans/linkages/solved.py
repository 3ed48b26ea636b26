"""A mechanism solved in one position: structure, construction, values and quantities together."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from ...scales.errors import PositionError
from ..board import POSITION, Program
from ..boards.exact import SMALL, Trouble, run
from ..laws import cross
from ..names import LEVER, Name, inertia, rate, role, scale_factor, spelled, vector
from ..quantities import extent, plans_of, point_of, quantities
from ..solved import Solved, found_on
from . import compound
from .chain import USUAL, constructed, hinged
from .legs import guide_letters
from .loads import END, with_sizes
from .mechanism import FRAME, ZERO, Driver, Mechanism, Prismatic, SlidingDriver
from .structure import TRIAD, Structure, listed

if TYPE_CHECKING:
    from ..condition import Condition

DRIVER = "driver"  # the figure of the driver apart, which shows arms at a scale factor of its own
TWICE = 2.0  # how much better another centre of moments must be: it costs moments that else nobody needs


@dataclass(frozen=True, slots=True, kw_only=True)
class SolvedLinkage(Solved):
    """One position of a mechanism."""

    mechanism: Mechanism
    structure: Structure

    @property
    def extent(self) -> float:
        """The longest distance between lettered points of the links, m."""
        places = [self.point(point) for link in self.mechanism.links for point in link.points]
        return max((abs(a - b) for a in places for b in places), default=0.0)

    def guide_name(self, pair: Prismatic) -> str:
        """Return the name of the direction of a pair's guide."""
        names = (self.mechanism.pair("u", *links) for links in (pair.links, pair.links[::-1]))
        return next(name for name in names if name in self.values)

    def reason(self, trouble: Trouble) -> PositionError:
        """Return why the position has no plan."""
        step = self.program.by_name[trouble.name]
        if step.verb == "template":
            return self._template_error(trouble)
        if trouble.status == "no-assembly":
            return self._apart(trouble)
        if step.verb != "meet":
            pins = step.operands[0], step.operands[2 if step.verb == "arcs" else 1]  # which must not coincide
            return PositionError("singular-pins", status_word="singular", first=pins[0], second=pins[1])
        key = f"singular-{step.plan}" if step.plan in (POSITION, "velocity", "acceleration") else "singular-forces"
        first, second = (_spoken(step.operands[i], self.program) for i in (1, 3))
        return PositionError(key, status_word="singular", point=role(step.name).letters, first=first, second=second)

    def _template_error(self, trouble: Trouble) -> PositionError:
        """Return why the central link of a group of class III is not where its legs would hold it."""
        group = next(g for g in self.structure.groups if g.kind == TRIAD and trouble.name in g.joints)
        if trouble.status == "singular":
            legs = listed(group.legs)
            return PositionError("singular-triad", status_word="singular", link=group.central, legs=legs)
        from .following import Follower

        limits = Follower(self.mechanism, self._numbers).limits()
        data = {"link": group.central, "gap": f"{trouble.gap * 1e3:.4g}"}
        if limits is None:
            return PositionError("start-far", status_word="no-assembly", **data)
        slides = isinstance(self.mechanism.driver, SlidingDriver)
        data["low"], data["high"] = (f"{x * 1e3 if slides else math.degrees(x):.7g}" for x in limits)
        return PositionError("no-way-slide" if slides else "no-way", status_word="no-assembly", **data)

    def _apart(self, trouble: Trouble) -> PositionError:
        """Return by how much the links miss each other, and the places of the driver at which they just meet."""
        from .limits import limiting_places

        limits = limiting_places(self.mechanism, self._numbers)
        found = [place for place in limits or () if place is not None]
        data = {"point": point_of(self.program, trouble.name), "gap": f"{trouble.gap * 1e3:.4g}"}
        key = "no-assembly"
        if limits is not None and isinstance(self.mechanism.driver, SlidingDriver):
            key, data["places"] = "no-assembly-slide", ", ".join(f"{place * 1e3:.7g}" for place in found)
        elif limits is not None:
            key = "no-assembly-here"
            data["low"], data["high"] = (f"{math.degrees(angle) % 360.0:.7g}" for angle in found)
        return PositionError(key, status_word="no-assembly", **data)

    @property
    def scale_of_figure(self) -> Mapping[str, str]:
        """The symbols of the scale factors of Zhukovsky's lever and of a driver that turns, where they are drawn."""
        driver, plans = self.mechanism.driver, self.scale_of_plan
        apart = {DRIVER: f"{plans[POSITION]}_{driver.link}"} if POSITION in plans and isinstance(driver, Driver) else {}
        return apart | ({LEVER: scale_factor("h")} if LEVER in plans else {})

    @property
    def _numbers(self) -> dict[str, float]:
        return {name: value for name, value in self.values.items() if isinstance(value, float)}


def _scale_of_plan(structure: Structure, program: Program) -> dict[str, str]:
    """Return the symbol of the scale factor of every plan; a group and its links share one."""
    kinds = {POSITION: "l", "velocity": "V", "acceleration": "a", "lever": "V"}
    symbols: dict[str, str] = {Name(plan, plan): scale_factor(kind) for plan, kind in kinds.items()}
    for part, links in structure.parts.items():
        symbols |= {spelled("forces", name): scale_factor("F", part, links) for name in (part, *map(str, links))}
    drawn = program.plans
    for plan in drawn:  # at a point: of all velocities one, of the accelerations of each its own
        if role(plan).kind in (compound.VELOCITY, compound.ACCELERATION):
            own = role(plan).kind == compound.ACCELERATION
            symbols[plan] = scale_factor("a", role(plan).of) if own else scale_factor("V")
    return {plan: symbol for plan, symbol in symbols.items() if plan in drawn}


def _arms_of_driver(mechanism: Mechanism, program: Program) -> Iterator[str]:
    """Go through the arms about the driver's pivot of the forces on the driver, which its own figure shows."""
    driver = mechanism.driver
    if isinstance(driver, Driver):
        number = driver.link
        forces = {inertia("F", number), rate("G", number), *(load.name for load in mechanism.loads_on(number))}
        forces |= {mechanism.pair("R", link.number, number) for link in mechanism.links}
        moments = (step for step in program.which(("moment",)) if step.operands[2] == driver.pivot)
        taken = {step.name for step in moments if step.operands[0] in forces}
        yield from (step.name for step in program.which(("arm",)) if step.operands[0] in taken)


def scale_symbols(structure: Structure, program: Program) -> tuple[str, ...]:
    """Return the symbols of all scale factors that a task or a user may choose."""
    forces = (scale_factor("F", part, links) for part, links in structure.parts.items())
    symbols = (*map(scale_factor, ("l", "V", "a", "h")), *forces, *_scale_of_plan(structure, program).values())
    return tuple(dict.fromkeys(symbols))


def disagreement(solved: SolvedLinkage) -> float | None:
    """Return by how much compound motion and the plans differ, in parts of the longest vectors; None without both."""
    worst = None
    if solved.trouble is not None or not any(role(plan).kind == compound.ACCELERATION for plan in solved.program.plans):
        return None
    found = hinged(solved.mechanism, solved.structure)
    for c, point, letter in ((coupler, *pair) for coupler in found for pair in coupler.letters.items()):
        for kind, parts in compound.COMPOUND.items():
            vectors = (vector(kind, c.hinge), *(vector(kind, letter, part=part) for part in parts))
            longest = max(solved.size(name) for name in vectors)
            gap = abs(solved.point(vector(kind, letter, part=compound.TOTAL).size) - solved.point(vector(kind, point)))
            worst = max(worst or 0.0, gap / (longest or 1.0))
    return worst


def _moment_points(mechanism: Mechanism, structure: Structure) -> dict[str, str]:
    """Return the points about which the moments of prismatic pairs are taken, by the moments' names."""
    pairs = [(pair, group.pin(pair)) for group in structure.groups for pair in (*group.inner, *group.outer)]
    if isinstance(mechanism.driver, SlidingDriver):
        driver = mechanism.driver
        pairs += [(pair, driver.point) for pair in mechanism.pairs if {*pair.links} == {FRAME, driver.link}]
    sliding = [(pair.links, point) for pair, point in pairs if isinstance(pair, Prismatic)]
    return {mechanism.pair("M", *links): point for both, point in sliding for links in (both, both[::-1])}


def _spoken(direction: str, program: Program) -> str:
    """Return a direction as it is written in equations: normal to AB, along AB, along the guide x-x."""
    line, letters = role(direction), guide_letters(program)
    guide = line.of if line.kind == "n" else line
    return {"n": "⊥", "e": "∥", "u": "∥"}[line.kind] + letters.get(guide, line.letters)


def solve_linkage(mechanism: Mechanism, values: Mapping[str, float], plans: Iterable[str] = USUAL) -> SolvedLinkage:
    """Solve one position of `mechanism`.

    The `values` are its numbers in SI by name; the `plans` wanted, of `chain.PLANS`, come with those that they need, no
    others. The status is `singular` or `no-assembly` when the position has no plan; what is undefined is None.
    """
    plans = tuple(plans)
    if mechanism.starts:  # groups of class III need arrays, and so numpy, on the way from their start
        from .following import followed, with_special_points

        near = followed(mechanism, values)
        mechanism, values = with_special_points(mechanism, values, near), {**values, **near}
    structure, program = constructed(mechanism, plans)
    givens = board_givens(mechanism, values, program, follow=False)
    board = run(program, givens)
    better = _with_moment_centres(mechanism, structure, board.values) if "forces" in plans else mechanism
    if better is not mechanism:
        mechanism, program = better, constructed(better, plans)[1]
        board = run(program, givens)
    lengths = {x: values[x] for x in mechanism.coordinates if x != ZERO and not role(x).hidden}
    items = quantities(program, board.values, lengths)
    for name, point in _moment_points(mechanism, structure).items():
        if name in items:
            items[name] = replace(items[name], about=point)
    found = found_on(board, program, {})
    found["shown_on"] |= dict.fromkeys(_arms_of_driver(mechanism, program), DRIVER)
    return SolvedLinkage(
        mechanism=mechanism,
        structure=structure,
        **{**found, "scale_of_plan": _scale_of_plan(structure, program)},
        quantities=items,
        givens=givens,
    )


def read_by_ruler(solved: SolvedLinkage, mus: Mapping[str, float]) -> SolvedLinkage:
    """Return a mechanism solved anew as it is drawn with scale factors by plan, SI per mm, and read with a ruler."""
    from ..hands.shaky import RulerBoard, drawing_of

    board = RulerBoard(drawing_of(solved, mus))
    board.follow(solved.program)
    lengths = {name: item.value or 0.0 for name, item in solved.quantities.items() if name in solved.givens}
    items = quantities(solved.program, board.values, lengths)
    items = {name: replace(item, about=solved.quantities[name].about) for name, item in items.items()}
    return replace(solved, values=board.values, quantities=items, sines=board.sines)


def board_givens(
    mechanism: Mechanism, values: Mapping[str, Any], program: Program | None = None, follow: bool = True
) -> dict[str, Any]:
    """Return `values` as the board wants them.

    Sizes of loads have names of their own there. Groups of class III are followed from their starts, unless the
    `values` say already where they lie. Where `program` needs the ends of the working stroke, these are found first.

    Raises InputError: a load diagram whose places decrease, or an output without a stroke.
    """
    if mechanism.starts and follow:
        from .following import followed  # which needs numpy, and few mechanisms need it

        values = {**values, **followed(mechanism, values)}
    givens = with_sizes(mechanism, values)
    if program is None or END not in program.needs or END in values:
        return givens
    from .strokes import stroke_ends  # which needs numpy, and givens of its own for the sweep

    return {**givens, **stroke_ends(mechanism, values)}


def _with_moment_centres(mechanism: Mechanism, structure: Structure, values: Mapping[str, Any]) -> Mechanism:
    """Return the mechanism with joints chosen about which moments of whole RRR dyads are taken; itself where none is.

    The plan of forces is closed by the parallels to AB and CB, which meet at the angle of the links. Where A and C
    stand close together beside B, both links are nearly parallel. Moments of the whole group about C give the part of
    R_12 normal to CA, so that the parallel to CA may take the place of that to CB, and it meets AB at the angle of the
    triangle ABC in A; about A likewise at that in C. The largest of the three sines is opposite to the longest side.

    The `values` are those of a run of its construction in one position: the joints of all groups.
    """
    found = []
    for group in (group for group in structure.groups if group.kind == "RRR"):
        A, C = (pair.point for pair in group.outer)
        at_a, at_b, at_c = _sines_of(*(complex(values[point]) for point in (A, group.inner[0].point, C)))
        if at_b < SMALL and max(at_a, at_c) >= TWICE * at_b:
            found.append((group.name, C if at_a >= at_c else A))
    return replace(mechanism, centres=tuple(found)) if found else mechanism


def _sines_of(a: complex, b: complex, c: complex) -> tuple[float, ...]:
    """Return the sines of the angles of a triangle in A, B and C; NaN where two corners coincide."""
    doubled = abs(cross(b - a, c - a))
    sides = [abs(c - b), abs(a - c), abs(b - a)]
    product = sides[0] * sides[1] * sides[2]
    if not product > 0.0:
        return (math.nan,) * 3
    return tuple(doubled * side / product for side in sides)


def signs(mechanism: Mechanism) -> frozenset[str]:
    """Return the names of givens that are +1 or -1: senses and branches. They do not err."""
    names = [pair.branch for pair in mechanism.pairs] + [couple.sense for couple in mechanism.couples]
    names += [getattr(mechanism.driver, "sense", None), mechanism.stroke.sense if mechanism.stroke else None]
    return frozenset(name for name in names if name is not None)


def varied(solved: SolvedLinkage) -> tuple[str, ...]:
    """Return the givens that may err: numbers other than zero that are no signs; ends of the stroke count as givens."""
    fixed = signs(solved.mechanism)
    return tuple(name for name, value in solved.givens.items() if name not in fixed and value)


def conditions_of(solved: SolvedLinkage) -> dict[str, Condition]:
    """Return the condition of every quantity; given lengths are their own."""
    from ..condition import Condition, conditions  # which needs numpy, and plain solutions do without

    found = conditions(solved.program, solved.givens, varied(solved), solved.values, solved.sines)
    size = extent(solved.program, solved.values)
    for name, quantity in solved.quantities.items():
        if name not in found:
            found[name] = Condition(abs(quantity.value or 0.0) / size if size else None, 1.0)
    return {name: found[name] for name in solved.quantities}


def worst_condition(solved: SolvedLinkage, plan: str | None = None) -> tuple[str, float]:
    """Return the quantity of the largest condition, of those that `plan` or any plan shows, and that condition.

    What is only calculated may lose its digits because it passes zero: that says nothing of the position.
    """
    shown, conditions = plans_of(solved.program), conditions_of(solved)
    names = [name for name in conditions if name in shown and plan in (None, shown[name])]
    value, name = max(((conditions[name].value or 0.0, name) for name in names), default=(0.0, ""))
    return name, value
