"""The right values of all variants of a task beside one another, and as questions for Moodle."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from html import escape
from numbers import Integral
from pathlib import Path
from typing import Any

from ...drawing.words import Words
from ...drawing.writers import Files
from ...plans.hands.shaky import Hand
from ...plans.hands.shaky import preset as preset_of
from ...plans.names import role
from ...scales.errors import InputError, KulmanError
from ...scales.names import all_known, names_of, of_its_kinds, unknown
from ...scales.numbers import quote
from ...scales.units import format_unit
from ..case import Settings, Wanted
from ..crew import Advance
from ..marking.checks import Check, check
from ..marking.keyed import Keyed, is_arm_of_lever, keyed
from ..marking.report import DIGITS, page, scripts
from ..marking.wording import plain, texts
from ..tables import FILES, Cell, Result, Table, aligned, fresh
from ..task import AnyTask
from .new_variants import NewVariants, import_variants, make_variants
from .questions import BY, Question, gift_bytes, html, questions_of, xml_bytes
from .starter import called, spoken

TASK_FILE = ".toml"
PAGE = ".html"
SUFFIXES = (*FILES, ".xml", ".gift", TASK_FILE)
ACROSS = 11  # variants beside one another on a page to be printed
PAGE_STYLE = """
@page{size:A4 landscape;margin:10mm}body{max-width:277mm}td,th{white-space:nowrap;font-size:9pt}td small{color:#555}
table{width:100%;table-layout:fixed}tr.part th{background:#fff;border-left:0;border-right:0;break-after:avoid}
tr{break-inside:avoid}tr.part{break-after:avoid}tr.mu td{background:#f6f6f6}section+section{break-before:page}
"""


@dataclass(frozen=True, slots=True, repr=False)
class AllVariants(Result):
    """All variants: the key of each, or why it has none."""

    suffixes = SUFFIXES
    check: Check
    keys: Mapping[str, Keyed]
    problems: Mapping[str, KulmanError]
    quantities: tuple[str, ...]
    named: bool
    hand: Hand
    by: str = BY[0]
    new: NewVariants | None = None

    @property
    def left_out(self) -> tuple[KulmanError, ...]:
        """Why new variants have been left out."""
        return () if self.new is None else self.new.left_out

    @property
    def warnings(self) -> tuple[KulmanError, ...]:
        """What a user should know: what is wrong with new variants, and which have no solution."""
        remarks = () if self.new is None else self.new.remarks
        return (*remarks, *self.left_out, *self.problems.values())

    @property
    def words(self) -> Words:  # type: ignore[override]
        """Those of the variants that have a key."""
        return next(iter(self.keys.values())).words

    def __repr__(self) -> str:
        """Return the task, how many variants are solved, and of how many quantities it tells."""
        return f"<AllVariants {self.check.request.task.id}: {len(self.keys)}, {len(self.quantities)} quantities>"

    def table(self, language: str | None = None) -> str:
        """Return the values as lines of text, a column for each variant."""
        words = self._words(language)

        def shown(cell: Cell) -> str:
            if cell is None:
                return "–"
            return cell if isinstance(cell, str) else words.short(float(cell), 6)

        return aligned([tuple(map(shown, row)) for row in self._rows(words.language)], left=(0, 1))

    def data(self, language: str | None = None) -> Table:
        """Return the values, a column for each variant."""
        own = self._language if language is None else language
        _, *rows = self._rows(own)
        return Table(("name", "unit", *self.keys), tuple(rows), own, self.check.request.task.id, exact=False)

    def to_json(self) -> dict[str, Any]:
        """Return what `kulman variants --json` prints: values in SI by variant."""
        found = {
            variant: {
                name: key.solution.quantities[name].value for name in self.quantities if name in key.solution.quantities
            }
            for variant, key in self.keys.items()
        }
        problems = {variant: problem.text(self._language) for variant, problem in self.problems.items()}
        return {"task": self.check.request.task.id, "variants": found, "problems": problems}

    def _files(self, path: Path, drawn: Callable[[], Any]) -> Files:
        """Return a table, a page to print (.html), questions for Moodle (.xml, .gift), new variants as a task file."""
        suffix = path.suffix.lower()
        if suffix == TASK_FILE:
            if self.new is None:
                raise InputError("variants-new", file=quote(path))
            return fresh(path, called(spoken(self.new.task, self.new.text, self._language), path).encode("utf-8"))
        if suffix == PAGE:
            return [(path, self._page().encode("utf-8"))]
        if suffix in FILES:
            return Result._files(self, path, drawn)
        write = xml_bytes if suffix == ".xml" else gift_bytes
        return [(path, write(self._questions()))]

    @property
    def _language(self) -> str:
        return self.check.request.language

    def _rows(self, language: str) -> Iterator[tuple[Cell, ...]]:
        """Go through the rows: a header, and a quantity each with its unit and a value for every variant."""
        said = texts(language)
        yield (said["column.name"], said["column.unit"], *self.keys)
        for name in self.quantities:
            unit = next(key.asked.unit(name) for key in self.keys.values() if name in key.asked.quantities)
            values = (_shown(key, name) for key in self.keys.values())
            yield (name, format_unit(unit, language), *values)

    def _page(self) -> str:
        """Return the answers as a page to be printed: plan by plan, values and segments, some variants to a sheet."""
        request, variants = self.check.request, [*self.keys]
        title = escape(f"{texts(self._language)['key.title']}: {request.task.title[self._language]}")
        each = math.ceil(len(variants) / math.ceil(len(variants) / ACROSS))
        parts = (variants[i : i + each] for i in range(0, len(variants), each))
        sections = (f"<section><h1>{title}</h1>{self._sheet(shown)}</section>" for shown in parts)
        return page(title, self._language, *sections, style=PAGE_STYLE)

    def _sheet(self, variants: Sequence[str]) -> str:
        """Return a table of some variants."""
        said, first = texts(self._language), next(iter(self.keys.values()))
        heads = "".join(f"<th>{escape(one)}</th>" for one in variants)
        rows = f"<thead><tr><th>{said['column.name']}</th><th>{said['column.unit']}</th>{heads}</tr></thead>"
        for part in first.parts:
            names = [q.name for q in part.questions if q.name in self.quantities]
            if names:
                rows += f'<tr class="part"><th colspan="{len(variants) + 2}">{html(part.heading)}</th></tr>'
            for name in (*(part.scales if names else ()), *names):
                told = [_told(self.keys[one], name) for one in variants]
                unit = escape(format_unit(next((unit for _, unit in told if unit), ""), self._language))
                cells = "".join(f"<td>{cell}</td>" for cell, _ in told)
                of = ' class="mu"' if name in part.scales else ""
                rows += f"<tr{of}><td>{_symbol(first, name)}</td><td>{unit}</td>{cells}</tr>"
        return f"{self._formats(variants)}<table>{rows}</table>"

    def _formats(self, variants: Sequence[str]) -> str:
        """Say on which format segments are so long, of each variant where these differ."""
        found = dict[str, list[str]]()
        for one in variants:
            found.setdefault(self.keys[one].solution.format, []).append(one)
        each = (f"{name} ({', '.join(of)})" if len(found) > 1 else name for name, of in found.items() if name)
        formats = "; ".join(each)
        return f"<p>{escape(texts(self._language)['key.format'].format(format=formats))}</p>" if formats else ""

    def _questions(self) -> Iterator[Question]:
        """Go through the questions, those of one category after the other."""
        found = [
            one
            for key in self.keys.values()
            for one in questions_of(key, self.quantities, self.named, self.hand, self.by)
        ]
        order = {place: number for number, place in enumerate(dict.fromkeys(one.category for one in found))}
        return iter(sorted(found, key=lambda one: order[one.category]))


def _shown(key: Keyed, name: str) -> float | None:
    quantity = key.solution.quantities.get(name)
    return None if quantity is None else quantity.shown(key.words.display).value


def _told(key: Keyed, name: str) -> tuple[str, str]:
    """Return a value as it is printed, and the segment that shows it, with its unit; arms, and no others, in mm."""
    words, display, scale = key.words, key.words.display, key.solution.scales.get(name)
    quantity, value = key.solution.quantities.get(name), _shown(key, name)
    if quantity is None and scale is not None:  # of a plan
        of = display.of_scales
        return words.short(of.value(scale.mu, scale.unit), DIGITS), f"({of.unit(scale.unit)})/{display.paper}"
    if quantity is None or value is None:
        return "–", ""
    unit, mm = key.asked.unit(name), f"{words.number(quantity.mm, 1)}" if quantity.mm else ""
    if is_arm_of_lever(name):
        return mm or "–", display.paper
    if unit == "m" and role(name).kind == "h":
        value, unit = 1e3 * value, "mm"
    drawn = f"<br><small>{mm} {words.spelled('mm')}</small>" if mm else ""
    return f"{words.short(value, DIGITS)}{drawn}", unit


def _symbol(key: Keyed, name: str) -> str:
    """Return the symbol of a quantity, with what tells it from another that has the same."""
    markup, whole = key.words.symbol(name), key.symbol(name)
    found = plain(markup)
    return f"{html(markup)}{scripts(whole.removeprefix(found))}" if whole.startswith(found) else scripts(whole)


@of_its_kinds()
def all_variants(
    task: AnyTask,
    variant: Wanted | int | Iterable[int] = None,
    *,
    make: int | None = None,
    ranges: Settings | None = None,
    seed: int | None = None,
    table: str | os.PathLike[str] | None = None,
    set: Settings | None = None,
    only: Wanted = None,
    scales: Settings | None = None,
    quantities: Wanted = None,
    preset: str = "normal",
    by: str = BY[0],
    notation: str | None = None,
    lang: str = "uk",
    format: str | None = None,
    advance: Advance | None = None,
) -> AllVariants:
    """Solve all variants of a task: those that it has, or new ones.

    Parameters
    ----------
    variant : str, number or iterable of these, optional
        Those wanted, `"3,5"`; all without it.
    make : int, optional
        How many new variants are made, up to 1000, each a good exercise.
    ranges : mapping, optional
        From what they are made: from, to and a step, `{"l_OA": "25..60/5 mm"}`; of other givens from what the task's
        variants span.
    seed : int, optional
        The same one gives the same variants.
    table : str or PathLike, optional
        A spreadsheet from which new variants are read.
    task, set, only, scales, notation, lang
        As for `solve`.
    quantities : str or iterable of str, optional
        Those wanted, `"V_B,a_B"`; without it all that a form asks for.
    preset : str
        What a question lets pass: what 98 % of drawings keep of a hand that is `cad`, `careful`, `normal`, `lenient`.
    format : str, optional
        That of the sheet or blank whose segments the key has, `"A4"`; without it the smallest that holds everything.
    by : {"variant", "quantity"}
        What a category of questions holds: one variant, or one quantity of all variants, of which a quiz draws one.

    Raises
    ------
    InputError
        As for `solve`; an unknown variant or quantity, a range or a table that cannot be read; or no variant has a
        solution: then why the first has none.
    """
    if make is not None and table is not None:
        raise InputError("variants-both")
    if make is None and (ranges or seed is not None):
        raise InputError("variants-range")
    if by not in BY:
        raise unknown("choice-unknown", by, BY)
    new = None if table is None else import_variants(task, table, set)
    if make is not None:
        new = make_variants(task, make, ranges, set=set, seed=1 if seed is None else seed, advance=advance)
    of = task if new is None else new.task
    asked = check(of, set=set, only=only, scales=scales, preset=preset, notation=notation, lang=lang, format=format)
    request = asked.request
    keys: dict[str, Keyed] = {}
    problems: dict[str, KulmanError] = {}
    asked_for = [variant] if isinstance(variant, (int, Integral)) else variant
    wanted = [request.task.variant(one).id for one in names_of("variant", asked_for, (str, Integral))]
    for one in wanted or request.task.variants:
        try:
            keys[one] = keyed(request, one, {}, asked.rubric)
        except KulmanError as error:
            problems[one] = error
    if not keys:
        raise next(iter(problems.values()))
    known = tuple(dict.fromkeys(name for key in keys.values() for name in key.asked.quantities))
    forms = (question.name for key in keys.values() for part in key.parts for question in part.asked)
    named = tuple(dict.fromkeys(forms)) if quantities is None else names_of("quantities", quantities)
    all_known("quantity-unknown", named, known)
    hand = preset_of(preset).hand
    return AllVariants(asked, keys, problems, named, quantities is not None, hand, by, new)
