"""New variants of a task: made from ranges, or read from a spreadsheet as departments keep them; as a task file."""

from __future__ import annotations

import json
import math
import os
import random
import re
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from decimal import Decimal
from functools import cache
from itertools import starmap
from pathlib import Path

from ...drawing.writers import slug
from ...scales.errors import LANGUAGES, InputError, KulmanError, Written, as_one
from ...scales.names import by_name, unknown_given
from ...scales.numbers import SHOWN, quote
from ...scales.packaged import packaged
from ...scales.units import parse
from ..case import Request, Settings, Tie, far, kind_of
from ..crew import Advance
from ..reader import TaskFileError, load_task, task_of
from ..sheets import draw_case
from ..spreadsheets.files import read_grid
from ..spreadsheets.grid import UNDERSTOOD, Grid, about_kind, column_kind, number_said, symbol
from ..task import AnyTask, Given, LocatedError, Task

MOST = 1000  # variants that are made at once
AROUND = 0.2  # a given that all variants have alike is varied by so much to either side, if there is one variant alone
STEPS = 20  # into how many steps such a range is divided, at most
TRIES = 50  # sets looked at for each variant that is wanted
Judgement = tuple[KulmanError | None, KulmanError | None]
_NUMBER = re.compile(r"[-−+0-9.,\s]+(?:[eE][-+]?\d+)?")
_PARTED = re.compile(r"[,:;()\[\]]")  # parts of a header: what it is, its symbol, its unit
PLAIN = "1"  # a unit of numbers that have none
NOTHING = frozenset(UNDERSTOOD["none"])  # in the place of a unit
_BETWEEN = re.compile(r"\.\.\.?|…|–")  # the first and the last value of a range
_STEP = re.compile(r"/(?!\s*[^\W\d])")  # what its step stands behind: no slash of a unit, rad/s, 1/s
_UNIT = re.compile(r"[\s\d.,+\-−]*?(?:\d[eE][+-]?\d+)?\s*((?:1/)?(?:[^\W\d]|°).*)?$", re.DOTALL)  # behind a number
_HEADER = re.compile(r"\s*\[")
_VARIANT = re.compile(r"\s*\[\[\s*variant\s*\]\]|\s*\[\s*variant\s*\.")
_ARRAY = re.compile(r"\s*variant\s*=\s*\[")
_SOURCE = re.compile("^source = .*", re.MULTILINE)
_STRING = re.compile(r'"(?:\\.|[^"\\])*"|\'[^\']*\'')


@dataclass(frozen=True, slots=True)
class NewVariants:
    """A task with new variants, the text of its file, and what is wrong with those left out or kept all the same."""

    task: Task
    text: str
    left_out: tuple[KulmanError, ...] = ()
    remarks: tuple[KulmanError, ...] = ()


def make_variants(
    task: AnyTask,
    count: int,
    ranges: Settings | None,
    *,
    set: Settings | None,
    seed: int,
    advance: Advance | None,
) -> NewVariants:
    """Make so many variants from ranges, each a good exercise: it can be solved and drawn without a warning.

    A crank turns round, lines meet at angles over 20 degrees, plans fit at the scale factors that the task wants, and
    what the task's kind calls good design holds. A centre of mass divides its link as in the task's variants, and
    each states the givens that one of these does. Ranges, `{"l_OA": "25..60/5 mm"}`, say from, to, and a step; of other
    givens they are what the task's variants span; those in `set` all have alike. The same seed gives the same variants.
    Where too few sets are good an error says what was wrong last.
    """
    found = load_task(task)
    if not 1 <= count <= MOST:
        raise InputError("variants-count", n=MOST)
    fixed = {name: str(value) for name, value in by_name("set", set).items()}
    found.resolve(None, fixed)
    spans = _ranges_of(found, {name: str(text) for name, text in by_name("ranges", ranges).items()})
    luck, seen, pages = random.Random(seed), dict[tuple[str, ...], None](), _most_pages(found)
    rows: dict[str, Mapping[str, str]] = {}
    asked = {*fixed, *(ranges or {})}
    models = _models(found, asked)
    ties = {name: tie for name, tie in kind_of(found.kind).ties(found).items() if name not in asked}
    for number in range(count):
        reason: KulmanError | None = InputError("variants-few", found=number)
        for _ in range(TRIES):
            model, kept = models[0] if len(models) == 1 else luck.choice(models)
            row = {name: kept.get(name) or spans[name].pick(luck) for name in kept if name not in fixed}
            row |= fixed
            for name, tie in ties.items():
                row[name] = spans[name].tied(found.givens[tie.whole], row[tie.whole], tie, luck)
            if tuple(row.values()) in seen:
                continue
            seen[tuple(row.values())] = None
            reason = next(filter(None, _looked_at(found, model, row, pages, through=False)), None)
            if reason is None:
                rows[str(number + 1)] = row
                break
        else:
            assert reason is not None
            if reason.key != "variants-few":
                reason = InputError("variants-hard", found=number, tries=TRIES, reason=reason)
            raise LocatedError(f"--make {count}", reason)
        if advance is not None:
            advance(1, count)
    return _task_with(found, rows)


def import_variants(task: AnyTask, file: str | os.PathLike[str], set: Settings | None = None) -> NewVariants:
    """Read variants from a spreadsheet; those that have no solution are left out and named, unless none has one.

    Givens in `set` all have alike, whatever the table says of them. What it says of no given is named.
    """
    found = load_task(task)
    fixed = {name: str(value) for name, value in by_name("set", set).items()}
    found.resolve(None, fixed)
    fixed = {name: _stated(found.givens[name], text) for name, text in fixed.items()}
    rows: dict[str, Mapping[str, str]] = {}
    pages = _most_pages(found)
    left_out: list[KulmanError] = []
    table = _table(os.fspath(file), found)
    remarks: list[KulmanError] = [*table.grid.unread, *table.unread]
    for read in _read_variants(table, found, fixed):
        reasons, remark = _judged(found, read, pages)
        if not reasons and read.id in rows:
            reasons = (LocatedError(read.place, InputError("variant-twice")),)
        left_out.extend(reasons)
        remarks.extend(remark)
        if not reasons:
            rows[read.id] = read.row
    if not rows:
        raise as_one([*left_out, *table.unread] or [InputError("answers-empty", file=quote(os.fspath(file)))])
    return replace(_task_with(found, rows), left_out=tuple(left_out), remarks=tuple(remarks))


def _judged(
    task: Task, read: _Read, pages: Callable[[], int]
) -> tuple[tuple[KulmanError, ...], tuple[KulmanError, ...]]:
    """Return why a variant is left out, if it is, and what makes it a poor exercise, with the place."""
    if read.problems:
        return read.problems, ()
    try:
        alone = _task_with(task, {read.id: read.row}).task
    except TaskFileError as error:
        causes = [fault.cause if isinstance(fault, LocatedError) else fault for fault in error.faults]
        # a spreadsheet has no lines and keys
        missing = ", ".join(cause.data["name"] for cause in causes if cause.key == "key-missing")
        plain: list[KulmanError] = [InputError("variants-missing", name=missing)] * bool(missing)
        plain += [cause for cause in causes if cause.key != "key-missing"]
        return tuple(LocatedError(read.place, cause) for cause in plain), ()
    reason, remark = (
        () if one is None else (LocatedError(read.place, one),) for one in _looked_at(alone, read.id, {}, pages)
    )
    others = (LocatedError(read.place, one) for one in far(task, alone.resolve(read.id)))
    return reason, (*others, *remark)


def _task_with(task: Task, rows: Mapping[str, Mapping[str, str]]) -> NewVariants:
    """Return a task with other variants; one that is no variant of the task is a `TaskFileError`."""
    text = _with_variants(task.text, rows.items())
    if task.file is None:  # a bundled one, whose source has not these data
        own = ", ".join(f'{one} = "{packaged(__package__, "texts", one)["source"]}"' for one in LANGUAGES)
        text = _SOURCE.sub(f"source = {{ {own} }}", text, count=1)
    return NewVariants(task_of(text, task.file or f"{task.id}.toml"), text)


@dataclass(frozen=True, slots=True)
class _Range:
    """A given's values: from `low` to `high` in steps, in its own unit; exact decimals.

    Where a standard has a `row` of values, only these. Of what is counted low and step are whole.
    """

    unit: str
    low: Decimal
    high: Decimal
    step: Decimal
    row: tuple[Decimal, ...] = ()

    def pick(self, luck: random.Random) -> str:
        """Return one of the values as it is written."""
        row = [value for value in self.row if self.low <= value <= self.high]
        count = int((self.high - self.low) / self.step) if self.step else 0
        value = luck.choice(row) if row else self.low + luck.randint(0, count) * self.step
        return f"{value.normalize():f} {self.unit}".strip()

    def tied(self, whole: Given, text: str, tie: Tie, luck: random.Random) -> str:
        """Return a value, as it is written, that is such a part of the `whole` as the task's variants have."""
        assert whole.unit is not None
        size = whole.read(text)
        assert isinstance(size, float)
        low, high = (_decimal(part * whole.unit.from_si(size)) for part in (tie.least, tie.most))
        # of the range's own steps where there are any between
        first = self.low + (math.ceil((low - self.low) / self.step) * self.step if self.step else 0)
        if not low <= first <= high:
            first = high = low
        return replace(self, low=first, high=high if self.step else first).pick(luck)


def _models(task: Task, asked: Collection[str]) -> list[tuple[str, dict[str, str]]]:
    """Return variants that state different givens, or choose other words, each with what is to be stated like it.

    Words, and what is endless, are kept; of other givens, those `asked` for among them, nothing is said.
    """
    found: dict[tuple[tuple[str, str], ...], str] = {}
    for variant in task.variants.values():
        stated = dict.fromkeys(name for name in task.givens if name in variant.values or name in asked)
        for said, others in task.instead:
            if said <= {*asked}:
                stated = dict.fromkeys(name for name in stated if name not in others or name in asked)
        values = ((name, variant.values.get(name, "")) for name in stated)
        kept = {name: str(value) if isinstance(value, str) or math.isinf(value) else "" for name, value in values}
        found.setdefault(tuple(kept.items()), variant.id)
    return [(name, dict(kept)) for kept, name in found.items()]


def _ranges_of(task: Task, asked: Mapping[str, str]) -> dict[str, _Range]:
    """Return the range of every given: as `asked`, such as `25..60/5 mm`, else what the task's variants span."""
    found = {name: _spanned(task, name, given) for name, given in task.givens.items() if given.unit is not None}
    for name, parameter in kind_of(task.kind).givens.items():
        one, given = found.get(name), task.givens.get(name)
        if one is not None and given is not None and given.unit is not None:
            found[name] = replace(one, row=tuple(_decimal(given.unit.from_si(value)) for value in parameter.row))
            if parameter.whole:
                found[name] = replace(one, low=Decimal(math.ceil(one.low)), step=Decimal(math.ceil(one.step)))
    for name, text in asked.items():
        given = task.givens.get(name)
        if given is None:
            raise unknown_given(name, found, task.id)
        if given.unit is None:
            raise LocatedError(name, InputError("range-given", known=", ".join(found)))
        try:
            found[name] = _read(given, text, found.get(name))
        except InputError as error:
            raise LocatedError(name, error) from error
    return {name: one for name, one in found.items() if one is not None}


def _read(given: Given, text: str, usual: _Range | None) -> _Range:
    """Read a range."""
    assert given.unit is not None
    between = _BETWEEN.search(text.strip(), 1)
    if between is None:
        raise InputError("range-bad", text=quote(text))
    parts = [text.strip()[: between.start()], *_STEP.split(text.strip()[between.end() :], maxsplit=1)]
    if not all(part.strip() for part in parts):
        raise InputError("range-bad", text=quote(text))
    low, high, *steps = _values(given, [part.strip() for part in parts])
    step = steps[0] if steps else None
    if low > high or (step is not None and step <= 0):
        raise InputError("range-bad", text=quote(text))
    row = usual.row if usual is not None and step is None else ()
    if step is None:
        step = usual.step if usual is not None and 0 < usual.step <= high - low else _round_step(high - low)
    return _Range(given.unit.behind, low, high, step, row)


def _values(given: Given, parts: Sequence[str]) -> Iterator[Decimal]:
    """Go through the values of the parts of a range, in the unit of the last of them where one has none."""
    units = [found[1] or "" if (found := _UNIT.match(part)) else "" for part in parts]
    assert given.unit is not None
    for part, own in zip(parts, units, strict=True):
        value = given.read(part if own else f"{part} {units[-1] or units[-2]}".strip())
        assert isinstance(value, float)
        yield _decimal(given.unit.from_si(value))


def _spanned(task: Task, name: str, given: Given) -> _Range | None:
    """Return what a given's values span in the variants of a task; None where no variant states it."""
    assert given.unit is not None
    stated = [row.values[name] for row in task.variants.values() if name in row.values]
    values = sorted(
        {_decimal(given.unit.from_si(value)) for value in stated if isinstance(value, float) and math.isfinite(value)}
    )
    if not values:
        return None
    low, high = values[0], values[-1]
    if len(task.variants) == 1:
        spread = abs(low) * Decimal(str(AROUND))
        step = _round_step(2 * spread)
        low, high = (math.ceil(low / step - spread / step) * step, high + spread) if step else (low, high)
        return _Range(given.unit.behind, low, high, step)
    if len(values) == len(task.variants) == 2:  # which say nothing of a step
        step = _round_step(high - low)
        return _Range(given.unit.behind, math.ceil(low / step) * step, high, step)
    apart = [value - low for value in values]  # the largest step in which all are whole; 0 for one value
    places = max((max(-int(value.as_tuple().exponent), 0) for value in apart), default=0)
    whole = math.gcd(*(int(value.scaleb(places)) for value in apart))
    return _Range(given.unit.behind, low, high, Decimal(whole).scaleb(-places))


def _decimal(value: float) -> Decimal:
    return Decimal(f"{value:.12g}")


def _round_step(width: Decimal) -> Decimal:
    """Return a step of 1, 2 or 5 that divides a width into some twenty."""
    if width == 0:
        return Decimal(0)
    rough = width / STEPS
    power = Decimal(10) ** rough.adjusted()
    return next(step * power for step in map(Decimal, (1, 2, 5, 10)) if step * power >= rough)


def _looked_at(
    task: Task, variant: str, settings: Settings, pages: Callable[[], int], through: bool = True
) -> Judgement:
    """Return why data have no solution or no sheet, and what makes them a poor exercise; None where nothing does.

    A sheet may have so many `pages`. Unless `through`, what makes a poor exercise is not drawn, or no further.
    """
    try:
        case = Request(task, variant, settings, as_wanted=not through).case()
        remark = next(case.kind.unfit(case), None)
        if remark is not None and not through:
            return None, remark
        try:
            drawn = draw_case(case)
        except InputError as error:
            if error.key != "variant-room" or pages() <= case.kind.pages:
                raise
            drawn = draw_case(replace(case, as_wanted=False))  # the task's own sheet does not fit a page either
    except KulmanError as error:
        return error, None
    if remark is None and len(drawn.pages) > case.kind.pages:
        most = pages()
        if len(drawn.pages) > most:
            remark = InputError("variant-pages", n=len(drawn.pages), most=most)
    return None, remark or next(iter(drawn.warnings), None)


def _most_pages(task: Task) -> Callable[[], int]:
    """Return what says how many pages a good sheet has at most: as many as that of the task's own first variant."""

    @cache
    def own() -> int:
        least = kind_of(task.kind).pages
        try:
            return max(least, len(draw_case(Request(task).case()).pages))
        except KulmanError:
            return least

    return own


def _with_variants(text: str, rows: Iterable[tuple[str, Mapping[str, str]]]) -> str:
    """Return the text of a task file with `rows` in the place of its variants: ids, and givens as they are written."""
    kept, inside, depth = [], False, 0
    for line in text.splitlines():
        if depth or _ARRAY.match(line):  # variant = [ ... ]
            plain = _STRING.sub("", line).partition("#")[0]
            depth += plain.count("[") - plain.count("]")
            continue
        if _HEADER.match(line):
            inside = _VARIANT.match(line) is not None
        if not inside:
            kept.append(line)
    whole = "\n".join(kept).rstrip("\n")

    def stated(name: str, text: str) -> str:  # a basic string of TOML
        return f"{name} = {json.dumps(text, ensure_ascii=False)}".replace("\x7f", "\\u007F")

    tables = ("\n".join(("[[variant]]", stated("id", number), *starmap(stated, row.items()))) for number, row in rows)
    return "\n\n".join((whole, *tables)) + "\n"


@dataclass(frozen=True, slots=True)
class _Read:
    """One variant of a spreadsheet: its givens as they are written, and what is wrong with its cells."""

    id: str
    place: str
    row: Mapping[str, str]
    problems: tuple[InputError, ...]


@dataclass(frozen=True, slots=True)
class _Table:
    """The cells of a grid seen so that variants are rows; `turned`: it lay on its side.

    The header stands in the row `head`, where most givens are named; `names` are these by column, with the units that
    stand beside them.
    """

    grid: Grid
    cells: Sequence[Sequence[str]]
    turned: bool
    head: int
    names: Mapping[int, tuple[str, str]]

    def place(self, row: int, column: int) -> str:
        """Return the address of a cell."""
        return self.grid.place(*((column, row) if self.turned else (row, column)))

    @property
    def unread(self) -> list[KulmanError]:
        """What stands over numbers and names no given."""
        numbers = {at for row in self.rows for at, text in enumerate(self.cells[row]) if _NUMBER.fullmatch(text)}
        heads = [
            quote(text, SHOWN)
            for at, text in enumerate(self.cells[self.head])
            if at in numbers and any(map(str.isalpha, text)) and at not in self.names and at > self.id_column
        ]
        told = {"file": quote(Path(self.grid.file).name, SHOWN), "names": Written(", ".join(heads))}
        return [InputError("variants-unread", **told)] if heads else []

    @property
    def rows(self) -> range:
        """The rows under the header."""
        return range(self.head + 1, len(self.cells))

    @property
    def id_column(self) -> int:
        """Where the ids of the variants stand: under such a word, else before the first given where all differ."""
        said = (column for column, text in enumerate(self.cells[self.head]) if about_kind(text) == "variant")
        rows = [self.cells[row] for row in self.rows]
        numbered = [row for row in rows if any(_NUMBER.fullmatch(row[at]) for at in self.names)]
        before = range(min(self.names) - 1, -1, -1)  # the nearest one that tells the rows with numbers apart
        ids = ({row[column] for row in numbered} for column in before)
        apart = (
            at for at, found in zip(before, ids, strict=True) if "" not in found and len(found) == len(numbered) > 0
        )
        return next(said, next(apart, max(min(self.names) - 1, 0)))


def _table(file: str, task: Task) -> _Table:
    """Read the table of a task's variants, .csv or .xlsx: a row, or a column, names the givens, `l_OA [mm]`."""
    grid = read_grid(file)
    table = max((_seen(grid, task, turned) for turned in (False, True)), key=lambda seen: len(seen.names))
    if not table.names:
        raise InputError("variants-header", file=quote(grid.file, SHOWN), known=", ".join(task.givens))
    return table


def _read_variants(table: _Table, task: Task, fixed: Mapping[str, str]) -> list[_Read]:
    """Read the variants of a table, with what is `fixed` for all; beside the names units may stand."""
    column, units = table.id_column, dict[int, str]()
    found: list[_Read] = []
    for row in table.rows:
        cells = table.cells[row]
        if not any(cells[at] for at in table.names):
            continue
        # the units of the givens: the row says so, or units of theirs stand there, and no number
        said = [(cells[at], task.givens[name]) for at, (name, _) in table.names.items()]
        of_units = any(_is_unit(*one) for one in said) and not any(re.match(r"[-−+]?[0-9]", text) for text, _ in said)
        if of_units or column_kind(cells[column]) == "unit":
            units = {at: cells[at] for at in table.names if cells[at] not in NOTHING}
            continue
        name = slug(number_said(cells[column])) if column not in table.names else ""
        found.append(_read_row(table, row, name if name not in ("", "x") else str(len(found) + 1), units, task, fixed))
    return found


def _is_unit(text: str, given: Given) -> bool:
    """Whether a text is a unit in which a given can be written."""
    if given.unit is None or not text or text[0].isdigit():
        return False
    try:
        parse(f"1 {text}", given.unit)
    except InputError:
        return False
    return True


def _seen(grid: Grid, task: Task, turned: bool) -> _Table:
    """Look at a grid with variants in rows, or in columns; merged cells all show what the first one does."""
    width = max(map(len, grid.rows), default=0)
    cells = [[grid.shared(row, column).strip() for column in range(width)] for row in range(len(grid.rows))]
    written = [[*row, *[""] * (width - len(row))] for row in grid.rows]
    if turned:
        cells, written = ([list(column) for column in zip(*rows, strict=True)] for rows in (cells, written))
    symbols = {symbol(name): name for name in task.givens}
    small = [letters.lower() for letters in symbols]
    # in small letters, too, where these tell them apart
    known = {letters.lower(): name for letters, name in symbols.items() if small.count(letters.lower()) == 1} | symbols
    heads = [_names(row, task, known) for row in written]
    best = max(range(len(heads)), key=lambda at: (len(heads[at]), -at), default=0)
    return _Table(grid, cells, turned, best, heads[best] if heads else {})


def _names(cells: Sequence[str], task: Task, known: Mapping[str, str]) -> dict[int, tuple[str, str]]:
    """Return the givens that cells name, with the units that stand beside them."""
    found: dict[int, tuple[str, str]] = {}
    for column, text in enumerate(cells):
        parts = [part.strip() for part in _PARTED.split(text) if part.strip()]
        named = ((at, name) for at, part in enumerate(parts) if (name := _named(part, at == 0, known)))
        at, name = next(named, (0, ""))
        if name and name not in (given for given, _ in found.values()):
            # a part of the header that is a unit, else what stands behind the name, to be refused with a value
            behind = parts[-1] if at < len(parts) - 1 else ""
            others = (part for part in (*parts[at + 1 :], *parts[:at]) if _is_unit(part, task.givens[name]))
            found[column] = name, next(others, behind)
    return found


def _named(part: str, first: bool, known: Mapping[str, str]) -> str:
    """Return the given that a part of a header names: as a whole, or as one of its words, `Маса шатуна m_2`."""
    whole = symbol(part)
    if len(whole) > 1 or first:
        name = known.get(whole) or known.get(whole.lower())
        if name:
            return name
    words = {known[letters] for word in part.split() if len(letters := symbol(word)) > 1 and letters in known}
    return words.pop() if len(words) == 1 else ""


def _stated(given: Given, text: str) -> str:
    """Return a value as a task file has it, a decimal point, the given's own unit; a word as it is."""
    value = given.read(text)
    if given.unit is None or isinstance(value, str):
        return text
    return f"{given.unit.from_si(value):.12g} {given.unit.behind}".strip()


def _read_row(
    table: _Table, row: int, number: str, units: Mapping[int, str], task: Task, fixed: Mapping[str, str]
) -> _Read:
    """Read one variant."""
    stated = dict(fixed)
    problems: list[InputError] = []
    for column, (name, unit) in table.names.items():
        text, unit, given = table.cells[row][column], unit or units.get(column, ""), task.givens[name]
        if text and name not in fixed:
            stated[name] = f"{text} {unit}" if unit not in ("", PLAIN) and _NUMBER.fullmatch(text) else text
            try:
                stated[name] = _stated(given, stated[name])
            except InputError as error:
                problems.append(LocatedError(f"{table.place(row, column)}, {name}", error))
    return _Read(number, f"{table.place(row, table.id_column)}, {number}", stated, tuple(problems))
