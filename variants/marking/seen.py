"""A student's drawing as answers: its vectors in mm of paper, their directions, the scale factors of its plans.

A scale factor is the one that is written on the drawing, `μ_V = 0.05 (m/s)/mm`, beside its plan where there are
several; else that which fits the plan best, and then nothing can be said of it.
"""

from __future__ import annotations

import cmath
import math
import re
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, replace

from ...plans.marking.drawn import Recognised, part_there, recognise
from ...plans.marking.lines import Drawn
from ...plans.names import LEVER, role
from ...scales.errors import InputError, KulmanError, Written
from ...scales.names import latin
from ...scales.numbers import SHOWN, quote
from .cells import Mu, scale_factor
from .keyed import Keyed
from .reading import Answers, Reply
from .wording import plain

LIKE = 0.02  # part by which a scale factor that is written may differ from the one that fits
SURE = 0.75  # part of one plan at the least that must be there, or the drawing is of something else
MUCH = 0.8  # part of the vectors of a variant that a drawing of it has
LIKELY = 3  # other variants that are looked at closely
QUARTER = math.pi / 2.0
DIGITS = 3
LEAST, LARGEST = 15.0, 1200.0  # mm, the longest line of a drawing on a sheet of paper
TOLD = 0.5  # mm to which a photograph tells a segment, as a rounded number tells a value
TINY = 2.0  # mm of a vector: of shorter ones none can be asked for
_MU = re.compile(r"(?:[μµ]|\bmu)\s*_?\s*\{?\s*([^\W_][\w. ]{0,12}?)\s*\}?\s*[=:]\s*(.{1,60})")
_BARE = re.compile(r"[0-9]+(?:[.,][0-9]+)?(?![0-9.,]|\s*[·*/:])")


@dataclass(frozen=True, slots=True)
class Seen:
    """What was recognised on a drawing: its vectors, the scale factor of each plan, SI per mm, which are written.

    `turn` is by how much the sheet is turned, radians; `fits` the variant whose drawing it is, if it is another one.
    """

    recognised: Recognised
    mus: Mapping[str, float]
    written: frozenset[str]
    turn: float = 0.0
    fits: str = ""

    def direction(self, vector: complex) -> float:
        """Return the direction of a vector of the drawing, radians, as if the sheet were not turned."""
        return cmath.phase(vector * cmath.rect(1.0, -self.turn)) % math.tau


def seen(drawn: Drawn, key: Keyed, others: Iterable[str], other_key: Callable[[str], Keyed]) -> Seen:
    """Recognise what a drawing shows of a variant; where it shows another one, the plans of that.

    What another variant is known by is then measured as it is drawn.
    """
    fits = _another(drawn, key, others, other_key)
    own, told = _look(drawn, other_key(fits) if fits else key, not fits)
    written = {plan: mu for plan in own.plans if (mu := _beside(plan, told, own)) is not None}
    # where neither the plan nor its scale factor is as it should be, they are some other lines
    plans = own.plans
    strange = {n for n, mu in written.items() if plans[n].mistake and abs(plans[n].mu - mu) > LIKE * mu}
    own = _without(own, strange)
    plans, written = own.plans, {plan: mu for plan, mu in written.items() if plan in own.plans}
    mus = {plan: written.get(plan, found.mu) for plan, found in plans.items()}
    turns = [round(found.turn / QUARTER) for found in plans.values()]
    turn = QUARTER * max(turns, key=turns.count) if turns else 0.0
    return Seen(own, mus, frozenset(written), turn, fits)


def _right(found: Recognised, key: Keyed) -> float:
    """Return what part of the vectors of a variant stands on a drawing as it should.

    Without those of plans of their usual size that are too short to be seen: at any size plans are found by chance.
    """
    right = [name for name, one in found.vectors.items() if not found.plans[one.plan].mistake]
    usual, plans = key.key.paper.mus, found.plans.items()
    mus = {plan: one.mu for plan, one in plans if abs(one.mu - usual.get(plan, 0.0)) < LIKE * one.mu}
    missing = [name for name in found.missing if not _tiny(key, mus, name)]
    return len(right) / max(len(found.vectors) + len(missing), 1)


def _another(drawn: Drawn, key: Keyed, others: Iterable[str], other_key: Callable[[str], Keyed]) -> str:
    """Return the variant that a drawing shows, if it is another one: of this one little is there, of that much."""
    most, fits, looks = part_there(drawn, key.key, MUCH), "", list[tuple[float, str]]()
    if most >= MUCH:
        return fits
    for other in others:
        with suppress(KulmanError):  # this variant has no plan with the student's data
            looks.append((part_there(drawn, other_key(other).key, MUCH), other))
    looks = sorted((look for look in looks if look[0] >= MUCH), reverse=True)[:LIKELY]
    for _, other in looks:
        part = _right(_look(drawn, other_key(other), False)[0], other_key(other))
        if part >= max(MUCH, most):
            most, fits = part, other
    return fits


Told = Mapping[str, list[tuple[complex, Mu]]]  # by plan: scale factors that are written, and where


def _look(drawn: Drawn, key: Keyed, closely: bool) -> tuple[Recognised, Told]:
    """Recognise the plans of a key, also with mistakes where it is `closely`, and read their scale factors.

    A plan that is not drawn to the factor written for it is looked for at any.
    """
    told, ours = _told(drawn, key), key.key.paper.mus
    written = {plan: {mu.nearest(ours[plan]) for _, mu in some} for plan, some in told.items() if ours.get(plan)}
    mus = {plan: next(iter(some)) for plan, some in written.items() if len(some) == 1}
    book = key.book if closely else None
    found = recognise(drawn, key.key, book, mus)
    if closely and any(plan not in found.plans for plan in mus):
        found = recognise(drawn, key.key, book, {plan: mu for plan, mu in mus.items() if plan in found.plans})
    return found, told


def _without(found: Recognised, plans: Collection[str]) -> Recognised:
    """Return what was recognised without some plans."""
    gone = tuple(name for name, one in found.vectors.items() if one.plan in plans)
    kept = {name: one for name, one in found.vectors.items() if name not in gone}
    return Recognised({p: one for p, one in found.plans.items() if p not in plans}, kept, (*found.missing, *gone))


def _told(drawn: Drawn, key: Keyed) -> Told:
    """Return the scale factors that stand on a drawing, for each plan all that may be its own."""
    scales, display, solved = key.asked.scales, key.asked.display, key.solution.solved
    told: dict[str, list[tuple[complex, Mu]]] = {
        plan: []
        for plan in solved.program.plans
        if role(plan).kind != LEVER  # no vectors of its own
    }
    for letter in drawn.letters:
        for written, text in _MU.findall(letter.text):
            name = f"mu_{latin(written.replace(' ', ''))}"
            own = [symbol for symbol in scales if symbol == name] or [
                symbol for symbol in scales if f"{symbol}_".lower().startswith(f"{name}_".lower())
            ]
            for plan, some in told.items():
                symbol = solved.scale_of_plan.get(plan, "")
                if symbol in own:
                    units = f"({scales[symbol]})/mm", f"({display.of_scales.unit(scales[symbol])})/{display.paper}"
                    mu = _factor(text.rpartition("=")[2], units)
                    some += [] if mu is None else [(letter.place, mu)]
    return told


def _beside(plan: str, told: Told, found: Recognised) -> float | None:
    """Return the scale factor that is written for a plan: of several the nearest to its pole, if to no other's.

    Those that do not fit are of a detail or a diagram where one does, also one that stands by another plan: if it is
    nearer than they, or the nearest of them is of a larger drawing, as details are.
    """
    own = found.plans[plan]
    near = [
        one
        for one in told[plan]
        if all(
            abs(one[0] - own.pole) <= abs(one[0] - other.pole)
            for name, other in found.plans.items()
            if one in told[name]
        )
    ]
    away, mu = min(((abs(at - own.pole), mu.nearest(own.mu)) for at, mu in near), default=(0.0, math.inf))
    within = math.inf if mu < (1.0 - LIKE) * own.mu else away
    fitting = [one for one in told[plan] if abs(one[1].nearest(own.mu) - own.mu) <= LIKE * own.mu]
    near += [one for one in fitting if near and abs(one[0] - own.pole) < within]
    far = [(abs(at - own.pole), mu.nearest(own.mu)) for at, mu in near]
    return min([(abs(mu - own.mu) > LIKE * own.mu, away, mu) for away, mu in far])[2] if far else None


def _factor(text: str, units: tuple[str, str]) -> Mu | None:
    """Return a scale factor as it is written, with its unit where that can be read."""
    bare = _BARE.match(text.strip())
    tries = (text, text.replace(" ", ""), bare[0] if bare else "")
    for one in filter(None, tries):
        with suppress(InputError):
            return scale_factor(one.strip(" ,;."), "", *units)
    return None


def measured(
    answers: Answers, key: Keyed, found: Seen, absent: Mapping[str, str] | None = None
) -> tuple[Answers, list[KulmanError]]:
    """Return answers with what was measured on their drawing, and what is to be said of it.

    Plans that are `absent` have not been handed in; each has the message that says so.

    Raises
    ------
    InputError
        Nothing of the task was recognised.
    """
    recognised = found.recognised
    sure = max((plan.quality for plan in recognised.plans.values()), default=0.0) >= SURE
    if not (recognised.vectors and sure) and not found.fits:
        plans = {question.plan for part in key.parts for question in part.asked if question.vector}
        raise _unknown(answers, blank=bool(absent) and plans <= {*(absent or ())})
    lines = {}
    for name, vector in recognised.vectors.items():
        way, mu = vector.tip - vector.tail, Mu(found.mus[vector.plan], sure=True)
        last = TOLD * found.mus[vector.plan] if answers.photos else None
        lines[name] = Reply(
            name, abs(way), None, None, found.direction(way), rounded=last, place=answers.source, decimals=1, factor=mu
        )
    asked = {question.name for part in key.parts for question in part.asked}
    columns = tuple(name for name in lines if name in asked)
    # a force that is another one turned round has no line of its own
    gone = [n for n in recognised.missing if n in asked and key.key.questions[n].step.law != "opposite"]
    tiny = [name for name in gone if _tiny(key, found.mus, name)]
    columns += tuple(name for name in gone if name not in tiny)
    notes: list[KulmanError] = []
    if not found.fits:
        notes += [
            *_scales(key, found),
            *_missing(answers, key, found, columns, absent or {}),
            *_told_of(key, tiny, lambda plan: "drawing-tiny"),
        ]
    return replace(answers, lines=lines, columns=columns), notes


def _unknown(answers: Answers, blank: bool) -> InputError:
    """Return why nothing of the task was recognised: pages may be `blank`, a drawing saved in another unit."""
    file, drawn = quote(answers.source, SHOWN), None if answers.photos else answers.drawn
    if blank:
        return InputError("photo-blank", file=file)
    longest = LEAST if drawn is None else float(abs(drawn.tips - drawn.tails).max(initial=0.0))
    if longest > LARGEST or longest < LEAST:
        return InputError("drawing-size", file=file, n=round(longest))
    return InputError("drawing-unknown", file=file)


def _tiny(key: Keyed, mus: Mapping[str, float], name: str) -> bool:
    """Whether a vector, at the scale factor of its plan, is too short to be seen."""
    plan = key.key.questions[name].plan
    return plan in mus and abs(key.key[name]) < TINY * mus[plan]


def heading(key: Keyed, plan: str) -> str:
    """Return what a plan is called, as the sheet has it."""
    return plain(key.solution.kind.plan_heading(key.solution.solved, plan, key.words))


def _scales(key: Keyed, found: Seen) -> Iterator[InputError]:
    """Go through the scale factors at which the plans were measured."""
    for plan, mu in found.mus.items():
        symbol = key.solution.solved.scale_of_plan.get(plan, "")
        if symbol not in key.asked.scales or plan not in {one.plan for one in found.recognised.vectors.values()}:
            continue
        si, display = key.asked.scales[symbol], key.words.display.of_scales
        unit = key.words.spelled(f"({display.unit(si)})/mm")
        shown = f"{key.symbol(symbol)} = {key.words.short(display.value(mu, si), DIGITS)} {unit}"
        how = "drawing-scale-written" if plan in found.written else "drawing-scale-fits"
        yield InputError(how, plan=Written(heading(key, plan)), mu=Written(shown))


def _missing(
    answers: Answers, key: Keyed, found: Seen, columns: Iterable[str], absent: Mapping[str, str]
) -> Iterator[InputError]:
    """Go through what was not found, plan by plan."""

    def said(plan: str) -> str:
        if plan in found.recognised.plans:
            return "drawing-missing"
        return absent.get(plan, "photo-no-plan" if answers.photos else "drawing-no-plan")

    yield from _told_of(key, (name for name in columns if name in found.recognised.missing), said)


def _told_of(key: Keyed, names: Iterable[str], said: Callable[[str], str]) -> Iterator[InputError]:
    """Go through plans with what is `said` of these vectors of theirs: the key of a message."""
    by_plan: dict[str, list[str]] = {}
    for name in names:
        by_plan.setdefault(key.key.questions[name].plan, []).append(key.symbol(name))
    for plan, symbols in by_plan.items():
        yield InputError(said(plan), plan=Written(heading(key, plan)), names=Written(", ".join(symbols)))
