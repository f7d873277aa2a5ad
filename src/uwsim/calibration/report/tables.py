"""The rows of the tables of a calibration, for the terminal and the page."""

from __future__ import annotations

from ..calibrated_water import CalibratedWater
from .numbers import format_quantity, format_value

GATE_WORDS = {True: "passed", False: "failed", None: "not measured"}


def make_rows(water: CalibratedWater) -> list[tuple[str, str, list[str]]]:
    """Return the rows of a water: the quantity, its unit, and its text in each channel."""
    rows = []
    for index, quantity in enumerate(water.channels[0].quantities):
        texts = [format_quantity(result.quantities[index]) for result in water.channels]
        rows.append((quantity.name, quantity.unit, texts))
    if any(result.backscatter is not None for result in water.channels):
        texts = []
        for result in water.channels:
            backscatter = result.backscatter
            if backscatter is None:
                texts.append("")
                continue
            value, error = backscatter.value, backscatter.standard_deviation
            limits = (value - 1.96 * error, value + 1.96 * error)
            low, high = (format_value(limit, error) for limit in limits)
            texts.append(f"{format_value(value, error)} ({low} to {high})")
        rows.append(("scattering function at 170°", "1/m/sr", texts))
    chi_squares = [f"{result.estimate.reduced_chi_squared:.2f}" for result in water.channels]
    rows.append(("chi² per degree of freedom", "", chi_squares))
    naive_texts = [f"{result.estimate.naive_attenuation:.3f}" for result in water.channels]
    rows.append(("naive reading, for comparison", "1/m", naive_texts))
    return rows
