"""Linear waves against closed forms, published numbers and statistics."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from scipy import signal

from uwsim.base.geometry import Pose
from uwsim.base.rng import stream
from uwsim.waves import (
    JonswapSpec,
    RegularWaveSpec,
    SeaSettings,
    Spectrum,
    UwsimOceanSpec,
    WaveComponents,
    Waves,
    draw_components,
    wave_numbers,
)
from uwsim.waves.uwsim_ocean import wave_power

G = 9.81


def sea(depth: float = 100.0, **changes: float | tuple[float, float]) -> SeaSettings:
    settings = {"wind": (0.04, 0.04), "wind_speed": 12.0, "reflection_damping": 0.35}
    return SeaSettings(depth=depth, wave_scale=1e-7, **(settings | changes))  # type: ignore[arg-type]


def waves_of(components: WaveComponents, depth: float, pose: Pose | None = None) -> Waves:
    return Waves(components, depth, pose or Pose.identity(), 0.0, np.ones(1))


def regular(
    height: float, period: float, depth: float, direction: float = 0.0, phase: float = 0.0
) -> Waves:
    spec = RegularWaveSpec(height=height, period=period, direction=direction, phase=phase)
    return waves_of(spec.components(sea(depth), stream(0, "x")), depth)


# period [s], depth [m], wave length [m], and the speed at z = -5 m of a wave of 1 m [m/s], from an
# independent computation
PUBLISHED = [
    (4.0, 10.0, 24.68, 0.239),
    (6.0, 10.0, 48.41, 0.376),
    (6.0, 4000.0, 56.21, 0.299),
    (8.0, 20.0, 88.79, 0.328),
    (10.0, 20.0, 121.24, None),
    (10.0, 4000.0, 156.13, 0.257),
]


@pytest.mark.parametrize(("period", "depth", "length", "speed"), PUBLISHED)
def test_length_and_orbital_speed_are_the_published_ones(
    period: float, depth: float, length: float, speed: float | None
) -> None:
    k = wave_numbers(np.array([2.0 * math.pi / period]), depth)[0]
    assert 2.0 * math.pi / k == pytest.approx(length, rel=3e-4)
    if speed is not None:
        motion = regular(1.0, period, depth).motion(np.array([[0.0, 0.0, -5.0]]), 0.0)
        assert motion.velocity[0, 0] == pytest.approx(speed, rel=3e-3)


@pytest.mark.parametrize("depth", [0.3, 2.0, 17.0, 900.0])
@pytest.mark.parametrize("period", [0.7, 3.3, 14.0])
def test_the_wave_number_solves_the_dispersion_relation(period: float, depth: float) -> None:
    omega = 2.0 * math.pi / period
    k = wave_numbers(np.array([omega]), depth)[0]
    assert G * k * math.tanh(k * depth) == pytest.approx(omega**2, rel=1e-13)


@pytest.mark.parametrize(("period", "depth"), [(3.3, 100.0), (7.0, 9.0), (12.0, 4.0)])
def test_pressure_and_velocity_are_those_of_linear_theory(period: float, depth: float) -> None:
    height, direction, time = 0.3, 0.7, 2.9
    omega = 2.0 * math.pi / period
    k = wave_numbers(np.array([omega]), depth)[0]
    points = np.array([[3.0, -2.0, -0.1], [10.0, 4.0, -0.5 * depth], [0.0, 0.0, -0.99 * depth]])
    motion = regular(height, period, depth, direction, 0.4).motion(points, time)
    travel = np.array([math.cos(direction), math.sin(direction)])
    theta = k * (points[:, :2] @ travel) - omega * time + 0.4
    a, up = 0.5 * height, k * (points[:, 2] + depth)
    along = a * omega * np.cosh(up) / math.sinh(k * depth) * np.cos(theta)
    np.testing.assert_allclose(motion.elevation, a * np.cos(theta), rtol=1e-9)
    np.testing.assert_allclose(motion.velocity[:, :2], along[:, None] * travel, rtol=1e-9)
    upward = a * omega * np.sinh(up) / math.sinh(k * depth) * np.sin(theta)
    np.testing.assert_allclose(motion.velocity[:, 2], upward, rtol=1e-9)
    pressure = G * a * np.cosh(up) / math.cosh(k * depth) * np.cos(theta)
    np.testing.assert_allclose(motion.dynamic_pressure, pressure, rtol=1e-9)


def short_crested(depth: float = 30.0) -> Waves:
    spectrum = Spectrum(significant_height=1.0, peak_period=5.0, peak_factor=3.3)
    components = draw_components(spectrum, 60, stream(3, "a"), direction=0.4, spreading=8.0)
    return waves_of(components, depth)


def test_the_gradient_and_the_rate_are_those_of_the_velocity() -> None:
    waves, point, time, step = short_crested(), np.array([3.0, 7.0, -4.0]), 12.3, 1e-3
    motion = waves.motion(point[None], time)
    for axis in range(3):
        offset = np.eye(3)[axis] * step
        ahead = waves.motion((point + offset)[None], time).velocity[0]
        behind = waves.motion((point - offset)[None], time).velocity[0]
        slope = (ahead - behind) / (2.0 * step)
        np.testing.assert_allclose(motion.gradient[0, :, axis], slope, rtol=1e-6, atol=1e-9)
    later = waves.motion(point[None], time + step).velocity[0]
    sooner = waves.motion(point[None], time - step).velocity[0]
    rate = (later - sooner) / (2.0 * step)
    np.testing.assert_allclose(motion.acceleration[0], rate, rtol=1e-5, atol=1e-8)
    assert np.trace(motion.gradient[0]) == pytest.approx(0.0, abs=1e-15)


def test_the_water_accelerates_by_its_pressure_alone() -> None:
    """du/dt = -grad(p / rho), Euler's equation to first order."""
    waves, point, step = short_crested(), np.array([3.0, 7.0, -4.0]), 1e-3
    rate = waves.motion(point[None], 5.0).acceleration[0]
    for axis in range(3):
        offset = np.eye(3)[axis] * step
        ahead = waves.motion((point + offset)[None], 5.0).dynamic_pressure[0]
        behind = waves.motion((point - offset)[None], 5.0).dynamic_pressure[0]
        assert -(ahead - behind) / (2.0 * step) == pytest.approx(rate[axis], rel=1e-5, abs=1e-8)


def test_the_pressure_is_that_of_the_air_at_the_moving_surface() -> None:
    """Exactly at a crest, to second order in a trough."""
    waves = regular(1.0, 6.0, 50.0)
    k = wave_numbers(np.array([2.0 * math.pi / 6.0]), 50.0)[0]
    for time in np.linspace(0.0, 6.0, 7):
        elevation = waves.elevation(np.zeros((1, 2)), float(time))[0]
        motion = waves.motion(np.array([[0.0, 0.0, elevation]]), float(time))
        error = motion.dynamic_pressure[0] - G * elevation
        limit = 0.0 if elevation > 0.0 else G * k * elevation**2
        assert -1e-9 <= error <= limit + 1e-9


def test_a_particle_drifts_as_stokes_says() -> None:
    """w k a^2 e^(2kz): 0.02927 m/s at the surface for H = 1 m, T = 6 s, of deep water."""
    height, period = 0.1, 6.0
    waves = regular(height, period, 4000.0)
    k = wave_numbers(np.array([2.0 * math.pi / period]), 4000.0)[0]
    for depth in (2.0, 6.0):
        crest = 0.5 * height * math.exp(-k * depth)  # it starts at the top of its orbit
        position, step = np.array([0.0, 0.0, crest - depth]), 0.01
        n = round(20.0 * period / step)
        for i in range(n):  # the midpoint rule
            velocity = waves.motion(position[None], i * step).velocity[0]
            middle = position + 0.5 * step * velocity
            position = position + step * waves.motion(middle[None], (i + 0.5) * step).velocity[0]
        drift = position[0] / (n * step)
        stokes = 0.02927 * height**2 * math.exp(-2.0 * k * depth)
        assert drift == pytest.approx(stokes, rel=0.01)


@pytest.mark.parametrize(("factor", "error"), [(1.0, 1e-3), (3.3, 2e-3), (7.0, 0.01)])
def test_a_spectrum_has_the_stated_height(factor: float, error: float) -> None:
    spectrum = Spectrum(significant_height=2.0, peak_period=8.0, peak_factor=factor)
    omega = np.linspace(0.05, 30.0, 400_000)
    height = 4.0 * math.sqrt(np.trapezoid(spectrum.density(omega), omega))
    assert height == pytest.approx(2.0, rel=error)
    assert omega[np.argmax(spectrum.density(omega))] == pytest.approx(2 * math.pi / 8.0, rel=1e-3)


@pytest.mark.parametrize(
    ("wind", "height", "period"), [(5.0, 0.533, 3.65), (10.0, 2.133, 7.30), (15.0, 4.799, 10.95)]
)
def test_a_fully_developed_sea_has_the_published_height(
    wind: float, height: float, period: float
) -> None:
    spectrum = Spectrum.from_wind(wind)
    assert spectrum.significant_height == pytest.approx(height, abs=1e-3)
    assert spectrum.peak_period == pytest.approx(period, abs=0.01)


@pytest.mark.parametrize("spreading", [None, 10.0])
@pytest.mark.parametrize(("height", "period", "factor"), [(1.5, 6.0, 3.3), (0.4, 9.0, 1.0)])
def test_a_record_of_the_elevation_has_the_stated_spectrum(
    spreading: float | None, height: float, period: float, factor: float
) -> None:
    spec = JonswapSpec(
        significant_height=height, peak_period=period, peak_factor=factor, spreading=spreading
    )
    waves = waves_of(spec.components(sea(), stream(1, "scene/waves/0")), 100.0)
    assert waves.significant_height == pytest.approx(height, rel=1e-12)
    step, n = 0.25, 4 * 6 * 3600
    record = np.array([waves.elevation(np.zeros((1, 2)), i * step)[0] for i in range(n)])
    assert 4.0 * np.std(record) == pytest.approx(height, rel=0.05)
    frequency, density = signal.welch(record, 1.0 / step, nperseg=1024, nfft=8192)
    # the period of the peak by the fourth moment, which a rough estimate of the peak does not move
    weight = density**4
    peak = float((frequency * weight).sum() / weight.sum())
    omega = 2.0 * math.pi * frequency[1:]
    stated = spec.spectrum.density(omega) ** 4
    stated_peak = float((frequency[1:] * stated).sum() / stated.sum())
    assert peak == pytest.approx(stated_peak, rel=0.05)


def test_a_group_travels_with_the_group_velocity() -> None:
    """Two waves beat; the envelope moves at dw/dk, half the phase speed in deep water."""
    periods = np.array([5.0, 5.2])
    omega = 2.0 * np.pi / periods
    components = WaveComponents(
        amplitude=np.full(2, 0.01), angular_frequency=omega,
        direction=np.zeros(2), phase=np.zeros(2),
    )  # fmt: skip
    waves = waves_of(components, 3000.0)
    time = 200.0
    x = np.linspace(500.0, 2600.0, 40_001)
    points = np.stack([x, np.zeros_like(x)], axis=1)
    envelope = np.abs(signal.hilbert(waves.elevation(points, time)))
    k = wave_numbers(omega, 3000.0)
    beat = 2.0 * math.pi / abs(k[0] - k[1])
    # crests of the envelope are at whole numbers of beats behind c_g t
    window = (x > 1000.0) & (x < 1000.0 + beat)
    crest = x[window][np.argmax(envelope[window])]
    expected = abs(omega[0] - omega[1]) / abs(k[0] - k[1]) * time
    offset = (crest - expected) / beat
    assert abs(offset - round(offset)) * beat < 0.01 * expected
    assert expected / time == pytest.approx(0.5 * float(np.mean(omega / k)), rel=1e-2)


def test_heights_of_waves_are_distributed_as_rayleigh_says() -> None:
    """A third of the waves average Hs within some percent, for a narrow spectrum."""
    spec = JonswapSpec(significant_height=1.0, peak_period=8.0, peak_factor=7.0)
    waves = waves_of(spec.components(sea(), stream(5, "scene/waves/0")), 100.0)
    record = np.array([waves.elevation(np.zeros((1, 2)), 0.2 * i)[0] for i in range(100_000)])
    crossings = np.flatnonzero((record[:-1] < 0.0) & (record[1:] >= 0.0))
    heights = np.sort([np.ptp(record[a:b]) for a, b in itertools.pairwise(crossings)])
    highest_third = heights[-len(heights) // 3 :].mean()
    assert highest_third == pytest.approx(0.95, rel=0.05)  # 0.95 Hs: Longuet-Higgins 1980


def test_uwsim_s_sea_has_its_height() -> None:
    """The root mean square elevations of the original's spectrum: 0.124 m and 0.98 m."""
    for settings, elevation in ((sea(1000.0), 0.124), (sea(1000.0, wind=(1.0, 1.0)), 0.98)):
        scale = 0.1 if settings.wind == (1.0, 1.0) else 1.0
        _, _, power = wave_power(settings)
        assert math.sqrt(2.0 * scale * power.sum()) == pytest.approx(elevation, rel=2e-3)
    heights = [
        UwsimOceanSpec().components(sea(1000.0), stream(seed, "s")).significant_height / 4.0
        for seed in range(40)
    ]
    assert np.mean(heights) == pytest.approx(0.124, rel=0.05)


def test_waves_run_in_the_direction_of_l_whatever_its_axes() -> None:
    """In a frame whose z points down, a direction turns from its x towards its y."""
    turn = Pose.from_rpy((5.0, -3.0, 2.0), (math.pi, 0.0, 0.3))
    spec = RegularWaveSpec(height=0.2, period=4.0, direction=0.5)
    waves = waves_of(spec.components(sea(), stream(0, "x")), 100.0, turn)
    travel = turn.rotation @ np.array([math.cos(0.5), math.sin(0.5), 0.0])
    k = wave_numbers(np.array([0.5 * math.pi]), 100.0)[0]
    crest = turn.position + travel * (2.0 * math.pi / k)
    assert waves.elevation(crest[None], 0.0)[0] == pytest.approx(0.1, rel=1e-9)
    speed = 0.5 * math.pi / k
    moved = turn.position + travel * speed * 1.7
    assert waves.elevation(moved[None], 1.7)[0] == pytest.approx(0.1, rel=1e-9)


def test_a_sea_of_height_0_is_level() -> None:
    components = JonswapSpec(significant_height=0.0, peak_period=5.0).components(
        sea(), stream(1, "s")
    )
    assert not components.amplitude.any()
    assert components.angular_frequency.all()


def test_the_same_seed_gives_the_same_sea() -> None:
    spec = JonswapSpec(significant_height=1.0, peak_period=6.0, spreading=20.0)
    first, second, other = (spec.components(sea(), stream(seed, "s")) for seed in (4, 4, 5))
    assert first.phase.tobytes() == second.phase.tobytes()
    assert first.direction.tobytes() == second.direction.tobytes()
    assert first.phase.tobytes() != other.phase.tobytes()


@pytest.mark.parametrize("wind_speed", [0.0, 6.0, 12.0])
def test_the_expected_height_of_uwsim_s_ocean_is_that_of_many_seeds(wind_speed: float) -> None:
    sea = SeaSettings(
        depth=50.0,
        wind=(0.04, 0.02),
        wind_speed=wind_speed,
        reflection_damping=0.35,
        wave_scale=1e-7,
    )
    spec = UwsimOceanSpec()
    heights = [spec.components(sea, stream(k, "waves")).significant_height for k in range(40)]
    variance = np.mean(np.square(heights))
    # few long waves have most of the energy, so that seeds differ by some 20 %
    assert math.sqrt(variance) == pytest.approx(spec.expected_height(sea), rel=0.1)
