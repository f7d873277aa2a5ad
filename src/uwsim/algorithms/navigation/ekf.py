r"""An extended Kalman filter that estimates a vehicle's motion from IMU, DVL and depth sensor.

The navigation frame has the axes north, east, down. (In a scene with the usual offset, the
localized world frame L has these axes, too.) Its origin is at the water surface, above the position
of the vehicle when the filter starts. The error state is

.. math:: \delta x = (\delta p, \delta v, \delta\theta, \delta b_g, \delta b_a) \in R^{15}

with the position p and velocity v of the vehicle's base, the small rotation :math:`\delta\theta` in
navigation axes (:math:`R_{true} = \exp(\delta\theta) R`, R being navigation_from_base), and the
biases :math:`b_g, b_a` of gyroscope and accelerometer. The IMU measures the specific force f and
the angular rate w in base axes; between other measurements,

.. math:: \dot p = v, \quad \dot v = R (f - b_a) + g, \quad \dot R = R [w - b_g]_\times

with the gravity g (J. Sola, *Quaternion kinematics for the error-state Kalman filter*, 2017). The
state is corrected by the attitude of the IMU, the velocity over ground of the DVL, and the depth. A
measurement whose squared Mahalanobis distance is above `GATE` is ignored. After `MAX_REJECTED`
ignored measurements of a sensor in a row, the covariance is increased so that the next one is used.

Not modelled: the rotation of the Earth, scale errors of the DVL, and the effect of an angular
acceleration on an IMU that is not at the origin of the base.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from ...base.geometry import Array, cross_matrix, rotation_from_quaternion
from ...base.numerics.linear import cross, product, rotate, rotate_back
from .kernel import correct, propagate, rotate_by, rotation_between, squared_distance

POSITION, VELOCITY, ATTITUDE = slice(0, 3), slice(3, 6), slice(6, 9)
GYRO_BIAS, ACCELEROMETER_BIAS = slice(9, 12), slice(12, 15)
"""The parts of the error state."""
STATE_SIZE = 15
"""The number of components of the error state."""
GRAVITY = np.array([0.0, 0.0, 9.81])
"""The gravity in navigation axes, (3,) [m/s2]."""
GATE = 25.0
"""The largest squared Mahalanobis distance of a measurement that is used."""
MAX_REJECTED = 10
"""The greatest number of measurements of a sensor that are ignored in a row."""
ATTITUDE_JACOBIAN: Array = np.eye(3, STATE_SIZE, 6)
"""The Jacobian of a measured attitude with respect to the error state, (3, 15)."""
MAX_IMU_INTERVAL = 0.5
"""The longest time between two samples of the IMU that is integrated [s]."""


@dataclass(frozen=True, kw_only=True)
class NavigationSpec:
    """The noise of the sensors, and their positions on the vehicle's base.

    Each noise is a standard deviation, or the density of a white noise.
    """

    attitude: float = 0.01
    """The error of the IMU's attitude about each axis [rad]."""
    gyro: float = 2e-3
    """The noise density of the gyroscope [rad/s/sqrt(Hz)]."""
    accelerometer: float = 0.02
    """The noise density of the accelerometer, which includes the error of sampling it
    [m/s2/sqrt(Hz)]."""
    gyro_drift: float = 1e-5
    """The random walk of the gyroscope's bias [rad/s/sqrt(s)]."""
    accelerometer_drift: float = 1e-3
    """The random walk of the accelerometer's bias [m/s2/sqrt(s)]."""
    dvl: float = 0.01
    """The error of each component of the velocity that the DVL measures [m/s]."""
    depth: float = 0.02
    """The error of the depth [m]."""
    imu_place: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """The position of the IMU in the base's frame [m]."""
    dvl_place: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """The position of the DVL in the base's frame [m]."""
    depth_place: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """The position of the depth sensor in the base's frame [m]."""


@dataclass(eq=False)
class NavigationFilter:
    """An error-state extended Kalman filter; measurements that are not finite are ignored."""

    spec: NavigationSpec = field(default_factory=NavigationSpec)
    """The noise and the positions of the sensors."""
    position: Array = field(default_factory=lambda: np.zeros(3))
    """The position of the base in the navigation frame, (3,) [m]."""
    velocity: Array = field(default_factory=lambda: np.zeros(3))
    """The velocity of the base over ground, navigation axes, (3,) [m/s]."""
    rotation: Array = field(default_factory=lambda: np.eye(3))
    """The rotation ``navigation_from_base``, whose columns are the axes of the base, (3, 3)."""
    angular_velocity: Array = field(default_factory=lambda: np.zeros(3))
    """The measured angular velocity minus the bias, base axes, (3,) [rad/s]."""

    def __post_init__(self) -> None:
        self.gyro_bias, self.accelerometer_bias = np.zeros(3), np.zeros(3)
        """The biases, base axes, (3,) [rad/s] and (3,) [m/s2]."""
        deviations = [0.0, 0.0, 0.5, *[0.3] * 3, *[self.spec.attitude] * 3, *[1e-3] * 3, *[0.1] * 3]
        self.covariance: Array = np.diag(np.square(deviations))
        """The covariance of the error state, (15, 15)."""
        self._time: float | None = None  # the time of the last sample of the IMU [s]
        self._n_rejected: dict[str, int] = {}  # rejected measurements in a row, by sensor
        noise_densities = [self.spec.accelerometer, self.spec.gyro]
        bias_drifts = [self.spec.gyro_drift, self.spec.accelerometer_drift]
        self._noise: Array = np.repeat(np.square([0.0, *noise_densities, *bias_drifts]), 3)

    @property
    def is_ready(self) -> bool:
        """True if the attitude was measured."""
        return self._time is not None

    @property
    def heading(self) -> float:
        """The heading of the base, from north towards east [rad]."""
        return math.atan2(self.rotation[1, 0], self.rotation[0, 0])

    def update_imu(self, time: float, wxyz: Array, rate: Array, force: Array) -> None:
        """Predict the state up to a sample of the IMU, and correct it by the sample's attitude.

        Args:
            time: the time of the sample [s].
            wxyz: the measured attitude, the quaternion ``navigation_from_base``, (4,).
            rate: the measured angular velocity, base axes, (3,) [rad/s].
            force: the measured specific force, base axes, (3,) [m/s2]; 9.81 upwards at rest.
        """
        # The sum is finite only if all of its terms are.
        if not math.isfinite(wxyz.sum() + rate.sum() + force.sum()):
            return
        measured_rotation = rotation_from_quaternion(wxyz)
        if self._time is None:
            self._time, self.rotation = time, measured_rotation
            return
        dt, self._time = time - self._time, time
        if 0.0 < dt <= MAX_IMU_INTERVAL:
            self._predict(dt, rate - self.gyro_bias, force - self.accelerometer_bias)
        rotation_vector = rotation_between(self.rotation, measured_rotation)
        self._correct("imu", rotation_vector, ATTITUDE_JACOBIAN, self.spec.attitude)

    def update_dvl(self, velocity: Array) -> None:
        """Correct the state by the velocity of the DVL over ground, base axes, (3,) [m/s].

        The velocity is NaN if it was not measured.
        """
        lever_arm = np.array(self.spec.dvl_place)
        expected = rotate_back(self.rotation, self.velocity)
        expected = expected + cross(self.angular_velocity, lever_arm)
        jacobian = np.zeros((3, STATE_SIZE))
        jacobian[:, VELOCITY] = self.rotation.T
        jacobian[:, ATTITUDE] = product(self.rotation.T, cross_matrix(self.velocity))
        jacobian[:, GYRO_BIAS] = cross_matrix(lever_arm)
        self._correct("dvl", velocity - expected, jacobian, self.spec.dvl)

    def update_depth(self, depth: float) -> None:
        """Correct the state by the depth of the depth sensor below the surface [m]."""
        lever_arm = rotate(self.rotation, np.array(self.spec.depth_place))
        jacobian = np.zeros((1, STATE_SIZE))
        jacobian[0, 2] = 1.0
        jacobian[0, ATTITUDE] = -cross_matrix(lever_arm)[2]
        error = np.array([depth - float(self.position[2] + lever_arm[2])])
        self._correct("depth", error, jacobian, self.spec.depth)

    def _predict(self, dt: float, rate: Array, force: Array) -> None:
        spec = self.spec
        # Subtract the centripetal acceleration of the IMU about the base.
        if any(spec.imu_place):
            force = force - cross(rate, cross(rate, np.array(spec.imu_place)))
        acceleration = rotate(self.rotation, force) + GRAVITY
        self.covariance = propagate(
            self.covariance, self.rotation, acceleration - GRAVITY, dt, self._noise
        )
        self.position = self.position + dt * self.velocity + 0.5 * dt**2 * acceleration
        self.velocity = self.velocity + dt * acceleration
        self.rotation = rotate_by(self.rotation, dt * rate, in_base=True)
        self.angular_velocity = rate

    def _correct(self, sensor: str, error: Array, jacobian: Array, deviation: float) -> None:
        """Correct the state by a measurement.

        Args:
            sensor: the name of the sensor.
            error: the measured minus the expected values, (m,).
            jacobian: the derivatives of the values with respect to the error state, (m, 15).
            deviation: the standard deviation of each value.
        """
        if not np.isfinite(error).all():
            return
        n_rejected = self._n_rejected.get(sensor, 0)
        ratio = squared_distance(self.covariance, jacobian, error, deviation**2) / GATE
        if ratio > 1.0 and n_rejected < MAX_REJECTED:
            self._n_rejected[sensor] = n_rejected + 1
            return
        if ratio > 1.0:  # the covariance was too small
            self.covariance = ratio * self.covariance
        self._n_rejected[sensor] = 0
        correction, self.covariance = correct(self.covariance, jacobian, error, deviation**2)
        self._add_error_state(correction)

    def _add_error_state(self, error: Array) -> None:
        self.position = self.position + error[POSITION]
        self.velocity = self.velocity + error[VELOCITY]
        self.gyro_bias = self.gyro_bias + error[GYRO_BIAS]
        self.accelerometer_bias = self.accelerometer_bias + error[ACCELEROMETER_BIAS]
        self.rotation = rotate_by(self.rotation, error[ATTITUDE], in_base=False)
