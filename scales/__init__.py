"""Scale factors mu, units, and the errors everybody raises."""

from .errors import InputError, KulmanError, PositionError
from .scale import Scale

__all__ = ["InputError", "KulmanError", "PositionError", "Scale"]
