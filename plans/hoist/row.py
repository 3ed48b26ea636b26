"""A row of masses joined by elastic links: the forces of the links, found without their deformations.

Masses 1..n stand between two ends, 0 and n+1, whose motions are given; link i joins mass i to mass i+1. With the forces
Q_i on the masses and Q_(i,i+1) = c_(i,i+1) (q_i - q_(i+1)) in the links,

    a_i q''_i = Q_i + Q_(i-1,i) - Q_(i,i+1)                                                    (1)
    Q''_(i,i+1) = c_(i,i+1) (q''_i - q''_(i+1))                                                (2)
    -c/a_i Q_(i-1,i) + (p^2 + k^2) Q_(i,i+1) - c/a_(i+1) Q_(i+1,i+2) = c (Q_i/a_i - Q_(i+1)/a_(i+1))   (3)

with c = c_(i,i+1), k^2 = c (1/a_i + 1/a_(i+1)), p = d/dt. At an end the acceleration of that end stands for Q/a, and
1/a = 0. A link of no stiffness carries no force: an end that is free has such a link.

Source: Karpenko, Muzyka, Gudym, formulas (1) to (3).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Row:
    """Masses in a row; leading axes hold many rows at once.

    Parameters
    ----------
    masses : array of shape (..., n)
        a_1..a_n, kg.
    stiffnesses : array of shape (..., n + 1)
        c_(0,1)..c_(n,n+1), N/m; zero where there is no link.
    forces : array of shape (..., n)
        Q_1..Q_n, constant, N.
    ends : array of shape (..., 2)
        Accelerations of both ends, constant, m/s^2.
    """

    masses: Array
    stiffnesses: Array
    forces: Array
    ends: Array

    @property
    def matrix(self) -> Array:
        """Coefficients of the forces in (3), rad^2/s^2, of shape (..., n + 1, n + 1): three diagonals."""
        yielding, c = _yielding(self.masses), self.stiffnesses
        links = c.shape[-1]
        found = np.zeros((*c.shape, links))
        at = np.arange(links)
        found[..., at, at] = c * (yielding[..., :-1] + yielding[..., 1:])
        found[..., at[1:], at[:-1]] = -c[..., 1:] * yielding[..., 1:-1]
        found[..., at[:-1], at[1:]] = -c[..., :-1] * yielding[..., 1:-1]
        return found

    @property
    def drive(self) -> Array:
        """Right-hand sides of (3), N/s^2, of shape (..., n + 1)."""
        own = self.forces * _yielding(self.masses)[..., 1:-1]
        along = np.concatenate((self.ends[..., :1], own, self.ends[..., 1:]), axis=-1)
        driven: Array = self.stiffnesses * (along[..., :-1] - along[..., 1:])
        return driven

    def motion(self, start: ArrayLike, rates: ArrayLike) -> RowMotion:
        """Solve (3) from the forces of the links, N, and their rates, N/s, at t = 0.

        The matrix is that of M^(-1/2) D c^(1/2), multiplied by its transpose, between square roots of stiffnesses: the
        singular values of the one are the frequencies. Slow modes keep digits so that eigenvalues of the product lose
        beside stiff links.
        """
        c, heavy = np.sqrt(self.stiffnesses), 1.0 / np.sqrt(self.masses)
        links = c.shape[-1]
        halves = np.zeros((*np.broadcast_shapes(c.shape[:-1], heavy.shape[:-1]), links - 1, links))
        at = np.arange(links - 1)
        halves[..., at, at], halves[..., at, at + 1] = -heavy * c[..., :-1], heavy * c[..., 1:]
        _, frequencies, modes = np.linalg.svd(halves)
        still = np.zeros((*frequencies.shape[:-1], 1))  # one mode more than there are masses
        present = c > 0.0
        relaxed = np.where(present, 1.0 / np.where(present, c, 1.0), 0.0)
        parts = (_in_modes(modes, np.asarray(value, float) * relaxed) for value in (start, rates, self.drive))
        return RowMotion(np.concatenate((frequencies, still), axis=-1), modes, c, *parts)


@dataclass(frozen=True, slots=True, eq=False)
class RowMotion:
    """The forces of the links over time: oscillations of the modes, one of which may be still.

    Parameters
    ----------
    frequencies : array of shape (..., n + 1)
        Of the modes, rad/s, falling; the last is zero.
    modes : array of shape (..., n + 1, links)
        A mode a row, in forces divided by the square roots of the stiffnesses.
    scale : array of shape (..., links)
        Square roots of the stiffnesses.
    start, rates, drive : array of shape (..., n + 1)
        Forces, their rates at t = 0 and right-hand sides, in modes.
    """

    frequencies: Array
    modes: Array
    scale: Array
    start: Array
    rates: Array
    drive: Array

    def of(self, *links: int) -> RowMotion:
        """Return the same motion, of which only some links are looked at."""
        chosen = list(links)
        return replace(self, modes=self.modes[..., chosen], scale=self.scale[..., chosen])

    def forces(self, t: ArrayLike) -> Array:
        """Return the forces, N, at times (of the shape of the leading axes, or of axes before them), s."""
        x = np.asarray(t, float)[..., None]
        w = self.frequencies
        late = 0.5 * x * _sinc(0.5 * w * x)
        found = self.start * np.cos(w * x) + self.rates * (x * _sinc(w * x)) + self.drive * (2.0 * late * late)
        return self._of_links(found)

    def rates_of_forces(self, t: ArrayLike) -> Array:
        """Return the first derivatives of the forces, N/s."""
        x = np.asarray(t, float)[..., None]
        w = self.frequencies
        found = self.rates * np.cos(w * x) + (self.drive - self.start * (w * w)) * (x * _sinc(w * x))
        return self._of_links(found)

    def _of_links(self, found: Array) -> Array:
        mixed: Array = (self.modes * found[..., :, None]).sum(axis=-2) * self.scale
        return mixed


def _yielding(masses: Array) -> Array:
    """Return 1/a of the masses, with the ends, which do not yield."""
    none = np.zeros((*masses.shape[:-1], 1))
    return np.concatenate((none, 1.0 / masses, none), axis=-1)


def _in_modes(modes: Array, values: Array) -> Array:
    found: Array = (modes * values[..., None, :]).sum(axis=-1)
    return found


def _sinc(x: Array) -> Array:
    """Return sin(x) / x, 1 at 0."""
    return np.sinc(x * (1.0 / math.pi))
