"""A scale factor: value per millimetre of the sheet."""

from __future__ import annotations

import math
from dataclasses import dataclass

# GOST 2.302 and its reciprocals give the same customary mantissas
SERIES = (1.0, 2.0, 2.5, 4.0, 5.0)
SEGMENTS = (1.0, 1.25, 1.6, 2.0, 2.5, 3.2, 4.0, 5.0, 6.3, 8.0)  # preferred numbers R10, for chosen segments


@dataclass(frozen=True, slots=True)
class Scale:
    """A scale factor such as mu_V = 0.05 (m/s)/mm.

    Parameters
    ----------
    symbol : str
        `mu_l`, `mu_V`, `mu_a`, `mu_F_23`, ...
    mu : float
        Value in `unit` per millimetre.
    unit : str
        Unit of the value drawn, SI: `m`, `m/s`, `m/s^2`, `N`.
    paper : str
        What the segments are measured in: millimetres, unless the factor is only shown.
    """

    symbol: str
    mu: float
    unit: str
    paper: str = "mm"

    def drawn(self, value: float) -> float:
        """Return the millimetres that show `value`."""
        return value / self.mu

    def measured(self, millimetres: float) -> float:
        """Return the value that `millimetres` show."""
        return millimetres * self.mu

    @property
    def per_mm_unit(self) -> str:
        """Unit of the scale factor, `m/mm` or `(m/s)/mm`."""
        return f"({self.unit})/{self.paper}" if "/" in self.unit or "*" in self.unit else f"{self.unit}/{self.paper}"

    @property
    def per_unit(self) -> float:
        """The same scale factor in the other convention: millimetres per unit of the value."""
        return 1.0 / self.mu


def rounded(mu: float, digits: int = 3) -> float:
    """Round a scale factor to so many significant digits: what is printed is what is drawn."""
    return float(f"{mu:.{digits - 1}e}")


def steps(mu: float, series: tuple[float, ...] = SERIES) -> tuple[float, ...]:
    """Return the members of `series` times powers of ten from `mu` upwards, two decades of them."""
    decade = math.floor(math.log10(mu))
    members = [round(m * 10.0**e, 15 - e) for e in range(decade, decade + 3) for m in series]
    return tuple(m for m in members if m >= mu * (1.0 - 1e-9))
