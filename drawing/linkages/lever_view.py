"""Zhukovsky's lever: the turned velocity plan with all forces hung on it, and every arm."""

from __future__ import annotations

from ..shapes import Line, Pen
from ..symbols import force_arrow
from ..view import Canvas, View
from .group_view import force_arm, letter_arrow, zeros
from .plan_view import letter_marks
from .scene import Scene


def lever_view(scene: Scene) -> View:
    """Draw the lever: forces keep their directions, couples hang as pairs, arms run from the pole."""
    canvas = Canvas(scene.style)
    words, style, driver = scene.words, scene.style, scene.solved.mechanism.driver
    steps = scene.solved.program.on("lever")
    marks = [step.name for step in steps if step.verb == "normal"]
    p = scene.mm("lever.p")
    lines = _lines(scene, marks)
    canvas.add(*(Line(a, b, Pen.MAIN, role="lever", name=name) for a, b, name in lines))
    rays = {
        mark: [(q - scene.mm(mark)) for a, b, _ in lines for q in (a, b) if scene.mm(mark) in (a, b)] for mark in marks
    }
    lines_at = {mark: [ray for ray in rays[mark] if abs(ray) > 1e-6] for mark in marks}
    arrows_at: dict[complex, list[complex]] = {}
    feet: dict[complex, list[tuple[str, complex]]] = {}
    for name, mark in hung_on_lever(scene):
        e = scene.direction(name)
        if e == 0:
            continue
        at = scene.mm(mark)
        arrows = arrows_at.setdefault(complex(round(at.real, 3), round(at.imag, 3)), [])
        letter_arrow(canvas, scene, *force_arrow(at, e, name, lines_at[mark], arrows, style))
        if name != "_F_bal" and scene.defined(arm_of(name)):
            foot = at + e * (((p - at) / e).real)
            feet.setdefault(complex(round(foot.real, 4), round(foot.imag, 4)), []).append((name, at))
    # forces on one line share their arm
    for sharing in feet.values():
        force_arm(canvas, scene, [name for name, _ in sharing], [arm_of(name) for name, _ in sharing], sharing[0][1], p)
    canvas.label(
        f"{words.mark('velocity.p')}{words.mark('velocity.' + driver.point)} = {scene.segment('V_' + driver.point)}",
        (p, scene.mm(f"lever.{driver.point}")),
        clear=0.9,
        height=style.text,
    )
    letters = {mark: words.mark(f"velocity.{mark.removeprefix('lever.')}") for mark in marks}
    letter_marks(canvas, scene, {"lever.p": words.mark("lever.p"), **letters}, ("lever.p",))
    hung = hung_on_lever(scene)
    zero = zeros(scene, [name for name, _ in hung], [arm_of(name) for name, _ in hung if scene.direction(name) != 0])
    return canvas.finish("lever", scene.heading("heading.lever", "lever"), (words["said.lever"], *zero))


def _lines(scene: Scene, marks: list[str]) -> list[tuple[complex, complex, str]]:
    """Return the lines of the turned velocity plan: from the pole, and between the ends of each rod."""
    p = scene.mm("lever.p")
    lines = [(p, scene.mm(mark), mark) for mark in marks]
    lines += [(scene.mm(f"lever.{d.A}"), scene.mm(f"lever.{d.B}"), d.AB) for d in scene.dyads]
    return [line for line in lines if abs(line[1] - line[0]) > 1e-6]


def hung_on_lever(scene: Scene) -> list[tuple[str, str]]:
    """Return (force, mark) of all that hangs on the lever, the balancing force last."""
    hung = [
        (step.operands[0], step.operands[1])
        for step in scene.solved.program
        if step.verb == "moment" and step.operands[2] == "lever.p"
    ]
    return [*hung, ("_F_bal", f"lever.{scene.solved.mechanism.driver.point}")]


def arm_of(force: str) -> str:
    """Return the arm's name: of `F_i2` it is `h_lever_F_i2`, of the couple `F_i2_couple_B` `h_lever_M_i2_B`."""
    if "_couple_" in force:
        moment, _, point = force.partition("_couple_")
        return f"h_lever_M{moment.removeprefix('F')}_{point}"
    return f"h_lever_{force}"
