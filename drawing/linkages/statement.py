"""The statement of a task: the kinematic scheme, the data with their names, what is to be found, how it is written."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterable, Iterator
from dataclasses import replace
from functools import partial

from ...plans.board import POSITION
from ...plans.names import LEVER, role
from ...scales.scale import Scale, steps
from ..extents import Size
from ..page import DATA, SCHEME, TASK
from ..tables import table, text_block, words_of
from ..view import View
from .asking import FORCES, rows_of
from .calculations.tables import results_parts
from .figures.links import draw_links, letter_links
from .figures.scheme import draw_axes, draw_driver, letter_axes, letter_frame
from .ladders import scheme_mu, scheme_only
from .scene import Scene

# mm that the links of the scheme take at most, as there is room; so large where directions are taken off it
BOXES = (140.0, 100.0), (110.0, 80.0), (80.0, 60.0), (60.0, 45.0)
SKETCHED = BOXES[2]
ROUND = (1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0)  # scale factors of a scheme, but for powers of ten
TURNING = ("omega", "epsilon", "M")  # kinds of quantities that have a sense
FOUND = ("R", "M", "F")  # kinds of quantities that a force plan is drawn for


def statements(
    scene: Scene, plans: Collection[str], variant: str, width: float, fixed: Iterable[Scale] = ()
) -> Iterator[list[View]]:
    """Go through the views of the statement with ever smaller schemes: scheme, data, what the plans have to find.

    Lines of text are at most `width` mm long; they say which scale factors are `fixed` by the task. Where no plan of
    the mechanism is asked for, directions are taken off the scheme, and where lengths are, it has the scale factor of
    lengths.
    """
    others = [data_table(scene, plans), task_text(scene, plans, variant, width, fixed)]
    measured = any(role(name).kind == "l" for plan in plans for name in _sought(scene, plan))
    if POSITION not in plans and measured and scheme_only(plans):
        yield [kinematic_scheme(scene, scaled=True), *others]
        return
    for box in BOXES[2:] if POSITION in plans else BOXES[:3]:
        yield [scene.once(partial(kinematic_scheme, box=box), SCHEME, box), *others]


def kinematic_scheme(scene: Scene, box: Size = SKETCHED, scaled: bool = False) -> View:
    """Draw the links in a box, mm: pairs, the driver with its angle and its sense; `scaled` by the scene's mu_l."""
    if not scaled:
        mu = steps(scheme_mu(scene.solved, box), ROUND)[0]
        scene = replace(scene, scales={POSITION: Scale("mu_l", mu, "m")}, runs={})
    canvas = scene.canvas()
    draw_axes(canvas, scene)
    figures = draw_links(canvas, scene, scene.numbers)
    draw_driver(canvas, scene)
    letter_axes(canvas, scene)
    letter_frame(canvas, scene, figures)
    letter_links(canvas, scene, figures)
    heading = scene.heading("heading.kinematic", *((POSITION,) if scaled else ()))
    return replace(canvas.finish(SCHEME, heading), parts=())


def data_table(scene: Scene, plans: Collection[str], here: bool = False) -> View:
    """Return the data that the plans need, with what they are called; what has no value is said in sentences.

    Where loads are said as they act `here`, in this position, no diagrams are needed.
    """
    words = scene.words
    head = [words[f"table.{key}"] for key in ("symbol", "called", "value", "unit")]
    # a word, as of a sense, goes on over the column of units
    rows = [
        [s, called, value, of or (None if not s else "")]
        for s, called, value, of in rows_of(scene, plans, here)
        if value
    ]
    return table(DATA, words["heading.givens"], [head, *rows], scene.style)


def task_text(scene: Scene, plans: Collection[str], variant: str, width: float, fixed: Iterable[Scale] = ()) -> View:
    """Return what the table of data leaves to say, what is to be found, a line for each plan, and how it is written.

    It says at which `fixed` scale factors, and of which quantities the sense is wanted, too.
    """
    words, lines = scene.words, aims(scene, plans)
    said = ". ".join(called for _, called, value, _ in rows_of(scene, plans) if not value)
    lines = [f"{said}.", *lines] if said else lines
    scales = ", ".join(_told_apart({scale.symbol: words.scale(scale) for scale in fixed}))
    lines += [words["task.scales"].format(scales=scales)] if scales else []
    sought = [name for plan in plans for name in _sought(scene, plan)]
    turning = dict.fromkeys(kind for name in sought if (kind := role(name).kind) in TURNING)
    senses = words["task.senses"].format(names=words.listed([words.symbol(kind) for kind in turning]))
    angle = words["task.angles"] if words.notation["angles"] else ""
    lines += [words["task.reading"]] * bool(sought) + [senses] * bool(turning)
    lines += [angle] if angle and sought else []
    return text_block(TASK, words["heading.task"].format(variant=variant), [*map(words_of, lines)], scene.style, width)


def _told_apart(scales: dict[str, str]) -> Iterator[str]:
    """Go through scale factors; those that share their letters are followed by their links, or by their point."""
    often = Counter(said.partition(" = ")[0] for said in scales.values())
    for symbol, said in scales.items():
        letters, _, value = said.partition(" = ")
        place = ", ".join(map(str, role(symbol).links)) or role(symbol).about
        yield f"{letters} ({place}) = {value}" if often[letters] > 1 and place else said


def aims(scene: Scene, plans: Collection[str]) -> list[str]:
    """Return what the plans have to find, a sentence each."""
    every = {plan: ", ".join(map(scene.words.symbol, _sought(scene, plan))) for plan in plans}
    return [scene.words[f"task.{plan}"].format(names=names) for plan, names in every.items()]


def _sought(scene: Scene, plan: str) -> list[str]:
    """Return the names of what a plan finds, but for each force of a load and each arm.

    A lever that finds nothing new finds again what balances the driver.
    """
    names = [name for part in results_parts(scene.solved) if part.kind == plan for name in part.names]
    if plan not in FORCES:
        return names
    found = [name for name in names if role(name).kind in FOUND and not role(name).about]
    return [name for name in found if not role(name).part] or [name for name in found if role(name).part == LEVER]
