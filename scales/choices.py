"""Names of what can be chosen: here, so that the help of the command line loads no plans and no drawings."""

from __future__ import annotations

HANDS = ("cad", "careful", "normal", "lenient")  # presets of `plans.hands`
READINGS = SHEET, RULER = "sheet", "ruler"  # how a note has read its segments
PROFILES = PLAIN, DSTU_3008 = "plain", "dstu3008"  # how the pages of a note look
SIZES = ("A4", "A3", "A2", "A1")  # of `drawing.formats`, the smallest first
FORMATS = ("A4", "A3", "A3-portrait", "A2", "A1")  # all that there are
SHEETS = ("svg", "pdf", "png", "dxf")  # kinds of files of sheets, each with a module of its name in `drawing`
# of `drawing.text`: words upright and symbols slanted, all slanted, a screen font, letters as lines
LETTERINGS = ("gost", "gost-slanted", "dejavu", "strokes")
