"""Four-bar and slider-crank with fifty digits, to measure errors by."""

from __future__ import annotations

from typing import Any

from mechanisms import CRANK, FRAME, OMEGA, ROCKER, ROD

SAMPLES = 100  # angles of a turn that are compared
State = tuple[complex, complex, complex]  # position, velocity, acceleration of C


def truth(mechanism: str) -> list[State]:
    """Return position, velocity and acceleration of C at the samples."""
    import mpmath

    with mpmath.workdps(50):
        turn = [mpmath.mpf(2 * sample) / SAMPLES for sample in range(1, SAMPLES + 1)]
        state = {"four-bar": _four_bar, "slider-crank": _slider_crank}[mechanism]
        return [tuple(map(complex, state(mpmath, share))) for share in turn]  # type: ignore[misc]


def _four_bar(mp: Any, share: Any) -> tuple[Any, Any, Any]:
    AD, AB, BC, DC, omega = map(mp.mpf, (FRAME, CRANK, ROD, ROCKER, OMEGA))
    B = AB * mp.expjpi(share)
    way = AD - B
    part = (abs(way) ** 2 + BC**2 - DC**2) / (2 * abs(way) ** 2)
    C = B + way * mp.mpc(part, mp.sqrt((BC / abs(way)) ** 2 - part**2))
    rod, rocker = C - B, C - AD
    closure = mp.matrix([[rod.imag, -rocker.imag], [-rod.real, rocker.real]])  # of both links' turning
    V_B, a_B = 1j * omega * B, -(omega**2) * B
    omega_2, omega_3 = mp.lu_solve(closure, mp.matrix([V_B.real, V_B.imag]))
    rest = a_B - omega_2**2 * rod + omega_3**2 * rocker
    _, epsilon_3 = mp.lu_solve(closure, mp.matrix([rest.real, rest.imag]))
    return C, 1j * omega_3 * rocker, (1j * epsilon_3 - omega_3**2) * rocker


def _slider_crank(mp: Any, share: Any) -> tuple[Any, Any, Any]:
    """Return the slider's place on its guide and the derivatives of the closed form by the angle, times omega."""
    AB, BC, omega = map(mp.mpf, (CRANK, ROD, OMEGA))
    c, s = AB * mp.cospi(share), AB * mp.sinpi(share)
    reach = mp.sqrt(BC**2 - s**2)
    first = -s - s * c / reach
    second = -c - (c**2 - s**2) / reach - (s * c) ** 2 / reach**3
    return c + reach, omega * first, omega**2 * second


def worst(found: tuple[Any, ...], mechanism: str) -> list[float]:
    """Return the largest error of position, velocity and acceleration, each as a part of its largest value."""
    errors = []
    for values, true in zip(found, zip(*truth(mechanism), strict=True), strict=False):
        step = len(values) // SAMPLES
        misses = [abs(values[step * (k + 1) - 1] - true[k]) for k in range(SAMPLES)]
        errors.append(float(max(misses) / max(map(abs, true))))
    return errors
