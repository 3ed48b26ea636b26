"""Closed forms, written by hand with numpy for one mechanism each: the yardstick of the general engine."""

from __future__ import annotations

import numpy as np


def slider_crank_moment(phi, values):
    """Return M_bal of the slider-crank by virtual power."""
    r, length, part = values["l_OA"], values["l_AB"], values["l_AS2"] / values["l_AB"]
    omega = values["n_1"] * values["sense_1"]
    crank = r * np.exp(1j * phi)
    height = crank.imag
    reach = -np.sqrt(length**2 - height**2)
    rod = reach - 1j * height
    rate = -omega * crank.real / reach
    v_b = (1j * omega * crank + 1j * rate * rod).real
    epsilon = (omega**2 * crank.imag + rate**2 * rod.imag) / rod.real
    a_a = -(omega**2) * crank
    a_ba = (1j * epsilon - rate**2) * rod
    v_s, a_s, a_b = 1j * omega * crank + 1j * rate * rod * part, a_a + a_ba * part, (a_a + a_ba).real
    power = (np.conj(v_s) * (-values["m_2"] * a_s)).real + v_b * (values["F_3"] - values["m_3"] * a_b)
    return -(power - values["J_S2"] * epsilon * rate) / omega


def four_bar_place(phi, crank, rod, rocker, frame):
    """Return B and C, with the vectors BC and DC."""
    B = crank * np.exp(1j * phi)
    way = frame - B
    square = (way * way.conj()).real
    part = 0.5 * (square + rod**2 - rocker**2) / square
    BC = way * (part + 1j * np.sqrt(rod**2 / square - part * part))
    return B, B + BC, BC, B + BC - frame


def four_bar_rates(omega, B, BC, DC):
    """Return V_B, V_C, a_B, a_C and the rates of both links, omega_2, omega_3, epsilon_2, epsilon_3."""
    sine = (BC.conj() * DC).imag
    V_B, a_B = 1j * omega * B, -(omega**2) * B
    omega_2, omega_3 = -(V_B.conj() * DC).real / sine, -(V_B.conj() * BC).real / sine
    rest = a_B - omega_2**2 * BC + omega_3**2 * DC
    epsilon_2, epsilon_3 = -(rest.conj() * DC).real / sine, -(rest.conj() * BC).real / sine
    return V_B, 1j * omega_3 * DC, a_B, (1j * epsilon_3 - omega_3**2) * DC, omega_2, omega_3, epsilon_2, epsilon_3


def four_bar_motion(phi, values):
    """Return velocities and accelerations of the four-bar, those of the centres of mass and the rates of links too."""
    omega = values["n_1"] * values["sense_1"]
    B, _, BC, DC = four_bar_place(phi, values["l_AB"], values["l_BC"], values["l_DC"], values["l_AD"])
    V_B, V_C, a_B, a_C, *rates = four_bar_rates(omega, B, BC, DC)
    first, second, third = (
        values[f"l_{name}"] / values[f"l_{whole}"] for name, whole in (("AS1", "AB"), ("BS2", "BC"), ("DS3", "DC"))
    )
    return V_B, V_C, a_B, a_C, a_B * first, a_B + (a_C - a_B) * second, a_C * third, *rates


def slider_crank_place(phi, crank, rod):
    """Return B and C, with the vector BC."""
    B = crank * np.exp(1j * phi)
    BC = np.sqrt(rod**2 - B.imag**2) - 1j * B.imag
    return B, B + BC, BC


def slider_crank_rates(omega, B, BC):
    """Return V_B, V_C, a_B, a_C."""
    V_B, a_B = 1j * omega * B, -(omega**2) * B
    omega_2 = -V_B.imag / BC.real
    epsilon_2 = (omega_2**2 * BC.imag - a_B.imag) / BC.real
    V_C, a_C = V_B + 1j * omega_2 * BC, a_B + (1j * epsilon_2 - omega_2**2) * BC
    return V_B, V_C.real + 0j, a_B, a_C.real + 0j
