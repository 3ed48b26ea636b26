"""What the sheet of a linkage says in equations, numbers and tables."""

from . import forces  # which tells equations of its steps

__all__ = ["forces"]
