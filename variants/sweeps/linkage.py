"""A linkage over its whole cycle: positions, dead positions, strokes, extremes; table, CSV, JSON, sheet."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...drawing.linkages.sheet import Contents, draw
from ...drawing.words import Words
from ...drawing.writers import Files, page_files
from ...plans.linkages.cycle import Curve, Cycle, Diagrams, cycle, diagrams
from ...plans.linkages.mechanism import Driver, Mechanism
from ...plans.linkages.strokes import Output, OutputMotion
from ...plans.names import role
from ...plans.quantities import BALANCES, unit_of
from ...plans.solved import Columned
from ...scales.errors import InputError, Option, PositionError
from ...scales.names import all_known, names_of, of_its_kinds, of_kind
from ...scales.units import parse, unit
from ..case import Case, positions_of
from ..kinds.linkage import placed
from ..many import parts_of
from ..sheets import Sheet, sheet_of, stamp_of
from ..tables import FILES, Result, Swept, aligned, ends_data
from ..task import LocatedError, Task, plain_number

SECTIONS = POSITIONS = 12
DRAWN = 36  # positions in a drawing: its letters take time as the square of their number, and stand on one another
DIGITS = 6  # of a number in the table
ROUGHLY = 4  # decimals of the angle of an extreme, near which values hardly change
ROUNDING = 1e-12  # part of the largest value of a column below which one is zero
CONSTANT = 1e-7  # part of its size within which a quantity does not change over the cycle
LESS_WANTED = ("h", "delta", "l")  # kinds of quantities whose extremes a reader hardly looks for


@dataclass(frozen=True, slots=True, repr=False)
class Sweep(Swept):
    """The whole cycle of one variant of a task.

    `cycle` holds positions, values and statuses as arrays in SI; `chosen` are the points and links that were asked for.
    Of a point or a link that is `compared`, the table shows the motion by plans and by chords.
    """

    cycle: Cycle
    chosen: tuple[str, ...]
    compared: str | None = None
    ends: tuple[float | None, float | None] = (None, None)  # where the driver begins and ends, as asked for

    @classmethod
    def of(
        cls,
        case: Case,
        positions: int | None,
        points: str | Iterable[str] | None,
        ends: tuple[str | float | None, str | float | None],
        chords: str | int | None,
    ) -> Sweep:
        """Solve a linkage over its whole cycle; refuse unknown points, no places, an end where a crank goes round."""
        mechanism = case.task.mechanism
        chosen, compared = names_of("points", points, (str, int)), None if chords is None else str(chords)
        asked = chosen if compared is None else (*chosen, compared)
        all_known("motion-unknown", asked, (*_letters(mechanism), *(str(link.number) for link in mechanism.links)))
        first, last = (_place(case.task, *item) for item in zip(("start", "end"), ends, strict=True))
        if last is not None and isinstance(mechanism.driver, Driver):
            raise InputError("sweep-end")
        values = case.values
        plans = (*case.plans, "position")  # a cycle is one of positions, whatever else is wanted
        count = POSITIONS if positions is None else positions
        return cls(
            case, case.words(), cycle(mechanism, values, plans, count, first, last), chosen, compared, (first, last)
        )

    @property
    def statuses(self) -> NDArray[np.str_]:
        """The status of each position, the words of `kulman.Status`."""
        return np.array(self.cycle.statuses)

    @property
    def status(self) -> str:
        """`ok` when some position has its plans, otherwise the status of all."""
        statuses = self.cycle.statuses
        return min(statuses, key=("ok", "ill-conditioned", "singular", "no-assembly").index)

    @property
    def reason(self) -> PositionError | None:
        """Why no position at all can be assembled, or None."""
        return None if self.cycle.reach.stretches else self.case.error()

    @of_its_kinds()
    def diagrams(self, of: str | int, sections: int = SECTIONS) -> Diagrams:
        """Return travel, velocity and acceleration of a point or a link, by plans and by chords.

        Parameters
        ----------
        of : str or int
            A point's letter, or the number of a link.
        sections : int
            Sections of the cycle for the chords.
        """
        return diagrams(self.cycle, str(of), positions_of(sections))

    def table(self, language: str | None = None) -> str:
        """Return the main columns position by position, then dead positions, strokes, extremes and what has no plan.

        Where a point or a link is compared, its motion by plans and by chords.
        """
        if self.compared is not None:
            return self.chords(self.compared, language)
        cycle, words = self.cycle, self._words(language)
        shown = _shown(cycle, _columns_of(cycle, self.chosen, whole=False), words)
        head = ["", *(f"{column.name}, {words.spelled(column.unit)}" for column in shown)]
        statuses = ["" if status == "ok" else words[f"status.{status}"] for status in cycle.statuses]
        rows = [[str(k), *(_cell(words, column, k) for column in shown), said] for k, said in enumerate(statuses)]
        motions = ("\n".join(_output(cycle, motion, words)) for motion in cycle.motions)
        apart = [(_at(cycle, words, arc.low), _at(cycle, words, arc.high)) for arc in cycle.reach.apart]
        limits = [words["sweep.apart"].format(low=low, high=high) for low, high in apart]
        limits += [words["sweep.change"].format(at=_at(cycle, words, x, ROUGHLY)) for x in cycle.reach.changes]
        limits += [words["sweep.pole"].format(at=_at(cycle, words, x)) for x in cycle.reach.poles]
        extremes = _extremes(cycle, self.chosen, words)
        parts = aligned([head, *rows], ()), "\n".join(limits), *motions, extremes
        return "\n\n".join(part for part in parts if part)

    def chords(self, of: str | int, language: str | None = None) -> str:
        """Return a table of the velocities and accelerations of a point or a link by plans and by chords."""
        drawn, words = self.diagrams(of, self.cycle.sections), self._words(language)
        velocity, acceleration = ("omega", "epsilon") if drawn.unit == "rad" else ("V", "a")
        parts = (velocity, f"{drawn.unit}/s", drawn.velocity), (acceleration, f"{drawn.unit}/s^2", drawn.acceleration)
        return "\n\n".join(_chords(f"{symbol}_{of}", unit_name, curve, words) for symbol, unit_name, curve in parts)

    def arrays(self, name: str = "") -> Iterator[Columned]:
        """Go through place and time of the driver, then all columns in SI, or find one."""
        columns = (*_driven(self.cycle), *_columns_of(self.cycle, self.chosen, whole=True))
        return (column for column in columns if name in ("", column.name))

    def _columns(self, words: Words) -> tuple[Sequence[Columned], Mapping[str, Sequence[str]]]:
        columns = _columns_of(self.cycle, self.chosen, whole=True)
        return _shown(self.cycle, columns, words), {"status": self.cycle.statuses}

    def _data(self) -> dict[str, Any]:
        """Return the cycle, of chosen points and links only, or of all."""
        cycle, turns = self.cycle, self.cycle.drive.turns
        names = _quantities_of(cycle, self.chosen)
        known = (point for point in _letters(cycle.mechanism) if point in cycle.values)
        points = [point for point in known if not self.chosen or point in self.chosen]
        kind, unit_name = ("crank", "rad") if turns else ("slider", "m")
        driver: dict[str, Any] = {"name": driver_name(cycle), "kind": kind, "unit": unit_name}
        return {
            "driver": driver | {"sense": cycle.drive.sense, "speed": cycle.speed, "zero": cycle.zero},
            "places": cycle.angles,
            "times": cycle.times,
            "statuses": cycle.statuses,
            "points": {name: {"unit": "m", **parts_of(cycle.values[name], point=True)} for name in points},
            "quantities": {name: {"unit": unit_of(name), **parts_of(cycle.values[name])} for name in names},
            "outputs": [_output_data(cycle, motion) for motion in cycle.motions],
            "extremes": {
                name: ends_data(unit_of(name), (most.value, most.at), (least.value, least.at))
                for name, (most, least) in cycle.extremes(names).items()
            },
            "unreachable": [{"from": arc.low, "to": arc.high} for arc in cycle.reach.apart],
            "change_points": cycle.reach.changes,
            "parallel_guides": cycle.reach.poles,
        }

    def _files(self, path: Path, drawn: Callable[[], Sheet]) -> Files:
        """Return all columns for tables, the drawing for other kinds of files."""
        return Result._files(self, path, drawn) if path.suffix.lower() in FILES else page_files(drawn().pages, path)

    @property
    def pictured(self) -> int:
        """How many positions the drawing shows: of very many every so manieth, else no line is told from another."""
        whole = len(self)
        return whole if whole <= DRAWN else next((n for n in range(DRAWN, 11, -1) if whole % n == 0), DRAWN)

    @property
    def warnings(self) -> tuple[InputError, ...]:
        """What a user of the drawing should know."""
        shown, whole = self.pictured, len(self)
        return (InputError("sweep-pictured", n=shown, whole=whole),) if shown < whole else ()

    def drawn(self) -> Sheet:
        """Return the sheet with the plan of positions and the diagrams by plans and by chords.

        Refused is a position of the task's own, which the plan of positions shows, that has no plan.
        """
        case, words = self.case, self.words
        error = case.error()
        if error is not None:
            raise error
        run = self.cycle
        if self.pictured < len(self):
            run = cycle(case.task.mechanism, case.values, (*case.plans, "position"), self.pictured, *self.ends)
        contents = Contents(placed(case), ("cycle",), case.choosers, case.givens, words, "gost", run, courses=True)
        return sheet_of(case, draw(contents), replace(stamp_of(case), identity="", series=1))

    def __repr__(self) -> str:
        """Return task, variant, the number of positions, and of how many there is a plan."""
        planned = sum(status in ("ok", "ill-conditioned") for status in self.cycle.statuses)
        return f"<Sweep {self.task.id} {self.variant}: {len(self.cycle.angles)} positions, {planned} with a plan>"


def _place(task: Task, name: str, value: str | float | None) -> float | None:
    """Return a place of the driver in SI; a number without a unit is in that of the task's given."""
    if value is None:
        return None
    of_kind(name, value, (str, int, float), "str | float")
    given, crank = task.givens.get(task.mechanism.driver.coordinate), isinstance(task.mechanism.driver, Driver)
    own = given.unit if given is not None and given.unit is not None else unit("deg" if crank else "mm")
    try:
        return parse(value, own, own) if isinstance(value, str) else plain_number(value, own)
    except InputError as error:
        raise LocatedError(Option({"start": "--from", "end": "--to"}[name], name), error) from error


def driver_name(cycle: Cycle) -> str:
    """Return the name of the driver's variable, `phi` or `s` where the task has a literal in its place."""
    variable = cycle.drive.variable
    return ("phi" if cycle.drive.turns else "s") if role(variable).hidden else variable


def _place_name(output: Output) -> str:
    """Return the name of an output's place: the travel of a slider, the angle of a rocker."""
    return f"{'s' if output.slides else 'phi'}_{output.link}"


def _output_columns(cycle: Cycle, output: Output) -> list[Columned]:
    """Return place, velocity and acceleration of a link on the frame, as far as the plans go."""
    if output.place not in cycle.values:
        return []
    place = Columned(_place_name(output), output.unit, output.places(cycle.values))
    rates = [(output.rate, "V", "m/s"), (output.change, "a", "m/s^2")]
    if not output.slides:
        rates = [(output.rate, "omega", "rad/s"), (output.change, "epsilon", "rad/s^2")]
    found = ((f"{symbol}_{output.link}", of, cycle.values.get(name or "")) for name, symbol, of in rates)
    return [place, *(Columned(name, of, values) for name, of, values in found if values is not None)]


def _columns_of(cycle: Cycle, chosen: tuple[str, ...], whole: bool) -> list[Columned]:
    """Return the columns of chosen points, by their letters, and links, by their numbers.

    Without any how the outputs move, and all points and quantities if `whole`, else what balances the driver.
    """
    outputs = {str(output.link): _output_columns(cycle, output) for output in cycle.outputs}
    points = [name for name in _letters(cycle.mechanism) if name in cycle.values]
    columns: list[Columned] = []
    for one in chosen or ("",):
        columns += outputs.get(one, []) if chosen else [column for found in outputs.values() for column in found]
        names: Iterable[str] = (one, f"V_{one}", f"a_{one}", f"omega_{one}", f"epsilon_{one}")
        if not chosen:
            names = (*points, *cycle.quantities) if whole else [name for name in BALANCES if name in cycle.values][:1]
        for name in names:
            if name in cycle.values and all(column.name != name for column in columns):
                for part, values in parts_of(cycle.values[name], name in points).items():
                    title = name if part == "value" else f"{name}.{part}"
                    columns.append(Columned(title, unit_of(name), values))
    return columns


def _letters(mechanism: Mechanism) -> tuple[str, ...]:
    """Return the letters of all points."""
    points = (point for link in mechanism.links for point in link.points)
    return tuple(dict.fromkeys((*mechanism.frame_points, *points)))


def _quantities_of(cycle: Cycle, chosen: tuple[str, ...]) -> tuple[str, ...]:
    """Return the quantities of what was chosen, or all."""
    wanted = {f"{symbol}_{one}" for one in chosen for symbol in ("V", "a", "omega", "epsilon")}
    return tuple(name for name in cycle.quantities if name in wanted or not chosen)


def _driven(cycle: Cycle) -> tuple[Columned, Columned]:
    """Return the driver's place, within a turn, and the time."""
    places, turn = cycle.angles, 2.0 * np.pi
    if cycle.drive.turns:
        places = np.where(np.abs(cycle.angles % turn - turn) < 1e-12, 0.0, cycle.angles % turn)
    return Columned(driver_name(cycle), "rad" if cycle.drive.turns else "m", places), Columned("t", "s", cycle.times)


def _shown(cycle: Cycle, columns: list[Columned], words: Words) -> list[Columned]:
    """Return the driver's place, the time and columns in the units of the words, angles in degrees."""
    shown: Callable[[Any, str], Any] = words.display.value
    degrees: Callable[[Any], Any] = unit("deg").from_si
    return [
        Columned(column.name, "deg", degrees(column.values))
        if column.unit == "rad"
        else Columned(column.name, words.display.unit(column.unit), shown(column.values, column.unit))
        for column in (*_driven(cycle), *columns)
    ]


def _cell(words: Words, column: Columned, k: int) -> str:
    """Return one value of a column less its rounding: beside the largest, and of angles, which at limits have more."""
    value = float(column.values[k])
    size = np.max(np.abs(column.values), initial=0.0, where=np.isfinite(column.values))
    if abs(value) <= ROUNDING * size:
        value = 0.0
    return _number(words, round(value, ROUGHLY) if column.unit == "deg" else value)


def _number(words: Words, value: float) -> str:
    return words.short(float(value) + 0.0, DIGITS) if math.isfinite(value) else "–"


def _output(cycle: Cycle, motion: OutputMotion, words: Words) -> Iterable[str]:
    """Say where an output stands dead, how far it moves and how its times compare."""
    output, name = motion.output, _place_name(motion.output)
    kind = words["sweep.slider" if output.slides else "sweep.rocker"].format(link=output.link)
    if motion.travel is None:
        yield f"{kind}: {words['sweep.round']}"
        return
    parted = len(cycle.reach.around(cycle.drive.start)) < len(cycle.reach.stretches)  # others cannot be reached from it
    stroke = words["sweep.stroke_here" if parted else "sweep.stroke"]
    yield f"{kind}: {stroke} {_amount(words, motion.travel.length, output.unit)}"
    if motion.dead:
        places = ((_at(cycle, words, spot.angle), _amount(words, spot.place, output.unit)) for spot in motion.dead)
        yield f"  {words['sweep.dead']}: {'; '.join(f'{at} ({name} = {place})' for at, place in places)}"
    if motion.ratio is not None:
        yield f"  {words['sweep.ratio']}: {words.short(motion.ratio, DIGITS)}"


def _at(cycle: Cycle, words: Words, place: float, decimals: int = 7) -> str:
    """Return a place of the driver, as `phi = 30°`."""
    name = driver_name(cycle)
    if cycle.drive.turns:
        return f"{name} = {words.short(round(math.degrees(place) % 360.0, decimals) % 360.0)}°"
    return f"{name} = {_amount(words, place, 'm')}"


def _amount(words: Words, value: float, of: str) -> str:
    """Return a value with its unit, angles in degrees."""
    if of == "rad":
        return f"{words.short(round(unit('deg').from_si(value), 7), DIGITS)}°"
    return words.amount(value, of, DIGITS)


def _extremes(cycle: Cycle, chosen: tuple[str, ...], words: Words) -> str:
    """Return the largest and smallest values with the driver's places, constants left out."""
    laws = {step.name: step.law for step in cycle.program}
    names = [name for name in _quantities_of(cycle, chosen) if role(name).kind not in LESS_WANTED]
    rows = [["", words["sweep.most"], "", words["sweep.least"], ""]]
    for name, (most, least) in cycle.extremes([name for name in names if laws[name] != "opposite"]).items():
        size = max(abs(most.value), abs(least.value))
        if not np.isfinite(size) or most.value - least.value > CONSTANT * size:
            of = unit_of(name)
            cells = [f"{name}, {words.spelled(words.display.unit(of))}"]
            for end in (most, least):
                endless, size = "∞" if end.value > 0.0 else "−∞", words.display.value(end.value, of) + 0.0
                cells.append(endless if math.isinf(end.value) else words.short(size, DIGITS))
                cells.append(_at(cycle, words, end.at, ROUGHLY))
            rows.append(cells)
    return aligned(rows, (0, 2, 4)) if len(rows) > 1 else ""


def _chords(name: str, of: str, curve: Curve, words: Words) -> str:
    """Return one curve by plans and by chords; of vectors the sizes, and the size of their difference."""
    shown = words.spelled(words.display.unit(of))
    seconds, per_cent = (words.spelled(x) for x in ("s", "%"))
    head = [f"t, {seconds}", f"{name} {words['sweep.plans']}, {shown}", words["sweep.chords"]]
    rows = [[*head, f"{words['sweep.difference']}, {per_cent}"]]
    for t, plan, chord, part in zip(curve.times, curve.plans, curve.chords, curve.per_cent, strict=True):
        values = (abs(x) if np.iscomplexobj(curve.plans) else x for x in (plan, chord))
        cells = (_number(words, words.display.value(float(x), of)) for x in values)
        rows.append([_number(words, t), *cells, words.number(part, 2) if math.isfinite(part) else "–"])
    return aligned(rows, ())


def _output_data(cycle: Cycle, motion: OutputMotion) -> dict[str, Any]:
    output, travel = motion.output, motion.travel
    return {
        "link": output.link,
        "kind": "slider" if output.slides else "rocker",
        "unit": output.unit,
        "places": output.places(cycle.values) if output.place in cycle.values else None,
        "dead": [
            {"at": spot.angle, "place": spot.place, "end": "high" if spot.high else "low"} for spot in motion.dead
        ],
        "stroke": None if travel is None else travel.length,
        "low": None if travel is None else {"at": travel.angle_low, "place": travel.low},
        "high": None if travel is None else {"at": travel.angle_high, "place": travel.high},
        "time_ratio": motion.ratio,
    }
