"""The two mechanisms of the contest, m and rad/s: a four-bar, and a slider-crank with the same crank and rod."""

from __future__ import annotations

import math

FRAME, CRANK, ROD, ROCKER = 0.51, 0.12, 0.48, 0.38  # AD, AB, BC, DC of tests/linkages/test_textbooks.py
OMEGA = -30.0 * math.pi
MECHANISMS = ("four-bar", "slider-crank")
