"""Images through physical water against the Monte-Carlo tables of ``tests/optics``."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from tests.optics.reference_tables import PHASES, PIXELS, name_of_row, read_rows
from tests.rendering.physical.photographs import (
    AT_ORIGIN,
    SHADOWLESS,
    FloatArray,
    camera_of,
    lamp_beside_camera,
    photograph,
    show_plane,
    show_stripes,
)
from uwsim.optics import Medium
from uwsim.rendering.physical.physical_water import Daylight, PhysicalWater
from uwsim.rendering.renderer import Renderer
from uwsim.rendering.water import Water

ISOTROPIC = 0.5
"""The radiance of the isotropic field in these tests."""
NIGHT = Daylight(irradiance=0.0)
MEDIA = (("FF", 0.6), ("FF", 0.85), ("HG", 0.6), ("HG", 0.85))


def water_of(
    name: str, albedo: float, optical_depths: tuple[float, ...], *, has_blur: bool = True
) -> PhysicalWater:
    """Return water whose channels have optical depths at 1 m, in an isotropic field."""
    scattering = tuple(albedo * depth for depth in optical_depths)
    return PhysicalWater(
        medium=Medium.from_beam_attenuation(optical_depths, scattering, PHASES[name]),
        transfer="linear",
        isotropic_radiance=(ISOTROPIC,) * 3,
        has_blur=has_blur,
    )


@pytest.mark.parametrize(("name", "albedo"), MEDIA)
@pytest.mark.parametrize("depths", [(0.2, 0.5, 1.0), (1.36, 2.0, 2.72), (0.1, 0.4, 4.0)])
def test_a_black_target_in_an_isotropic_field_has_the_tabled_light(
    renderer: Renderer, name: str, albedo: float, depths: tuple[float, float, float]
) -> None:
    table = {float(row["optical_depth"]): row for row in read_rows("full_field")}
    show_plane(renderer, 1.0, (0.0, 0.0, 0.0))
    centre = photograph(renderer, water_of(name, albedo, depths), camera_of(150.0, 321, 241))[
        120, 160
    ]
    h = 1.0 - centre / ISOTROPIC
    tabled_h = [float(table[depth][f"{name} {albedo:g}"]) for depth in depths]
    tolerance = [0.01 if depth < 4.0 else 0.02 for depth in depths]  # h itself is 0.7 % off
    np.testing.assert_array_less(np.abs(h / np.array(tabled_h) - 1.0), tolerance)


@pytest.mark.parametrize("has_blur", [True, False])
@pytest.mark.parametrize("distance", [0.3, 1.0, 4.0, 20.0])
def test_a_white_target_in_an_isotropic_field_is_invisible(
    renderer: Renderer, distance: float, has_blur: bool
) -> None:
    show_plane(renderer, distance, (1.0, 1.0, 1.0))
    water = water_of("FF", 0.85, (0.2, 1.0, 2.0), has_blur=has_blur)
    image = photograph(renderer, water, camera_of(150.0, 160, 120))
    np.testing.assert_allclose(image, ISOTROPIC, rtol=0.005)


def find_row(table: str, name: str, albedo: float, depth: float) -> dict[str, str]:
    """Return the row of a table for a medium and an optical depth."""
    return next(
        row
        for row in read_rows(table)
        if (row["phase"], float(row["albedo"]), float(row["optical_depth"]))
        == (name, albedo, depth)
    )


def edge_of(renderer: Renderer, water: PhysicalWater, place: float) -> FloatArray:
    """Return the light of a white half plane whose edge is ``place`` to the left of the axis."""
    camera = camera_of(1500.0, 2401, 241)
    show_plane(renderer, 1.0, (0.0, 0.0, 0.0))
    black = photograph(renderer, water, camera)[120, 1200]
    show_stripes(renderer, 1.0, (-place, 300.0))
    return (photograph(renderer, water, camera)[120, 1200] - black) / ISOTROPIC


@pytest.mark.parametrize("place", [-0.1, -0.03, -0.003, 0.003, 0.03, 0.1])
@pytest.mark.parametrize(("name", "albedo"), [("FF", 0.6), ("FF", 0.85), ("HG", 0.85)])
def test_an_edge_has_the_tabled_profile(
    renderer: Renderer, name: str, albedo: float, place: float
) -> None:
    depths = (0.5, 1.0, 2.0)
    rows = [find_row("edge", name, albedo, depth) for depth in depths]
    tabled = np.array([float(row[f"{place:g}"]) for row in rows])
    scattered = np.array([float(row["1"]) for row in rows]) - np.exp(-np.array(depths))
    light = edge_of(renderer, water_of(name, albedo, depths), place)
    np.testing.assert_array_less(np.abs(light - tabled), 0.03 * scattered)


N_PHASES = 24
"""The number of places of stripes at which the central pixel is read; overtones of edges up to the
22nd have no part in the amplitude."""


def amplitude_of(
    renderer: Renderer, water: PhysicalWater, frequency: float, width: int = 1601
) -> FloatArray:
    """Return the amplitude of the fundamental wave of stripes on the axis, by moving them.

    The image is 106 degrees wide: at an optical depth of 4 light comes from all of it.
    """
    camera = camera_of(600.0, width, 49)
    n_halves = 2 * math.ceil(3.0 * frequency)
    half_periods = np.arange(-n_halves, n_halves)
    total = np.zeros(3)
    for phase in range(N_PHASES):
        edges = (0.5 * half_periods + 0.25 + phase / N_PHASES) / frequency
        show_stripes(renderer, 1.0, tuple(edges.tolist()))
        light = photograph(renderer, water, camera)[24, width // 2]
        total += light * math.cos(2.0 * math.pi * phase / N_PHASES)
    return np.abs(total)


@pytest.mark.parametrize("frequency", [3.0, 10.0, 30.0])
@pytest.mark.parametrize(("name", "albedo"), MEDIA)
def test_the_contrast_of_stripes_is_the_tabled_transfer(
    renderer: Renderer, name: str, albedo: float, frequency: float
) -> None:
    depths = (1.0, 2.0, 4.0)
    clear = amplitude_of(renderer, water_of(name, albedo, (0.0, 0.0, 0.0)), frequency)
    contrast = amplitude_of(renderer, water_of(name, albedo, depths), frequency) / clear
    rows = [find_row("transfer", name, albedo, depth) for depth in depths]
    tabled = np.array([float(row[f"{frequency:g}"]) for row in rows])
    np.testing.assert_allclose(contrast, tabled, rtol=0.03)


@pytest.mark.parametrize("frequency", [3.0, 10.0])
def test_the_margin_of_a_narrow_image_supplies_light_from_outside(
    renderer: Renderer, frequency: float
) -> None:
    depths = (1.0, 2.0, 4.0)
    row = [find_row("transfer", "FF", 0.85, depth) for depth in depths]
    tabled = np.array([float(values[f"{frequency:g}"]) for values in row])
    clear = amplitude_of(renderer, water_of("FF", 0.85, (0.0, 0.0, 0.0)), frequency, 801)
    errors = []
    for margin in (0.0, 0.5):
        water = replace(water_of("FF", 0.85, depths), blur_margin=margin)
        contrast = amplitude_of(renderer, water, frequency, 801) / clear
        errors.append(np.abs(contrast / tabled - 1.0))
    np.testing.assert_array_less(errors[1], 0.03)
    assert errors[0][2] > 0.03  # 67 degrees are too narrow at an optical depth of 4


def test_a_margin_changes_neither_range_nor_ids(renderer: Renderer) -> None:
    show_stripes(renderer, 1.0, (-0.3, 0.1))
    camera = camera_of(150.0, 161, 120)
    images = [
        renderer.draw(
            AT_ORIGIN, camera, Water(physical_water=replace(water, blur_margin=margin)), SHADOWLESS
        )
        for water in (water_of("FF", 0.85, (0.2, 1.0, 2.0)),)
        for margin in (0.0, 0.3)
    ]
    assert {image.intrinsics for image in images} == {camera}
    for image in images[1:]:
        np.testing.assert_array_equal(image.range, images[0].range)
        np.testing.assert_array_equal(image.ids, images[0].ids)
        assert image.colour is not None
        assert images[0].colour is not None
        assert image.colour.shape == images[0].colour.shape
        assert (image.colour != images[0].colour).any()


@pytest.mark.parametrize("row", read_rows("lamp"), ids=name_of_row)
def test_the_light_of_a_lamp_is_that_of_the_tables(renderer: Renderer, row: dict[str, str]) -> None:
    c, distance, offset = (float(row[key]) for key in ("beam_attenuation", "range", "offset"))
    tan22 = math.tan(math.radians(22.0))
    tabled_pixels = [p for p in PIXELS if abs(p * distance - offset) <= distance * tan22]
    if not tabled_pixels:
        pytest.skip("no pixel is within 22 degrees of the lamp's axis")
    camera = camera_of(200.0, 241, 181)
    lamp = lamp_beside_camera(offset)
    veil_scale = max(float(row[f"{p:g}"]) for p in PIXELS)

    def draw(colour: tuple[float, float, float], exposure: float) -> FloatArray:
        water = replace(
            water_of("FF", 0.85, (c, c, c)),
            isotropic_radiance=None, daylight=NIGHT, exposure=exposure,
        )  # fmt: skip
        show_plane(renderer, distance, colour)
        return photograph(renderer, water, camera, (lamp,))[90, :, 1]

    black = draw((0.0, 0.0, 0.0), 0.4 / veil_scale)
    columns = [round(120 + 200.0 * p) for p in tabled_pixels]
    tabled_veil = np.array([float(row[f"{p:g}"]) for p in tabled_pixels])
    if 0.0 in tabled_pixels:
        signal = float(row["signal"])
        white = draw((1.0, 1.0, 1.0), 0.4 / (signal + veil_scale))
        s = white[120] - black[120]
        assert s == pytest.approx(signal, rel=0.10 if c * distance <= 4.0 else 0.15)
    if c < 2.0 or offset < 0.3:  # beyond, optics.lamp_light states up to 72 %
        np.testing.assert_allclose(black[columns], tabled_veil, rtol=0.15)
