"""Maps of caustics against the optics of a lens, the Jacobian of rays, and random rays."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt
import pytest

from uwsim.optics import HenyeyGreenstein, Medium
from uwsim.rendering.caustics.caustic_light import find_contrast_loss
from uwsim.rendering.caustics.caustic_map import (
    MAX_SPREAD,
    CausticMapper,
    CausticOptics,
    make_optics,
)
from uwsim.rendering.caustics.refraction import SUN_RADIUS, Beam, compute_drift, make_beam
from uwsim.rendering.caustics.ripple_spectrum import compute_saturation, find_slope_share
from uwsim.rendering.caustics.ripples import Ripples
from uwsim.rendering.caustics.wave_tile import (
    MAX_WAVE_LENGTH,
    N_NODES,
    NODE_SPACING,
    TILE_EDGE,
    TileWaves,
)
from uwsim.rendering.physical.daylight_field import REFRACTIVE_INDEX
from uwsim.rendering.physical.physical_water import Daylight

FloatArray = npt.NDArray[np.float64]
ZENITH = Daylight(elevation=0.5 * math.pi)
OBLIQUE = Daylight(elevation=0.9, azimuth=1.3)


def one_wave(amplitude: float, columns: int = 8, rows: int = 0) -> TileWaves:
    """Return one wave with its crest at the origin at time 0."""
    number = 2.0 * math.pi / TILE_EDGE * math.hypot(columns, rows)
    return TileWaves(
        columns=np.array([columns]),
        rows=np.array([rows]),
        amplitude=np.array([amplitude]),
        angular_frequency=np.array([math.sqrt(9.81 * number)]),
        phase=np.zeros(1),
    )


def some_waves(n: int, slope: float) -> TileWaves:
    """Return waves of 0.3 to 2 m with a standard deviation of the slope."""
    rng = np.random.default_rng(5)
    angle, ring = rng.uniform(0.0, 2.0 * math.pi, n), rng.uniform(4.0, 25.0, n)
    columns = np.rint(ring * np.cos(angle)).astype(np.int64)
    rows = np.rint(ring * np.sin(angle)).astype(np.int64)
    number = 2.0 * math.pi / TILE_EDGE * np.hypot(columns, rows)
    return TileWaves(
        columns=columns,
        rows=rows,
        amplitude=slope * math.sqrt(2.0 / n) / number,
        angular_frequency=np.sqrt(9.81 * number),
        phase=rng.uniform(0.0, 2.0 * math.pi, n),
    )


def sharp_optics(beam: Beam, depths: tuple[float, ...]) -> CausticOptics:
    """Return optics without blur in some depths."""
    no_blur = np.zeros((0, N_NODES, N_NODES // 2 + 1), np.float32)
    return CausticOptics(beam, depths, 0.0, no_blur, (MAX_SPREAD,) * len(depths))


def sharp_maps(
    waves: TileWaves, depths: tuple[float, ...], daylight: Daylight = ZENITH, time: float = 0.0
) -> FloatArray:
    """Return the gain without blur, (depths, rows, columns)."""
    mapper = CausticMapper(sharp_optics(make_beam(daylight), depths))
    return 1.0 + mapper.compute(waves, time).astype(np.float64)


def find_aperture(half_width: float, share: float, k: float) -> float:
    """Return the half width at the surface of the light that reaches a half width [m]."""
    x = half_width / (1.0 - share)
    for _ in range(50):
        x = half_width + share / k * math.sin(k * x)
    return x


@pytest.mark.parametrize("amplitude", [0.01, 0.03])
def test_a_crest_is_a_lens_with_the_focus_at_n_over_n_minus_1_over_a_k2(amplitude: float) -> None:
    """Compare with a surface of the radius r = 1 / (a k^2), which has the focus n r / (n - 1).

    The slope -a k sin(kx) sends rays to x - d/(f k) sin(kx), and the light in a strip under the
    crest is that which enters through a wider one.
    """
    k = 2.0 * math.pi * 4 / TILE_EDGE
    focus = REFRACTIVE_INDEX / (REFRACTIVE_INDEX - 1.0) / (amplitude * k * k)
    shares, half_width = (0.1, 0.3, 0.5, 0.7), 4.5 * NODE_SPACING
    maps = sharp_maps(one_wave(amplitude, 4), tuple(share * focus for share in shares))
    for gain, share in zip(maps, shares, strict=True):
        crest = np.roll(gain[0], 4)[:9].mean()
        assert crest == pytest.approx(find_aperture(half_width, share, k) / half_width, rel=0.02)
        trough = gain[0, N_NODES // 8 - 4 : N_NODES // 8 + 5].mean()  # its rays are far apart
        assert trough == pytest.approx(find_aperture(half_width, -share, k) / half_width, rel=0.03)

    # Below the focus the light parts into two folds, at (sqrt(8)/3) (d/f - 1)^1.5 / k to the sides.
    # They leave a texel of 1/64 of the wave at d/f = 1.14, where it is the brightest.
    depths = tuple(share * focus for share in np.arange(0.5, 1.8, 0.05).tolist())
    depth = depths[int(np.argmax(sharp_maps(one_wave(amplitude, 4), depths)[:, 0, 0]))]
    assert focus <= depth <= 1.2 * focus


@pytest.mark.parametrize("daylight", [ZENITH, OBLIQUE])
def test_light_before_the_focus_is_the_inverse_of_the_rays_spread(daylight: Daylight) -> None:
    """Compare the light at x + d u(x) with that which enters at x over 1 + d du/dx."""
    depth, amplitude = 2.0, 0.01
    gain = sharp_maps(one_wave(amplitude), (depth,), daylight)[0, 0]
    k = 2.0 * math.pi * 8 / TILE_EDGE
    x = np.arange(0.0, 3.0, 1e-4)
    slopes = -amplitude * k * np.sin(k * x)
    beam = make_beam(daylight)
    drift = np.array([compute_drift(beam.towards_sun, s, 0.0)[0] for s in slopes.tolist()])
    sun = beam.towards_sun
    entering = np.array([_transmit((sun[2] - sun[0] * s) / math.hypot(1.0, s)) for s in slopes])
    entering *= 1.0 - sun[0] / sun[2] * slopes
    place = x + depth * (drift - beam.level_drift[0])
    density = entering / entering[:10000].mean() / np.gradient(place, x)
    nodes = NODE_SPACING * np.arange(40, 80)
    error = gain[40:80] / np.interp(nodes, place, density) - 1.0
    assert np.sqrt(np.mean(error**2)) < 0.02  # a ray for each node
    assert np.abs(error).max() < 0.05


def _transmit(cosine: float) -> float:
    refracted = math.sqrt(1.0 - (1.0 - cosine * cosine) / REFRACTIVE_INDEX**2)
    s = (cosine - REFRACTIVE_INDEX * refracted) / (cosine + REFRACTIVE_INDEX * refracted)
    p = (refracted - REFRACTIVE_INDEX * cosine) / (refracted + REFRACTIVE_INDEX * cosine)
    return 1.0 - 0.5 * (s * s + p * p)


@pytest.mark.parametrize("elevation", [0.2, 0.9, 0.5 * math.pi])
@pytest.mark.parametrize("wind_speed", [0.0, 2.0, 8.0])
def test_the_mean_light_is_that_under_a_level_surface(elevation: float, wind_speed: float) -> None:
    ripples = Ripples(wind_speed=wind_speed)
    beam = make_beam(Daylight(elevation=elevation, azimuth=0.4))
    mapper = CausticMapper(make_optics(beam, 20.0, ripples.unresolved_slope))
    maps = mapper.compute(ripples.draw(1), 3.0)
    np.testing.assert_allclose(maps.mean(axis=(1, 2), dtype=np.float64), 0.0, atol=1e-6)
    assert maps.min() > -1.001
    traced = mapper.trace(np.zeros((N_NODES, N_NODES), np.complex64))
    np.testing.assert_allclose(traced, 1.0, atol=1e-5)


def test_the_pattern_of_one_wave_travels_with_its_phase_speed() -> None:
    waves = one_wave(0.01, columns=6, rows=8)
    number = 2.0 * math.pi / TILE_EDGE * 10.0
    speed = math.sqrt(9.81 / number)
    # (0.6, 0.8) speed t is 24 and 32 nodes
    time = 40 * NODE_SPACING / speed
    first, later = (sharp_maps(waves, (4.0,), OBLIQUE, t)[0] for t in (0.0, time))
    np.testing.assert_allclose(later, np.roll(first, (32, 24), axis=(0, 1)), atol=2e-3)


def test_maps_are_the_same_bytes_twice() -> None:
    ripples = Ripples()
    optics = make_optics(make_beam(OBLIQUE), 20.0, ripples.unresolved_slope)
    first, second = (
        CausticMapper(optics).compute(ripples.draw(7), 1.5).tobytes() for _ in range(2)
    )
    assert first == second
    assert CausticMapper(optics).compute(ripples.draw(8), 1.5).tobytes() != first


def test_contrast_falls_below_the_focus() -> None:
    ripples = Ripples(wind_speed=1.0)
    mapper = CausticMapper(make_optics(make_beam(ZENITH), 20.0, ripples.unresolved_slope))
    contrast = mapper.compute(ripples.draw(1), 0.0).std(axis=(1, 2))
    deepest = int(np.argmax(contrast))
    assert 0 < deepest < len(contrast) - 1
    assert np.all(np.diff(contrast[: deepest + 1]) > 0.0)
    assert np.all(np.diff(contrast[deepest:]) < 0.0)


def test_scattering_takes_contrast_and_absorption_does_not() -> None:
    def loss(absorption: float, scattering: float, asymmetry: float = 0.9) -> FloatArray:
        phase = HenyeyGreenstein(asymmetry)
        medium = Medium(
            absorption=(absorption,) * 3, scattering=(scattering,) * 3, phase_function=phase
        )
        return find_contrast_loss(medium, 0.9)

    np.testing.assert_allclose(loss(0.1, 0.4), 2.0 * loss(0.1, 0.2))
    np.testing.assert_allclose(loss(0.5, 0.4), loss(0.1, 0.4))
    assert loss(0.1, 0.4)[0] > 0.0
    assert loss(0.1, 0.0)[0] == 0.0


@pytest.mark.parametrize("depth", [2.0, 5.0, 12.0])
def test_statistics_are_those_of_random_rays(depth: float) -> None:
    """Rays from random points, with the exact slope there and a random point of the sun's disc."""
    waves, n, n_bins = some_waves(60, 0.05), 400_000, 32
    beam = make_beam(OBLIQUE)
    optics = make_optics(beam, depth, 0.0)
    gain = 1.0 + CausticMapper(optics).compute(waves, 0.7)[-1].astype(np.float64)
    rng = np.random.default_rng(11)
    points = rng.uniform(0.0, TILE_EDGE, (n, 2))
    unit = 2.0 * math.pi / TILE_EDGE
    slopes = np.zeros((n, 2))
    for i, j, a, omega, phase in zip(
        waves.columns, waves.rows, waves.amplitude, waves.angular_frequency, waves.phase,
        strict=True,
    ):  # fmt: skip
        sine = np.sin(unit * (i * points[:, 0] + j * points[:, 1]) - omega * 0.7 + phase)
        slopes -= a * unit * np.array([i, j]) * sine[:, None]
    drifts, lights = trace_rays(beam, slopes, rng)
    places = (points + depth * (drifts - beam.level_drift)) % TILE_EDGE
    # texels are centred at nodes, bins begin half a texel before them
    places = (places + 0.5 * NODE_SPACING) % TILE_EDGE
    edges = np.linspace(0.0, TILE_EDGE, n_bins + 1)
    counts, _, _ = np.histogram2d(places[:, 1], places[:, 0], bins=[edges, edges], weights=lights)
    random_gain = counts / counts.mean()
    binned_gain = gain.reshape(n_bins, N_NODES // n_bins, n_bins, -1).mean(axis=(1, 3))
    noise = math.sqrt(n_bins**2 / n)
    assert np.std(random_gain - binned_gain) < 1.5 * noise
    assert np.std(binned_gain) == pytest.approx(math.sqrt(np.var(random_gain) - noise**2), rel=0.05)


def trace_rays(
    beam: Beam, slopes: FloatArray, rng: np.random.Generator
) -> tuple[FloatArray, FloatArray]:
    """Trace rays from the sun's disc by vectors; return their drifts and their lights."""
    sun, n = beam.towards_sun, len(slopes)
    side = np.cross(sun, [0.0, 0.0, 1.0])
    side /= np.sqrt((side**2).sum())
    radius, angle = SUN_RADIUS * np.sqrt(rng.random(n)), rng.uniform(0.0, 2.0 * math.pi, n)
    rays = (
        -sun
        + (radius * np.cos(angle))[:, None] * side
        + (radius * np.sin(angle))[:, None] * np.cross(sun, side)
    )
    rays /= np.sqrt((rays**2).sum(axis=1))[:, None]
    normals = np.concatenate([-slopes, np.ones((n, 1))], axis=1)
    area = np.sqrt((normals**2).sum(axis=1))
    normals /= area[:, None]
    cosine = -(rays * normals).sum(axis=1)
    refracted = np.sqrt(1.0 - (1.0 - cosine**2) / REFRACTIVE_INDEX**2)
    bent = rays / REFRACTIVE_INDEX + (cosine / REFRACTIVE_INDEX - refracted)[:, None] * normals
    lights = np.array([_transmit(c) for c in cosine.tolist()]) * cosine * area
    return bent[:, :2] / -bent[:, 2:], lights


def test_ripples_have_the_slopes_of_cox_and_munk() -> None:
    for wind_speed, total in ((0.0, 0.003), (2.0, 0.01316), (10.0, 0.0538)):
        ripples = Ripples(wind_speed=wind_speed)
        assert sum(ripples.slope_variances) == pytest.approx(total)
        drawn = ripples.draw(2).mean_square_slope + 2.0 * ripples.unresolved_slope**2
        long_share = find_slope_share(wind_speed, MAX_WAVE_LENGTH, math.inf)
        assert drawn == pytest.approx((1.0 - long_share) * total, rel=1e-6)
    waves, slopes = Ripples(wind_speed=10.0).draw(2), np.zeros((N_NODES, N_NODES), np.complex64)
    waves.compute_slopes(0.0, slopes)
    variances = slopes.real.var(), slopes.imag.var()
    assert sum(variances) == pytest.approx(waves.mean_square_slope, rel=0.03)
    assert variances[0] / variances[1] == pytest.approx(0.0316 / 0.0222, rel=0.1)


@pytest.mark.parametrize("wind_speed", [4.0, 6.0, 8.0, 10.0])
def test_all_waves_of_the_spectrum_have_the_slopes_of_cox_and_munk(wind_speed: float) -> None:
    """Two publications: the spectrum of Elfouhaily et al., and the glitter of Cox and Munk."""
    numbers = np.geomspace(0.005, 2000.0, 4000)
    saturation = compute_saturation(numbers, wind_speed)
    total = saturation.sum() * math.log(numbers[1] / numbers[0])
    assert total == pytest.approx(sum(Ripples(wind_speed=wind_speed).slope_variances), rel=0.12)


def test_a_film_leaves_no_waves_shorter_than_one_foot_in_light_wind() -> None:
    """Cox and Munk found them missing in slicks, which wind breaks."""
    shares = [find_slope_share(wind_speed, 0.0, 0.15) for wind_speed in (0.5, 2.0, 3.0, 4.0)]
    assert shares[0] == pytest.approx(shares[1])
    assert shares[1] < 0.01
    assert 0.1 < shares[2] < shares[3]


def test_light_wind_makes_a_net_of_thin_lines() -> None:
    """Lines are narrow against the cells of the net: most of the area is dark."""
    ripples = Ripples(wind_speed=0.5)
    mapper = CausticMapper(make_optics(make_beam(ZENITH), 5.0, ripples.unresolved_slope))
    gain = 1.0 + mapper.compute(ripples.draw(1), 0.0)[-1]
    assert np.median(gain) < 0.7
    assert gain[gain > 2.0].sum() > 0.3 * gain.sum()
    spread = make_optics(make_beam(ZENITH), 5.0, Ripples(wind_speed=8.0).unresolved_slope)
    blurred = 1.0 + CausticMapper(spread).compute(Ripples(wind_speed=8.0).draw(1), 0.0)[-1]
    assert np.median(blurred) > 0.8
