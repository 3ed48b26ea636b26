"""The sheet of a cycle: the plan of positions and the diagrams."""

from __future__ import annotations

from ...drawing.linkages.layout.sheet import draw
from ...drawing.linkages.views import Contents
from ...drawing.titleblock import Stamp
from ...drawing.words import Words
from ...plans.linkages.cycles.cycle import Cycle
from ..case import Case
from ..kinds.linkage import placed
from ..sheets import Sheet, sheet_of


def cycle_sheet(case: Case, whole: Cycle, words: Words) -> Sheet:
    """Draw the plan of positions and the diagrams of a cycle on a sheet of their own.

    Raises
    ------
    PositionError
        The position of the case itself, which the plan of positions shows, has no plan.
    """
    error = case.solved.error()
    if error is not None:
        raise error
    language = words.language
    stamp = Stamp(title=case.task.title[language], document_type=words["sheet.document"], language=language)
    contents = Contents(placed(case), ("cycle",), case.choosers, case.givens, words, "gost", whole)
    return sheet_of(case, draw(contents), stamp)
