"""The units in which a task shows its results: lengths in cm, say, velocities in cm/s, scale factors per cm of paper.

Inside the package everything is SI and millimetres; this stands at the edge, where numbers are printed.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from .scale import Scale
from .units import SYMBOLS, Unit, unit

LENGTHS = tuple(name for name, symbol in SYMBOLS.items() if symbol.dimension == SYMBOLS["m"].dimension)
PAPER = ("mm", "cm")
METRE, RADIAN = "m", "rad"
ANGLES = (RADIAN, "deg")


@dataclass(frozen=True, slots=True)
class Display:
    """`length` stands for the metre in units of lengths, velocities, accelerations; `paper` measures segments.

    With `size` lengths alone have this unit, those of a cam millimetres, say, while its velocities stay in m/s; `angle`
    is the unit of angles.
    """

    length: str = METRE
    paper: str = "mm"
    size: str = ""
    angle: str = RADIAN

    def unit(self, si: str) -> str:
        """Return the unit in which a value of an SI unit is shown.

        >>> Display("cm").unit("m/s^2"), Display("cm").unit("rad/s")
        ('cm/s^2', 'rad/s')
        """
        if si == RADIAN:
            return self.angle
        if self.size and si == METRE:
            return self.size
        powers = unit(si).powers
        if self.length == METRE or all(name != METRE for name, _ in powers):
            return si
        return Unit(tuple((self.length if name == METRE else name, power) for name, power in powers)).name

    @property
    def of_scales(self) -> Display:
        """The units in which scale factors are shown, and what they draw."""
        return replace(self, size="", angle=RADIAN)

    def value(self, value: float, si: str) -> float:
        """Return a value of an SI unit as it is shown.

        >>> Display("cm").value(0.178, "m/s")
        17.8
        """
        shown = self.unit(si)
        return value if shown == si else unit(shown).from_si(value)

    def segment(self, millimetres: float) -> float:
        """Return millimetres of the sheet in the unit in which segments are shown."""
        return millimetres if self.paper == "mm" else unit(self.paper).from_si(millimetres * 1e-3)

    def scale(self, scale: Scale) -> Scale:
        """Return a scale factor as it is shown; one that is shown so already stays.

        >>> Display("cm", "cm").scale(Scale("mu_V", 0.00075, "m/s"))
        Scale(symbol='mu_V', mu=0.75, unit='cm/s', paper='cm')
        """
        if self != self.of_scales:
            return self.of_scales.scale(scale)
        if scale.paper == self.paper and self.unit(scale.unit) == scale.unit:
            return scale
        per_mm = self.value(scale.mu, scale.unit)
        mu = float(f"{per_mm / self.segment(1.0):.12g}")  # the factor is a round decimal: a shown one stays so
        return replace(scale, mu=mu, unit=self.unit(scale.unit), paper=self.paper)


AS_INSIDE = Display()  # metres, and millimetres of paper
