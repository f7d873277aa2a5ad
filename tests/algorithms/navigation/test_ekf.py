"""The navigation filter against motions that are known."""

import math

import numpy as np
import pytest

from uwsim.algorithms.navigation import NavigationFilter, NavigationSpec
from uwsim.base.geometry import quaternion_from_rotation, rotation_from_rpy

RATE = 50.0
UP = np.array([0.0, 0.0, -9.81])


class Voyage:
    """A vehicle on a circle that also rolls and dives; its sensors have white noise."""

    def __init__(self, seed: int, spec: NavigationSpec, bias: float = 0.0) -> None:
        self.random = np.random.Generator(np.random.Philox(seed))
        self.spec, self.bias = spec, bias
        self.filter = NavigationFilter(spec)
        self.time, self.count = 0.0, 0

    def position(self, t: float) -> np.ndarray:
        return np.array([2.0 * math.sin(0.2 * t), 2.0 - 2.0 * math.cos(0.2 * t), 2.0 + 0.1 * t])

    def velocity(self, t: float) -> np.ndarray:
        return np.array([0.4 * math.cos(0.2 * t), 0.4 * math.sin(0.2 * t), 0.1])

    def acceleration(self, t: float) -> np.ndarray:
        return np.array([-0.08 * math.sin(0.2 * t), 0.08 * math.cos(0.2 * t), 0.0])

    def rotation(self, t: float) -> np.ndarray:
        return rotation_from_rpy(0.1 * math.sin(0.5 * t), 0.0, 0.2 * t)

    def rate(self, t: float) -> np.ndarray:
        step = 1e-5
        turn = self.rotation(t).T @ (self.rotation(t + step) - self.rotation(t - step)) / 2 / step
        return np.array([turn[2, 1], turn[0, 2], turn[1, 0]])

    def noise(self, deviation: float, size: int = 3) -> np.ndarray:
        return deviation * self.random.standard_normal(size)

    def sail(self, seconds: float) -> None:
        spec = self.spec
        for _ in range(round(seconds * RATE)):
            t, r = self.time, self.rotation(self.time)
            turned = rotation_from_rpy(*self.noise(spec.attitude)) @ r
            self.filter.update_imu(
                t,
                quaternion_from_rotation(turned),
                self.rate(t) + self.bias + self.noise(spec.gyro * math.sqrt(RATE)),
                r.T @ (self.acceleration(t) + UP) + self.noise(1e-3),
            )
            if self.count % 10 == 0:
                place = np.array(spec.dvl_place)
                seen = r.T @ self.velocity(t) + np.cross(self.rate(t), place)
                self.filter.update_dvl(seen + self.noise(spec.dvl))
                height = (self.position(t) + r @ np.array(spec.depth_place))[2]
                self.filter.update_depth(float(height + self.noise(spec.depth, 1)[0]))
            self.count += 1
            self.time += 1.0 / RATE

    def error(self) -> np.ndarray:
        """Of place (from where it began; depth as it is), velocity and attitude, (9,)."""
        t = self.time - 1.0 / RATE
        begun = np.array([*self.position(0.0)[:2], 0.0])
        turn = self.rotation(t) @ self.filter.rotation.T
        vector = 0.5 * np.array(
            [turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]]
        )
        return np.concatenate(
            [
                self.position(t) - begun - self.filter.position,
                self.velocity(t) - self.filter.velocity,
                vector,
            ]
        )


@pytest.mark.parametrize("place", [(0.0, 0.0, 0.0), (0.5, -0.2, 0.8)])
def test_it_knows_where_the_vehicle_is(place: tuple[float, float, float]) -> None:
    voyage = Voyage(1, NavigationSpec(dvl_place=place, depth_place=place))
    voyage.sail(60.0)
    error = np.abs(voyage.error())
    assert error[:3].max() < 0.1
    assert error[3:6].max() < 0.02
    assert error[6:].max() < 0.005


def test_its_covariance_is_that_of_its_errors() -> None:
    """The normalised squared error of nine states is nine on average (Bar-Shalom, 5.4)."""
    squares = []
    for seed in range(12):
        voyage = Voyage(seed, NavigationSpec(accelerometer=1e-3 * 5.0))
        voyage.sail(20.0)
        error = voyage.error()
        squares.append(error @ np.linalg.solve(voyage.filter.covariance[:9, :9], error))
    assert 2.0 < np.mean(squares) < 16.0


def test_it_learns_the_bias_of_the_gyroscope() -> None:
    voyage = Voyage(3, NavigationSpec(gyro_drift=1e-4), bias=0.003)
    voyage.sail(60.0)
    assert voyage.filter.gyro_bias == pytest.approx([0.003] * 3, abs=0.001)


def test_one_wrong_velocity_is_ignored() -> None:
    voyage = Voyage(4, NavigationSpec())
    voyage.sail(20.0)
    before = voyage.filter.velocity.copy()
    voyage.filter.update_dvl(np.array([3.0, -2.0, 1.0]))
    voyage.filter.update_dvl(np.full(3, np.nan))
    assert np.array_equal(voyage.filter.velocity, before)


def test_a_sensor_that_insists_is_believed() -> None:
    voyage = Voyage(4, NavigationSpec())
    voyage.sail(20.0)
    for _ in range(40):
        voyage.filter.update_depth(7.0)
    assert voyage.filter.position[2] == pytest.approx(7.0, abs=0.3)


def test_it_is_ready_with_the_first_attitude() -> None:
    nav = NavigationFilter()
    assert not nav.is_ready
    nav.update_imu(0.0, np.array([np.nan, 0, 0, 0]), np.zeros(3), UP)
    assert not nav.is_ready
    nav.update_imu(0.0, quaternion_from_rotation(rotation_from_rpy(0, 0, 1.0)), np.zeros(3), UP)
    assert nav.is_ready
    assert nav.heading == pytest.approx(1.0)
