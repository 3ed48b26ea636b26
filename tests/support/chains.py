"""Chains of dyads, each rod on the rocker before it: mechanisms of more links than digits."""

from __future__ import annotations

HEAD = """id = "chain-{links}"
source = "made for a test"
notation = "nau"
plans = ["structure", "position", "velocity", "acceleration", "forces", "lever"]
variant = [{{ id = "1", phi = 50, l_OA = 40, n_1 = 100, q = 5, F_{links} = 300 }}]
[title]
uk = "Ланцюг"
ru = "Цепь"
en = "Chain"
[givens]
phi = {{ unit = "deg" }}
l_OA = {{ unit = "mm" }}
n_1 = {{ unit = "rpm" }}
q = {{ unit = "kg/m" }}
F_{links} = {{ unit = "N" }}
"""
LINK = """[[mechanism.link]]
number = {number}
points = {{ {start} = ["0 mm", "0 mm"], {end} = ["{length} mm", "0 mm"], S{number} = ["{middle} mm", "{aside} mm"] }}
centre = "S{number}"
per_length = "q"
inertia_factor = 0.1
"""
REVOLUTE = """[[mechanism.pair]]
kind = "revolute"
point = "{point}"
links = [{first}, {second}]
"""
END = """[[mechanism.link]]
number = {links}
points = {{ B{count} = ["0 mm", "0 mm"] }}
centre = "B{count}"
mass = "8 kg"
[[mechanism.pair]]
kind = "prismatic"
point = "B{count}"
links = [{links}, 0]
through = ["0 mm", "-60 mm"]
direction = "0 deg"
branch = 1
[mechanism.driver]
link = 1
pivot = "O"
point = "A"
angle = "phi"
speed = "n_1"
sense = 1
[[mechanism.load]]
name = "F_{links}"
link = {links}
point = "B{count}"
magnitude = "F_{links}"
"""


def chain(count: int, bent: bool = True) -> str:
    """Return a task file: a crank, `count` - 1 dyads of a rod and a rocker, one of a rod and a slider."""
    parts = [HEAD.format(links=2 * count + 1), _crank(), REVOLUTE.format(point="O", first=0, second=1)]
    parts[-1] += 'at = ["0 mm", "0 mm"]\n'
    hinge, before = "A", 1
    for k in range(1, count + 1):
        rod, rocker, joint = 2 * k, 2 * k + 1, f"B{k}"
        parts.append(_link(rod, hinge, joint, 100 + k % 3, 7 if bent else 0))
        parts.append(REVOLUTE.format(point=hinge, first=before, second=rod))
        parts.append(REVOLUTE.format(point=joint, first=rod, second=rocker))
        if k < count:
            parts[-1] += "branch = 1\n"
            parts.append(_link(rocker, f"C{k}", joint, 60 + k % 4, -5 if bent else 0))
            parts.append(REVOLUTE.format(point=f"C{k}", first=0, second=rocker) + f'at = ["{100 * k} mm", "-20 mm"]\n')
        hinge, before = joint, rocker
    return "".join((*parts, END.format(links=2 * count + 1, count=count)))


def _crank() -> str:
    return '[[mechanism.link]]\nnumber = 1\npoints = { O = ["0 mm", "0 mm"], A = ["l_OA", "0 mm"] }\ncentre = "O"\n'


def _link(number: int, start: str, end: str, length: int, aside: int) -> str:
    return LINK.format(number=number, start=start, end=end, length=length, middle=length / 2, aside=aside)
