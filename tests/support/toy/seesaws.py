"""Tasks about seesaws: a table `[seesaw]` with the side on which the load is."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from kulman.scales.errors import InputError
from kulman.tests.support.toy.plans.seesaw.seesaw import GIVENS, PLANS, Seesaw
from kulman.variants.case import Kind, Numbers

LONGEST = 100.0  # times the arm of the load


class Seesaws(Kind[Seesaw, Any]):
    """Seesaws of two arms."""

    home, room, table, plans = "kulman.tests.support.toy", "seesaw", "seesaw", PLANS
    made, givens, symbols, stranger = Seesaw, GIVENS, ("mu_l", "mu_F"), "value-unknown"
    moves = False

    def impossible(self, values: Numbers) -> Iterator[tuple[str, InputError]]:
        """Refuse an arm that no sheet shows beside the other."""
        if values["l_2"] > LONGEST * values["l_1"]:
            yield "l_2", InputError("seesaw-long", most=f"{LONGEST:g}")


KIND = Seesaws()
