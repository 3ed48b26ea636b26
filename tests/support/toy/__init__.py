"""A seesaw, a subject that the package does not know, in the layers of a shipped one: a line registers it."""

from __future__ import annotations

from kulman.scales.packaged import add_texts
from kulman.variants.kinds import MODULES

TABLE, NAME = "seesaw", "seesaws"


def register() -> None:
    """Make the seesaw a kind of tasks."""
    MODULES[TABLE] = f"{__name__}.{NAME}"
    add_texts(__name__)
