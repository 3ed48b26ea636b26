"""A seesaw as data: a load on one arm, what balances it on the other."""

from __future__ import annotations

from dataclasses import dataclass

from kulman.scales.givens import Described, Givens, Parameter

SIDES = ("left", "right")
SCHEME, BALANCE = PLANS = ("scheme", "balance")
GIVENS: Givens = {
    "near": Parameter(choices=SIDES, default="left"),  # where the load hangs
    "l_1": Parameter("m", usual=(0.1, 0.4)),
    "l_2": Parameter("m", usual=(0.2, 0.8)),
    "F_1": Parameter("N", usual=(50.0, 200.0)),
}


@dataclass(frozen=True, slots=True)
class Seesaw(Described):
    """A seesaw on a pivot between its ends."""

    givens = GIVENS
    near: str = "left"
