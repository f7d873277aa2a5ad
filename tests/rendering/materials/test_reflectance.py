"""The table of reflectances, against sums over all directions and closed forms."""

from __future__ import annotations

import re

import numpy as np
import pytest

from tests.rendering.materials.brdf import IN_AIR, IN_WATER, even_reflectance, exact_fresnel
from uwsim.rendering.materials import reflectance
from uwsim.rendering.physical.daylight_field import REFRACTIVE_INDEX
from uwsim.rendering.program import SHADERS


def test_fresnels_formula_gives_the_known_reflectances() -> None:
    cosines = np.linspace(0.01, 1.0, 100)
    for index in (IN_WATER, IN_AIR):
        values = reflectance.compute_fresnel(cosines, index)
        np.testing.assert_allclose(values, exact_fresnel(cosines, index), rtol=1e-9)
    assert reflectance.compute_fresnel(np.array(1.0), IN_AIR) == pytest.approx(0.04)
    assert reflectance.compute_fresnel(np.array(1.0), IN_WATER) == pytest.approx(0.00317, abs=1e-5)


@pytest.mark.parametrize("roughness", [0.3, 0.5, 0.75, 1.0])
@pytest.mark.parametrize("cosine", [0.1, 0.3, 0.6, 1.0])
def test_even_light_is_reflected_as_the_sum_over_all_directions(
    cosine: float, roughness: float
) -> None:
    values = reflectance.compute_even_reflectance(cosine, roughness)
    expected = [even_reflectance(cosine, roughness, index) for index in (None, IN_WATER, IN_AIR)]
    np.testing.assert_array_less(np.abs(np.subtract(values, expected)), (0.005, 0.001, 0.001))


def test_no_surface_reflects_more_than_it_receives() -> None:
    table = reflectance.compute_table()[..., :3].astype(np.float64)
    assert table.min() >= 0.0
    assert table.max() <= 1.0
    mirror, dielectric = table[..., :1], table[..., 1:]
    for albedo in (0.0, 0.5, 1.0):
        # a dielectric: the layer, and Lambert's surface below it; a metal with its gain
        assert (dielectric + albedo * (1.0 - dielectric)).max() <= 1.0
        assert (albedo * mirror * (1.0 + albedo * (1.0 / mirror - 1.0))).max() <= 1.0 + 1e-12


def test_the_shader_has_the_constants_of_the_table() -> None:
    text = (SHADERS / "material.glsl").read_text(encoding="utf-8")
    defines = {name: float(value) for name, value in re.findall(r"#define (\w+) ([\d.]+)", text)}
    assert reflectance.WATER_INDEX == REFRACTIVE_INDEX
    assert defines["MIN_ROUGHNESS"] == reflectance.MIN_ROUGHNESS
    assert defines["WATER_INDEX"] == pytest.approx(IN_WATER**2, rel=1e-6)
    assert defines["AIR_INDEX"] == pytest.approx(reflectance.SURFACE_INDEX**2)
