"""A task solved: quantities by name, their scale factors, status and reason, as JSON and as a table."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from html import escape
from typing import TYPE_CHECKING, Any

from ..drawing.formats import Norm, format_named
from ..drawing.words import Words
from ..plans.quantities import Quantity, measured
from ..plans.solved import Check, Solved
from ..scales.errors import InputError, PositionError
from ..scales.names import of_its_kinds, unknown
from ..scales.scale import Scale
from .case import Case, Kind, Request, Settings, Wanted
from .reader import load_task
from .tables import FILES, OfCase, Table, aligned, html_table
from .task import AnyTask

if TYPE_CHECKING:
    from ..plans.condition import Condition
    from ..plans.hands.shaky import Hand
    from .hands import Drawing

SUFFIXES = FILES
ROUNDING = 1e-14  # part of the largest quantity of a unit


@dataclass(frozen=True, slots=True, repr=False)
class Solution(OfCase, Mapping[str, Quantity]):
    """The answer to one variant of a task: a mapping of its quantities by name, in order of construction.

    `solution["V_B"]` is a `Quantity`, and so is a given, `solution["m_2"]`; `reason` says why a position has no plan;
    `conditions`, and the `drawing` of a hand, are there when asked for.
    """

    solved: Solved
    quantities: Mapping[str, Quantity]
    scales: Mapping[str, Scale]
    reason: PositionError | None
    warnings: tuple[InputError, ...]
    conditions: Mapping[str, Condition] = field(default_factory=dict)
    drawing: Drawing | None = None
    format: str = ""

    @property
    def listed(self) -> dict[str, Quantity]:
        """The quantities of the plans wanted, as a list shows them."""
        return {
            name: self.quantities[name]
            for name in self.kind.listed(self.solved, self.case.plans)
            if name in self.quantities
        }

    @property
    def status(self) -> str:
        """`ok`, `ill-conditioned`, `singular` or `no-assembly`."""
        return self.solved.status

    @property
    def checks(self) -> dict[str, dict[str, Any]]:
        """What a second route, or a rule of good design, says, by name: as JSON has it."""
        return {check.name: check.to_json() for check in self.kind.checks(self.solved)}

    @property
    def kind(self) -> Kind[Any, Any]:
        """Of which kind the task is."""
        return self.case.kind

    def __getitem__(self, name: str) -> Quantity:
        """Return a quantity, or a given, by its name."""
        if name not in self.quantities:
            given = self.task.givens.get(name)
            if given is not None and given.unit is not None and name in self.case.values:
                return Quantity(name, self.case.values[name], given.unit.si.name)
            raise unknown("quantity-unknown", name, self.quantities)
        return self.quantities[name]

    def __iter__(self) -> Iterator[str]:
        """Go through the names of the quantities, in order of construction."""
        return iter(self.quantities)

    def __len__(self) -> int:
        """Return the number of quantities."""
        return len(self.quantities)

    def _ipython_key_completions_(self) -> list[str]:
        """Return what a notebook offers behind `solution["`."""
        return list(self)

    def __repr__(self) -> str:
        """Return task, variant, status and the number of quantities."""
        return f"<Solution {self.task.id} {self.variant}: {self.status}, {len(self)} quantities>"

    def _repr_html_(self) -> str:
        """Show the table in a notebook, what the task says of its data, and why a position has no plan."""
        said = [] if self.reason is None else [self.reason.text(self.words.language)]
        said += filter(None, [self.task.note_in(self.words.language)])
        return "".join(f"<p>{escape(text)}</p>" for text in said) + html_table(self._shown())

    def _shown(self) -> list[list[str]]:
        """Return the rows of a notebook: quantities under their headings, the scale factors below."""
        rows, headings = [[""] * 5], self.kind.headings(self.solved, self.words)
        for quantity in self._tidy():
            if quantity.name in headings:
                rows.append([headings[quantity.name]])
            rows.append([*_row(self.words, quantity.shown(self.words.display))])
        return [*rows, [self.scaled(self.words)]] if self.scales else rows

    def to_json(self) -> dict[str, Any]:
        """Return, as a dict, what `kulman solve --json` prints; `save("x.json")` writes its text."""
        return {
            "task": self.task.id,
            "variant": self.variant,
            "status": self.status,
            **({"note": note} if (note := self.task.note_in(self.words.language)) else {}),
            "warnings": [warning.text(self.words.language) for warning in self.warnings],
            "checks": self.checks,
            **({"format": self.format} if self.format else {}),
            "scales": {s.symbol: {"value": s.mu, "unit": s.per_mm_unit} for s in self.scales.values()},
            **({} if self.drawing is None else {"hand": self.drawing.head()}),
            "quantities": {name: self._item(quantity) for name, quantity in self.listed.items()},
        }

    def _item(self, quantity: Quantity) -> dict[str, Any]:
        item, condition = quantity.to_json(), self.conditions.get(quantity.name)
        if condition is not None:
            item |= {"condition": condition.value, "sine": condition.sine}
        return item if self.drawing is None else {**item, **self.drawing.item(quantity.name)}

    def drawn(self, language: str | None = None) -> str:
        """Return what the hand that was asked for makes of every quantity, as a readable table; nothing without one.

        Where conditions were asked for, K and the sine of the worst intersection stand before the worst step.
        """
        if self.drawing is None:
            return ""
        from .hands import table

        words = self._words(language)
        conditions = {name: _condition(words, found) for name, found in self.conditions.items()}
        return table(self.drawing, self._tidy(), words, conditions)

    def data(self, language: str | None = None) -> Table:
        """Return a row for each quantity: what `to_json` says of it, in the units of the task."""
        words = self._words(language)
        items = {quantity.name: self._item(quantity.shown(words.display)) for quantity in self._tidy()}
        items = {name: item | {"unit": words.spelled(item["unit"])} for name, item in items.items()}
        columns = tuple(dict.fromkeys(key for item in items.values() for key in item))
        rows = tuple((name, *(item.get(key) for key in columns)) for name, item in items.items())
        return Table(("name", *columns), rows, words.language, self.task.id)

    def _tidy(self) -> list[Quantity]:
        """Return the quantities without what is nothing but rounding."""
        largest: dict[str, float] = {}
        for quantity in self.quantities.values():
            largest[quantity.unit] = max(largest.get(quantity.unit, 0.0), abs(quantity.value or 0.0))
        # scale factors may be listed, too; what is undefined here is left out
        known = {name: Quantity(name, scale.mu, scale.per_mm_unit) for name, scale in self.scales.items()}
        known |= self.quantities
        listed = (known[name] for name in self.kind.listed(self.solved, self.case.plans) if name in known)
        tidied = []
        # what is nothing but rounding beside the largest of the unit, of per cents beside 100, is zero
        for q in listed:
            noise = ROUNDING * (largest.get(q.unit, 0.0) if q.unit != "%" else 100.0)
            value, x, y = (None if part is None else part if abs(part) > noise else 0.0 for part in (q.value, q.x, q.y))
            tidied.append(q if q.kind == "point" else replace(q, value=value, x=x, y=y))
        return tidied

    def table(self, language: str | None = None) -> str:
        """Return the quantities as a readable table: name, value, unit, components, segment in mm.

        Where conditions were asked for, K and the sine of the worst intersection follow. At the end stand the checks of
        a kind that has such a list.
        """
        words = self._words(language)
        rows = [
            (*_row(words, quantity.shown(words.display)), *_condition(words, self.conditions.get(quantity.name)))
            for quantity in self._tidy()
        ]
        widths = [max((len(row[i]) for row in rows), default=0) for i in range(7)]
        lines: list[str] = []
        headings = self.kind.headings(self.solved, words)
        for name, value, unit, parts, mm, condition, sine in rows:
            if name in headings:
                lines += ["", headings[name]] if lines else [headings[name]]
            accuracy = f"K {condition:{widths[5]}}  sin {sine}" if condition else ""
            lines.append(
                f"{name:{widths[0]}}  {value:>{widths[1]}}  {unit:>{widths[2]}} {parts:{widths[3]}}"
                f"  {mm:{widths[4]}}  {accuracy}".rstrip()
            )
        if self.scales:
            lines += [*([] if headings else [""]), self.scaled(words)]
        if self.kind.judged:
            judged = _judged(self.kind.checks(self.solved), words)
            lines += ["", words[self.kind.judged], aligned(judged, (0, 1, 3))]
        return "\n".join(lines)

    def scaled(self, words: Words, letters: Callable[[str], str] = str) -> str:
        """Return the format of the sheet and its scale factors, as a line; `letters` spell their names."""
        shown = (words.display.scale(scale) for scale in self.scales.values())
        each = ((letters(one.symbol), words.short(one.mu, 6), words.spelled(one.per_mm_unit)) for one in shown)
        return f"{self.format}: {', '.join(f'{name} = {mu} {unit}' for name, mu, unit in each)}"


def _judged(checks: Iterable[Check], words: Words) -> list[list[str]]:
    """Return a row for each check: its name, the quantity and its value, how it has to stand to its limit, verdict."""

    rows = []
    for one in checks:
        value, limit = (words.amount(number, one.unit, 6) for number in (one.value, one.limit))
        rows.append([one.name, one.quantity, value, one.sign, limit, words["said.ok" if one.ok else "said.fails"]])
    return rows


def _row(words: Words, q: Quantity) -> tuple[str, str, str, str, str]:
    unit = words.spelled(q.unit)
    parts = "–" if q.x is None or q.y is None else f"({words.short(q.x, 6)}; {words.short(q.y, 6)})"
    if q.kind == "point":
        return q.name, parts, unit, "", ""
    if q.about is not None:
        parts = words["said.about"].format(point=q.about)
    value = "–" if q.value is None else words.short(q.value, 6)
    places = 2 if words.display.paper == "mm" else 3
    mm = "" if q.mm is None else f"{words.short(round(q.mm, places))} {words.spelled(words.display.paper)}"
    return q.name, value, unit, "" if parts == "–" else parts, mm


def _condition(words: Words, condition: Condition | None) -> tuple[str, str]:
    if condition is None:
        return "", ""
    return "–" if condition.value is None else words.short(condition.value, 3), words.short(condition.sine, 3)


@of_its_kinds()
def solve(
    task: AnyTask,
    variant: str | int | None = None,
    *,
    set: Settings | None = None,
    only: Wanted = None,
    scales: Settings | None = None,
    notation: str | None = None,
    lang: str | None = None,
    condition: bool = False,
    hand: str | Hand | None = None,
    format: str | None = None,
    norm: Norm = "gost",
    lettering: str = "gost",
) -> Solution:
    """Solve one variant of a task.

    Parameters
    ----------
    task : str, path or Task
        A bundled id such as `nau-slider-crank`, or a TOML file.
    variant : str, optional
        Without it the first variant.
    set : mapping, optional
        Other values for givens: `{"l_OA": "55 mm", "n_1": 765, "phi": (75, "deg")}`.
    only : str or iterable of str, optional
        The plans wanted, `"velocity"` or `["velocity", "forces"]`; only they and what they need are built.
    scales : mapping, optional
        Scale factors: `{"mu_V": 0.05}` or a segment in mm, `{"pa": 80}`.
    notation, lang : str, optional
        Notation profile and language of the words.
    condition : bool, optional
        Whether to find, for each quantity, how it hangs on the data, and how flatly lines meet behind it.
    hand : str or Hand, optional
        Who draws: `cad`, `careful`, `normal`, `lenient`, or one's own standard deviations of marks, directions and
        readings, `"0.2 mm, 0.5 deg, 0.2 mm"`. Then `drawing` says for each quantity where 95 % of drawings lie.
    format : str, optional
        `A4`, `A3`, `A2`, `A1`: the scale factors are those drawn on the sheet of this format. Without it nothing is
        drawn: they, and the format, follow from the extents of the plans; a sheet that finds no room so says others.
    norm, lettering
        As for `sheet`, where a format is said.

    Returns
    -------
    Solution
        Also for a position without a plan: then `status` and `reason` say so.

    Raises
    ------
    InputError
        An unknown task, variant, given, plan, scale factor, language, notation, hand or format, or a value of the wrong
        kind.

    >>> from kulman import solve
    >>> round(solve("nau-slider-crank", "example")["V_B"].value, 4)
    2.7614
    """
    language = "uk" if lang is None else lang  # of the sheet on which is drawn, where nothing is said
    how = set, only, scales, notation, language, format, norm
    asked = Request(load_task(task), variant, *how, lettering=lettering)
    found = solution_of(asked, condition, hand)
    return found if lang is not None else replace(found, words=found.words.speaking("en"))


def solution_of(asked: Request, condition: bool = False, hand: str | Hand | None = None) -> Solution:
    """Solve what is asked for; arguments and errors as of `solve`."""
    case = asked.case()
    words = case.words()
    solved, paper, by_plan, warnings = _on_paper(case)
    items = measured(solved.quantities, solved.shown_on, by_plan)
    used = {scale.symbol: scale for scale in by_plan.values()}
    conditions = case.kind.conditions(case.solved) if condition else {}
    drawn = None
    if hand is not None:
        from .hands import drawing

        drawn = drawing(case.kind, solved, by_plan, hand)
    return Solution(case, words, solved, items, used, case.error(), warnings, conditions, drawn, paper)


def _on_paper(case: Case) -> tuple[Solved, str, Mapping[str, Scale], tuple[InputError, ...]]:
    """Return what is solved, the format and the scale factors by plan of its sheet, and warnings.

    Nothing is drawn unless a format is said. A position without a plan has neither format nor scale factors.
    """
    solved = case.solved
    if case.format is not None:
        format_named(case.format)  # a wrong one is refused in any position
    if solved.trouble is not None:
        return solved, "", {}, case.warnings
    if case.format is None:
        sheet, scales = case.kind.first_scales(solved, case.choosers, case.plans)
        return solved, sheet.name, _used(solved, scales), case.warnings
    from .sheets import drawing_of  # draws the whole sheet, which takes a second or two

    drawn = drawing_of(case)
    solved, said = case.kind.fitted(solved, drawn)
    return solved, drawn.format, _used(solved, drawn.scales), (*case.warnings, *said)


def _used(solved: Solved, scales: Mapping[str, Scale]) -> dict[str, Scale]:
    """Return the scale factors of the plans, and of the figures drawn larger that show a quantity."""
    return {plan: scales[plan] for plan in (*solved.scale_of_plan, *solved.shown_on.values()) if plan in scales}
