"""Ports against Snell's law in closed form and a tracer by angles and root finding."""

from __future__ import annotations

import math

import pytest
from scipy.optimize import brentq

from uwsim.cameras import DomePort, FlatPort
from uwsim.cameras.port import find_air_tangent, refract

TANGENTS = (1e-4, 0.05, 0.2, 0.5, 0.8)
N = 1.333


def refract_tangent(tangent: float, n: float = N) -> float:
    """Return the tangent behind a plane by Snell's law: sin(air) = n sin(behind)."""
    return math.tan(math.asin(math.sin(math.atan(tangent)) / n))


@pytest.mark.parametrize("tangent", TANGENTS)
@pytest.mark.parametrize("glass_index", [1.49, 1.52, 1.77])
def test_the_direction_behind_a_flat_port_is_snells_whatever_the_glass(
    tangent: float, glass_index: float
) -> None:
    port = FlatPort(distance=0.03, thickness=0.012, glass_index=glass_index)
    point, direction = port.trace(tangent)
    assert direction[0] / direction[1] == pytest.approx(refract_tangent(tangent), rel=1e-12)
    height = 0.03 * tangent + 0.012 * refract_tangent(tangent, glass_index)
    assert point == pytest.approx([height, 0.042], rel=1e-12)


def test_a_flat_port_multiplies_the_focal_length_by_the_index() -> None:
    port = FlatPort()
    assert port.magnification == pytest.approx(N, rel=1e-12)
    assert 1e-4 / refract(1e-4, port.constants) == pytest.approx(N, rel=1e-6)


def test_the_effective_centre_is_where_rays_near_the_axis_meet() -> None:
    for port in (FlatPort(), DomePort(offset=0.012), DomePort(offset=-0.01, radius=0.04)):
        point, direction = port.trace(1e-5)
        place = point[1] - point[0] * direction[1] / direction[0]
        assert -port.centre_offset == pytest.approx(place, abs=1e-9)
    # n - 1 times the distance of the glass, less the shift by the glass itself
    expected = 0.02 * (N - 1.0) + 0.008 * (N / 1.49 - 1.0)
    assert FlatPort().centre_offset == pytest.approx(expected, rel=1e-12)


def test_a_dome_whose_centre_is_the_pupil_does_not_refract() -> None:
    port = DomePort(radius=0.06, thickness=0.005, offset=0.0)
    assert port.magnification == pytest.approx(1.0, abs=1e-12)
    for tangent in TANGENTS:
        assert refract(tangent, port.constants) == pytest.approx(tangent, rel=1e-12)


@pytest.mark.parametrize("offset", [0.015, -0.02])
@pytest.mark.parametrize("tangent", TANGENTS)
def test_a_dome_off_the_pupil_is_as_by_angles_and_root_finding(
    offset: float, tangent: float
) -> None:
    port = DomePort(radius=0.05, thickness=0.008, offset=offset, glass_index=1.52)
    angle, x, z = math.atan(tangent), 0.0, 0.0
    for radius, index, next_index in ((0.05, 1.0, 1.52), (0.058, 1.52, N)):

        def distance_inside(
            length: float, x: float = x, z: float = z, angle: float = angle, radius: float = radius
        ) -> float:
            x, z = x + length * math.sin(angle), z + length * math.cos(angle)
            return math.hypot(x, z - offset) - radius

        length = brentq(distance_inside, 0.0, 1.0, xtol=1e-15)
        x, z = x + length * math.sin(angle), z + length * math.cos(angle)
        normal = math.atan2(x, z - offset)
        angle = normal + math.asin(index / next_index * math.sin(angle - normal))
    point, direction = port.trace(tangent)
    assert point == pytest.approx([x, z], abs=1e-12)
    assert math.atan2(*direction) == pytest.approx(angle, abs=1e-12)


@pytest.mark.parametrize("port", [FlatPort(), DomePort(offset=0.01), DomePort(offset=-0.01)])
def test_the_inverse_gives_the_tangent_in_air_back(port: FlatPort | DomePort) -> None:
    for tangent in TANGENTS:
        in_water = refract(tangent, port.constants)
        assert find_air_tangent(in_water, port.constants) == pytest.approx(tangent, rel=1e-10)


def test_there_is_no_ray_beyond_the_critical_angle() -> None:
    limit = 1.0 / math.sqrt(N * N - 1.0)  # the tangent of asin(1 / n)
    port = FlatPort(distance=1e-6, thickness=0.0, focus_distance=100.0)
    assert math.isnan(find_air_tangent(limit * 1.01, port.constants))
    assert find_air_tangent(limit * 0.95, port.constants) > 2.0


def test_points_off_the_focus_distance_are_displaced_as_stated() -> None:
    """The displacement is f h0 (1/Z - 1/Z0), with the exact ray through the point."""
    port, focal, tangent = FlatPort(distance=0.03), 600.0, 0.6
    point, direction = port.trace(tangent)
    slope = direction[0] / direction[1]
    height_at_centre = point[0] - slope * (point[1] + port.centre_offset)
    for distance in (0.4, 1.0, 3.0):
        exact = (height_at_centre + slope * distance) / distance
        displacement = focal * (exact - refract(tangent, port.constants))
        stated = focal * height_at_centre * (1.0 / distance - 1.0 / port.focus_distance)
        assert displacement == pytest.approx(stated, abs=1e-9)
        assert abs(displacement) < 2.0
