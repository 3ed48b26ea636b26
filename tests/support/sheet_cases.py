"""Sheets of the bundled task, drawn once for all tests and read back; the givens, for reckoning on one's own."""

from __future__ import annotations

import cmath
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache

from kulman import sheet, solve
from kulman.tests.support.linkage_cases import Oracle
from kulman.tests.support.mechanisms import NAU_VARIANTS
from kulman.tests.support.readback import Sheet, read, svgs
from kulman.variants.sheets import Sheet as DrawnSheet
from kulman.variants.solution import Solution

TASK = "nau-slider-crank"
FORMATS = ("A4", "A3", "A2", "A1", None)
ROWS = dict(zip(("phi", "l_OA", "l_AB", "l_AS2", "n_1", "m_2", "m_3", "J_S2", "F_3"), range(9), strict=True))


@dataclass(frozen=True)
class Case:
    """One sheet: variant, format, language, side, and what else is set."""

    variant: str = "example"
    format: str | None = None
    lang: str = "uk"
    side: str = "left"
    rotation: str = "cw"
    phi: float | None = None
    only: tuple[str, ...] | None = None
    norm: str = "gost"
    notation: str | None = None
    scales: tuple[tuple[str, str], ...] = ()

    def __str__(self) -> str:
        parts = (self.variant, self.format or "auto", self.lang, self.side, self.rotation)
        extra = (f"phi={self.phi}" if self.phi is not None else "", *(self.only or ()), self.norm, self.notation or "")
        return "-".join(filter(None, (*parts, *extra, *(f"{k}={v}" for k, v in self.scales))))

    @property
    def settings(self) -> dict[str, str]:
        chosen = {"side": self.side, "rotation": self.rotation}
        return chosen if self.phi is None else {**chosen, "phi": repr(self.phi)}

    def given(self, name: str) -> float:
        """Return a given in SI, from the guide's table."""
        if name == "phi" and self.phi is not None:
            return math.radians(self.phi)
        factor = {"phi": math.pi / 180, "l": 1e-3, "n": math.pi / 30, "F": 1e3}.get(name.partition("_")[0], 1.0)
        return NAU_VARIANTS[self.variant][ROWS[name]] * factor

    @property
    def omega(self) -> float:
        """Signed angular velocity of the crank."""
        return self.given("n_1") * (1 if self.rotation == "ccw" else -1)

    @property
    def places(self) -> dict[str, complex]:
        """O, A, B, S2 in metres, from nothing but the givens."""
        a = cmath.rect(self.given("l_OA"), self.given("phi"))
        reach = math.sqrt(self.given("l_AB") ** 2 - a.imag**2)
        b = complex(a.real + (reach if self.side == "right" else -reach))
        return {"O": 0j, "A": a, "B": b, "S2": a + (b - a) * self.given("l_AS2") / self.given("l_AB")}

    @property
    def sheet(self) -> Sheet:
        return drawn(self)

    @property
    def solution(self) -> Solution:
        return solved(self)

    @property
    def oracle(self) -> Oracle:
        return _oracle(self)


@lru_cache(maxsize=2)
def sheet_of(case: Case) -> DrawnSheet:
    """Draw the sheet of a case."""
    return sheet(
        TASK,
        case.variant,
        set=case.settings,
        only=case.only,
        scales=dict(case.scales) or None,
        format=case.format,
        norm=case.norm,  # type: ignore[arg-type]
        notation=case.notation,
        lang=case.lang,
        student={"en": "J. Smith"}.get(case.lang, "Коваленко О."),
        teacher={"en": "A. Brown"}.get(case.lang, "Бондар В."),
        group={"en": "ME-31"}.get(case.lang, "АТ-301"),
        department={"en": "NAU"}.get(case.lang, "НАУ"),
        designation={"en": "TMM.03.01"}.get(case.lang, "ТММ.РГР.03.01"),
    )


@lru_cache(maxsize=64)
def pages(case: Case) -> tuple[str, ...]:
    """Return the SVG of every page."""
    drawn = sheet_of(case)
    return tuple(svgs(drawn))


@lru_cache(maxsize=64)
def drawn(case: Case) -> Sheet:
    """Return the sheet, read back."""
    return read(*pages(case))


@lru_cache(maxsize=64)
def solved(case: Case) -> Solution:
    """Return the numbers that the sheet should show."""
    chosen: Mapping[str, str] = case.settings
    only: Sequence[str] | None = case.only
    return solve(TASK, case.variant, set=chosen, only=only)


@lru_cache(maxsize=64)
def _oracle(case: Case) -> Oracle:
    return Oracle(solve(TASK, case.variant, set=case.settings), case.settings)
