"""What sheets show: figures as tables of stages, and sheets of cams, gears and hoists down the ladders of their sizes.

A view draws all stages of a figure, a handout the first ones, the note tells them; a sheet is drawn smaller until every
view has room.
"""

from __future__ import annotations

import re
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import lru_cache
from typing import Any, Generic, TypeVar

from ..plans.board import Program
from ..plans.names import is_shown, role
from ..plans.solved import Solved
from ..scales.choices import SIZES
from ..scales.errors import InputError
from ..scales.scale import Choosers, Scale
from .compose import Drawn, arrange, begins_of, compose, on_one_page
from .extents import Rungs, from_format
from .formats import FORMATS, Format, Norm, Style, room
from .packing import Placement
from .printed import DEGREES, value_text
from .shapes import Circle, Group, Pen
from .view import Canvas, View, numbered
from .words import Given, Words

COARSE = 0.1  # mm by which a curve may be simplified for the letters beside it
GIVEN = "given"  # what is drawn before any step
ANSWERS = "answers"  # what is drawn in no stage, but with all the work: what it comes to
NUMBER = re.compile(r"\d+")
Scene = TypeVar("Scene")
Subject = TypeVar("Subject", bound=Solved)
Found = tuple[Rungs, list[View], list[Placement]]
TEXT_WIDTH = {"A1": 200.0, "A2": 175.0, "A3": 150.0, "A4": 175.0}  # mm of lines of text, by the letters of a format


@dataclass(frozen=True, slots=True)
class Stage:
    """One step of the work on a figure: the part of the view that is drawn in it.

    Its sentence has the key of the figure, a dot and its `name`. `marks` are what the construction makes in it, `#` for
    numbers, and `verb` how where marks of one name are made in two ways: without such a step the stage falls away.
    It begins with what other figures have found in the stages that it `needs`, each as `figure.stage`.
    """

    name: str
    marks: str = ""
    verb: str = ""
    when: Callable[[Any], bool] = lambda scene: True  # else what it would draw comes with the stage before it
    variant: Callable[[Any], str] = lambda scene: ""  # what stands after its key in a scene of another sentence
    needs: tuple[str, ...] = ()


def stages(*names: str, **made: str | tuple[str, ...]) -> tuple[Stage, ...]:
    """Return stages that every scene has, by name, then others with their marks, or with marks and what they need."""
    others = ((name, (one,) if isinstance(one, str) else one) for name, one in made.items())
    return (*map(Stage, names), *(Stage(name, marks, needs=tuple(needs)) for name, (marks, *needs) in others))


@dataclass(frozen=True, slots=True)
class Figure(Generic[Scene]):
    """One figure of a sheet: how it is drawn, the ladders of scale factors it depends on, the one that sizes it first.

    The first of its `stages` is there before any step, and on a blank. Its sentences have keys that begin with `key`;
    without one nothing is told. A table or a text has no stages; `about` is as of its view.
    """

    name: str
    draw: Callable[[Scene], View]
    ladders: tuple[str, ...] = ()
    stages: tuple[Stage, ...] = ()
    key: str = ""
    about: str | None = None

    def keys(self, scene: Any) -> dict[str, str]:
        """Return the stages that a scene has, in order, with the keys of their sentences."""
        made = _families(scene.solved.program)
        own = [s for s in self.stages if s.when(scene) and (not s.marks or (s.marks, s.verb) in made)]
        key = {stage.name: f"{self.key}.{stage.name}{stage.variant(scene)}" if self.key else "" for stage in own[1:]}
        return {own[0].name: "", **key}

    def canvas(self, scene: Any, coarse: float = COARSE) -> Canvas:
        """Return an empty canvas for the stages that a scene has; letters may take curves for `coarse` ones, mm."""
        keys, parts, last = self.keys(scene), {ANSWERS: ANSWERS}, ""
        for stage in self.stages:
            last = parts[stage.name] = stage.name if stage.name in keys else last
        needs = {stage.name: stage.needs for stage in self.stages if stage.name in keys and stage.needs}
        return Canvas(scene.style, coarse=coarse, parts=parts, stages=keys, needs=needs)


@lru_cache(maxsize=8)
def _families(program: Program) -> frozenset[tuple[str, str]]:
    """Return the families of the steps of a program, each with the verbs of its steps and with none."""
    return frozenset((_family(step.name), verb) for step in program for verb in ("", step.verb))


def _family(name: str) -> str:
    """Return the name of a step with `#` for its numbers; a quantity keeps its own.

    >>> _family("profile.E12"), _family("r_0")
    ('profile.E#', 'r_0')
    """
    return name if is_shown(name) else NUMBER.sub("#", name)


@dataclass(frozen=True, slots=True)
class SheetContents(Generic[Subject]):
    """What a sheet shows: a solved subject, the plans wanted, choosers of scales, givens, words, norm.

    With `as_wanted` it is refused as soon as it would have to be drawn smaller than the task wants.
    """

    solved: Subject
    plans: tuple[str, ...]
    choosers: Choosers
    givens: Mapping[str, Given]
    words: Words
    norm: Norm = "gost"
    as_wanted: bool = field(default=False, kw_only=True)


@dataclass(frozen=True, slots=True)
class SubjectScene(Generic[Subject]):
    """What is solved, on a certain format, in certain words."""

    solved: Subject
    words: Words
    style: Style
    givens: Mapping[str, Given]

    def length(self, value: float) -> str:
        """Return a length, m, in mm, as a dimension has it."""
        return self.words.number(value * 1e3, 2)

    def value(self, value: float) -> str:
        """Return a value with the usual digits."""
        return value_text(self.words, value)

    def degrees(self, angle: float) -> str:
        """Return an angle as a dimension has it: to a hundredth of a degree, without zeros at the end."""
        return f"{self.words.short(round(float(angle) * DEGREES, 2))}°"

    def node(self, at: complex, name: str, role: str = "node", filled: bool = False, pen: Pen = Pen.THIN) -> Group:
        """Return the mark of a point of a figure."""
        return Group((Circle(at, self.style.node, pen, fill="black" if filled else "white"),), role, name)


class Fitting(ABC, Generic[Subject, Scene]):
    """Draws what a sheet shows for any format: a figure again only where a ladder it depends on has another rung.

    `words` are those of the contents with the letters of the subject; `ladders` say how small things may be drawn, by
    name, the wanted size first.
    """

    first_scales: Callable[..., tuple[Format, Mapping[str, Scale]]]  # of what is solved, by choosers, for plans
    stated = False  # whether the data have their names, as on what is given to students

    def __init__(
        self, contents: SheetContents[Subject], words: Words, ladders: Mapping[str, tuple[float, ...]]
    ) -> None:
        self.contents, self.words, self.ladders = contents, words, ladders
        self.wanted = dict.fromkeys(ladders, 0)  # the first rung of each
        self._drawn: dict[tuple[object, ...], View] = {}

    @abstractmethod
    def scene(self, sheet: Format, rungs: Rungs) -> Scene:
        """Return the scene of a sheet on a format."""

    @abstractmethod
    def figures(self, scene: Scene, width: float) -> Iterable[Figure[Scene]]:
        """Go through the figures of a sheet in the order of the work; lines of text are at most `width` mm long."""

    def scales(self, sheet: Format, rungs: Rungs) -> dict[str, Scale]:
        """Return the scale factors of the plans as they are drawn."""
        scene: Any = self.scene(sheet, rungs)
        return {plan: scene.scale(plan) for plan in self.contents.solved.scale_of_plan}

    def on_a_page(self, sheet: Format, last: bool) -> Found | None:
        """Place everything on one page; on the `last` format what may give way may be smaller where that helps."""
        return self.placed(sheet, self.wanted)

    def part(self, rungs: Rungs) -> float:
        """Return what a millimetre of the task's diagrams is on the sheet."""
        return 1.0

    def enlarged(self, sheet: Format, rungs: Rungs, first: bool) -> Rungs:
        """Return rungs at which what has become too small for nothing is larger again."""
        return rungs

    def sized(self, sheet: Format, rungs: Rungs) -> list[tuple[View, Figure[Scene]]]:
        """Return the views of a sheet in the order of the work, each with its figure."""
        scene = self.scene(sheet, rungs)
        width = min(TEXT_WIDTH[sheet.letters], room(sheet, self.contents.norm)[0])
        sized = []
        for figure in self.figures(scene, width):
            key = sheet, self.stated, figure.name, *(rungs[ladder] for ladder in figure.ladders)
            if key not in self._drawn:
                self._drawn[key] = replace(figure.draw(scene), about=figure.about)
            sized.append((self._drawn[key], figure))
        return sized

    def views(self, sheet: Format, rungs: Rungs) -> list[View]:
        """Return the views of a sheet in the order of the work."""
        return numbered(view for view, _ in self.sized(sheet, rungs))

    def placed(self, sheet: Format, rungs: Rungs) -> Found | None:
        """Try one page at these rungs."""
        views = self.views(sheet, rungs)
        sizes = [view.size for view in views]
        found = on_one_page(sizes, sheet, self.contents.norm, begins_of(views)) if may_fit(views, sheet) else None
        return None if found is None else (rungs, views, found)

    def draw(self, sheet: Format | None = None) -> Drawn:
        """Draw on `sheet`, or on the smallest format of which one page holds everything, from the usual one on.

        Raises InputError: a view has no room on a page of the format.
        """
        contents = self.contents
        self.stated = sheet is not None and sheet != FORMATS[sheet.name]  # paper for printers: a handout
        usual = sheet or self.first_scales(contents.solved, contents.choosers, contents.plans)[0]
        formats = [usual] if sheet else from_format(usual)
        for candidate in formats:
            found = self.on_a_page(candidate, candidate is formats[-1])
            if found is not None:
                break
        rungs, views, places = found or self.on_pages(candidate)
        scales, part = self.scales(candidate, rungs), self.part(rungs)
        goes_on = contents.words["heading.continued"]
        return compose(views, places, scales, candidate, contents.norm, goes_on, part, smaller=sheet is None)

    def on_pages(self, sheet: Format) -> Found:
        """Take several pages in reading order.

        Raises InputError: a view has no room on any page.
        """
        return self.in_order(sheet, self.wanted)

    def in_order(self, sheet: Format, wanted: Rungs) -> Found:
        """Take several pages in reading order, from these rungs on."""
        for first in (False, True):  # where nothing stands on the first page as it is, all becomes small enough for it
            rungs = self.enlarged(sheet, self.fitted(sheet, wanted, first), first)
            if found := self.arranged(sheet, rungs):
                return found
        raise InputError("sheet-too-small", format=sheet.name)

    def arranged(self, sheet: Format, rungs: Rungs) -> Found | None:
        """Place views on as many pages as they need."""
        views = self.views(sheet, rungs)
        places = arrange([view.size for view in views], sheet, self.contents.norm)
        return None if places is None else (rungs, views, places)

    def fitted(self, sheet: Format, rungs: Rungs, first: bool = False) -> Rungs:
        """Return the first rungs, from these on, at which every view has room on a page of its own.

        `first` tells that it may be the first page, with the larger title block.
        Raises InputError: a view has none at the last rung.
        """
        wide, high = room(sheet, self.contents.norm, first)
        while True:
            tight = {f.ladders: v.size for v, f in self.sized(sheet, rungs) if v.size[0] > wide or v.size[1] > high}
            if not tight:
                return rungs
            for ladders, size in tight.items():
                name = next((ladder for ladder in ladders if self.has_next(rungs, ladder)), None)
                if name is not None:
                    rungs = self.lower(rungs, name)
                    continue
                fixed = next((n for n in ladders if role(n).kind == "mu" and len(self.ladders[n]) == 1), None)
                if fixed is not None:
                    mu = f"{self.ladders[fixed][0]:g}"
                    raise InputError("plan-too-fine", symbol=fixed, mu=mu, format=sheet.name)
                if sheet.name != SIZES[-1]:
                    raise InputError("sheet-too-small", format=sheet.name)
                raise InputError("sheet-too-large", wide=f"{size[0]:.0f}", high=f"{size[1]:.0f}")

    def refuse_smaller(self, sheet: Format) -> None:
        """Raise InputError where all is to be drawn as it is wanted: it has no room so."""
        if self.contents.as_wanted:
            raise InputError("variant-room", format=sheet.name)

    def has_next(self, rungs: Rungs, ladder: str) -> bool:
        """Whether a ladder has a further rung."""
        return rungs[ladder] + 1 < len(self.ladders[ladder])

    def lower(self, rungs: Rungs, ladder: str) -> Rungs:
        """Return the rungs with the next one of a ladder, where it has one."""
        return rungs | {ladder: rungs[ladder] + self.has_next(rungs, ladder)}


def may_fit(views: Sequence[View], sheet: Format) -> bool:
    """Whether views have less area than a format."""
    return sum(view.size[0] * view.size[1] for view in views) < sheet.width * sheet.height
