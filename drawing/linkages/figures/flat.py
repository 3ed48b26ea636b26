"""What a plan says of lines that meet at a small angle: which ones, and how much errors grow."""

from __future__ import annotations

import math
from collections.abc import Iterator

from ....plans.board import POSITION
from ....plans.boards.exact import ILL, SMALL
from ....plans.names import role
from ....plans.references import intersections, pins_together, point_of
from ..scene import Scene

LARGE = 1e4  # above it a number is written with a power of ten


def said_flat(scene: Scene, plan: str) -> Iterator[str]:
    """Say of each point of a plan whose lines meet flatly; in an ill-conditioned position of the worst one, with K."""
    solved, words = scene.solved, scene.words
    for mark, sine in solved.sines.items():
        if role(mark).plan == plan and ILL <= sine < SMALL and plan != POSITION:
            yield words["said.ill"].format(**_meeting(scene, mark, sine))
    if solved.status != "ill-conditioned":
        return
    here = {mark: sine for mark, sine in intersections(solved.program, solved.sines).items() if role(mark).plan == plan}
    mark, sine = min(here.items(), key=lambda item: item[1], default=("", 1.0))
    if 0.0 < sine < ILL:
        from ....plans.linkages.accuracy.conditions import worst_condition  # needs numpy, and few positions need it

        quantity, condition = worst_condition(solved, plan)
        said = _meeting(scene, mark, sine)
        kind = solved.quantities[quantity].kind
        symbol = words.mark(quantity) if kind == "point" else words.symbol(quantity)
        said |= {"quantity": symbol, "condition": _large(scene, condition)}
        pins = pins_together(solved.program, solved.values, mark)
        if pins is None:
            yield words["said.ill_position"].format(**said)
        else:
            yield words["said.ill_pins"].format(first=words.mark(pins[0]), second=words.mark(pins[1]))
        yield words["said.ill_growth"].format(**said)


def _meeting(scene: Scene, mark: str, sine: float) -> dict[str, str]:
    """Return which point lines find, at which angle they meet, and by how much errors grow."""
    return {
        "point": scene.words.mark(point_of(scene.solved.program, mark)),
        "angle": scene.words.short(math.degrees(math.asin(sine)), 3),
        "loss": _large(scene, 1.0 / sine),
    }


def _large(scene: Scene, value: float) -> str:
    """Return a number with three digits, a large one as `2,5·10^{6}`."""
    if value < LARGE:
        return scene.words.short(float(f"{value:.3g}"))
    mantissa, _, power = f"{value:.1e}".partition("e")
    return f"{scene.words.decimal(mantissa)}·10^{{{int(power)}}}"
