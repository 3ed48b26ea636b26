"""Chains of dyads, each rod on the rocker before it: mechanisms of more links than digits."""

from __future__ import annotations

TASK = """id = "chain-{last}"
source = "made for a test"
notation = "nau"
plans = ["structure", "position", "velocity", "acceleration", "forces", "lever"]
variant = [{{ id = "1", phi = 50, l_OA = 40, n_1 = 100, q = 5, F_{last} = 300 }}]
title = {{ uk = "Ланцюг", ru = "Цепь", en = "Chain" }}
[givens]
phi = {{ unit = "deg" }}
l_OA = {{ unit = "mm" }}
n_1 = {{ unit = "rpm" }}
q = {{ unit = "kg/m" }}
F_{last} = {{ unit = "N" }}
[mechanism]
driver = {{ link = 1, pivot = "O", point = "A", angle = "phi", speed = "n_1", sense = 1 }}
load = [{{ name = "F_{last}", link = {last}, point = "B{count}", magnitude = "F_{last}" }}]
link = [
  {{ number = 1, points = {{ O = ["0 mm", "0 mm"], A = ["l_OA", "0 mm"] }}, centre = "O" }},
{links}  {{ number = {last}, points = {{ B{count} = ["0 mm", "0 mm"] }}, centre = "B{count}", mass = "8 kg" }},
]
pair = [
  {{ kind = "revolute", point = "O", links = [0, 1], at = ["0 mm", "0 mm"] }},
{pairs}  {{ kind = "prismatic", point = "B{count}", links = [{last}, 0], through = ["0 mm", "-60 mm"], \
direction = "0 deg", branch = 1 }},
]
"""
LINK = """  {{ number = {number}, points = {{ {start} = ["0 mm", "0 mm"], {end} = ["{length} mm", "0 mm"], \
S{number} = ["{middle} mm", "{aside} mm"] }}, centre = "S{number}", per_length = "q", inertia_factor = 0.1 }},
"""


def chain(count: int, bent: bool = True) -> str:
    """Return a task file: a crank, `count` - 1 dyads of a rod and a rocker, one of a rod and a slider."""
    links, pairs, hinge, before = "", "", "A", 1
    for k in range(1, count + 1):
        rod, rocker, joint = 2 * k, 2 * k + 1, f"B{k}"
        inner = k < count
        links += _link(rod, hinge, joint, 100 + k % 3, 7 if bent else 0)
        pairs += _pair(hinge, before, rod) + _pair(joint, rod, rocker, ", branch = 1" if inner else "")
        if inner:
            links += _link(rocker, f"C{k}", joint, 60 + k % 4, -5 if bent else 0)
            pairs += _pair(f"C{k}", 0, rocker, f', at = ["{100 * k} mm", "-20 mm"]')
        hinge, before = joint, rocker
    return TASK.format(last=2 * count + 1, count=count, links=links, pairs=pairs)


def _link(number: int, start: str, end: str, length: int, aside: int) -> str:
    return LINK.format(number=number, start=start, end=end, length=length, middle=length / 2, aside=aside)


def _pair(point: str, first: int, second: int, more: str = "") -> str:
    return f'  {{ kind = "revolute", point = "{point}", links = [{first}, {second}]{more} }},\n'
