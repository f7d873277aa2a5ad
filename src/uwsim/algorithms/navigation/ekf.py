r"""An extended Kalman filter over an IMU, a DVL and a depth sensor.

Navigation frame: axes north, east, down (those of L in a scene with the usual offset); its origin
is where the filter began, but for the depth, which is that below the surface. The error state is

.. math:: \delta x = (\delta p, \delta v, \delta\theta, \delta b_g, \delta b_a) \in R^{15}

with the position p and velocity v of the base, the small rotation :math:`\delta\theta` in
navigation axes (:math:`R_{true} = \exp(\delta\theta) R`), and the biases of gyroscope and
accelerometer. Between measurements, with the specific force f and the angular rate w of the IMU,

.. math:: \dot p = v, \quad \dot v = R (f - b_a) + g, \quad \dot R = R [w - b_g]_\times

(J. Sola, *Quaternion kinematics for the error-state Kalman filter*, 2017). Corrections: attitude of
the IMU, velocity over ground of the DVL, depth. A measurement whose squared Mahalanobis distance
is above `GATE` is ignored, `MAX_REJECTED` in a row at most; then the
covariance grows until it fits.

Not modelled: rotation of the Earth, scale errors of the DVL, a gyroscope that is not at the base.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from ...base.geometry import Array, rotation_from_quaternion
from ...base.numerics.linear import cross, product, rotate, rotate_back
from .kernel import corrected, distance, propagated, turn_between, turned_by

POSITION, VELOCITY, ATTITUDE = slice(0, 3), slice(3, 6), slice(6, 9)
GYRO_BIAS, ACCELEROMETER_BIAS = slice(9, 12), slice(12, 15)
SIZE = 15
GRAVITY = np.array([0.0, 0.0, 9.81])
"""In navigation axes [m/s2]."""
GATE = 25.0
"""Largest squared Mahalanobis distance of a measurement that is used."""
MAX_REJECTED = 10
"""So many measurements of a sensor in a row are ignored; the next is used anyway."""
IMU_SEES: Array = np.eye(3, SIZE, 6)
"""Jacobian of the attitude, (3, 15)."""
MAX_GAP = 0.5
"""The IMU is not integrated over a longer silence [s]."""


@dataclass(frozen=True, kw_only=True)
class NavigationSpec:
    """Errors of the sensors, as standard deviations, and where they are on the base."""

    attitude: float = 0.01
    """Attitude of the IMU [rad]."""
    gyro: float = 2e-3
    """White noise of the gyroscope [rad/s/sqrt(Hz)]."""
    accelerometer: float = 0.02
    """White noise of the accelerometer, and of what its samples miss [m/s2/sqrt(Hz)]."""
    gyro_drift: float = 1e-5
    """Random walk of the gyroscope's bias [rad/s/sqrt(s)]."""
    accelerometer_drift: float = 1e-3
    """Random walk of the accelerometer's bias [m/s2/sqrt(s)]."""
    dvl: float = 0.01
    """Each component of the DVL's velocity [m/s]."""
    depth: float = 0.02
    """Depth [m]."""
    imu_place: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """IMU in the base's frame [m]."""
    dvl_place: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """DVL in the base's frame [m]."""
    depth_place: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """Depth sensor in the base's frame [m]."""


@dataclass(eq=False)
class NavigationFilter:
    """The filter: `imu` predicts and corrects the attitude; `dvl` and `depth` correct.

    Raises nothing: measurements that are not finite are ignored.
    """

    spec: NavigationSpec = field(default_factory=NavigationSpec)
    position: Array = field(default_factory=lambda: np.zeros(3))
    """Of the base in the navigation frame, (3,) [m]."""
    velocity: Array = field(default_factory=lambda: np.zeros(3))
    """Of the base over ground, navigation axes, (3,) [m/s]."""
    rotation: Array = field(default_factory=lambda: np.eye(3))
    """Axes of the base in the navigation frame, (3, 3)."""
    rate: Array = field(default_factory=lambda: np.zeros(3))
    """Angular velocity without its bias, base axes, (3,) [rad/s]."""

    def __post_init__(self) -> None:
        self.gyro_bias, self.accelerometer_bias = np.zeros(3), np.zeros(3)
        deviations = [0.0, 0.0, 0.5, *[0.3] * 3, *[self.spec.attitude] * 3, *[1e-3] * 3, *[0.1] * 3]
        self.covariance: Array = np.diag(np.square(deviations))
        """Of the error state, (15, 15)."""
        self._time: float | None = None
        self._rejected: dict[str, int] = {}
        white = [self.spec.accelerometer, self.spec.gyro]
        drifts = [self.spec.gyro_drift, self.spec.accelerometer_drift]
        self._noise: Array = np.repeat(np.square([0.0, *white, *drifts]), 3)

    @property
    def is_ready(self) -> bool:
        """Whether the attitude is known."""
        return self._time is not None

    @property
    def heading(self) -> float:
        """Of the base, from north towards east [rad]."""
        return math.atan2(self.rotation[1, 0], self.rotation[0, 0])

    def imu(self, time: float, wxyz: Array, rate: Array, force: Array) -> None:
        """Take a sample of the IMU, whose axes are those of the base.

        Args:
            time: of the sample [s].
            wxyz: attitude, navigation frame from base, (4,).
            rate: angular velocity, base axes, (3,) [rad/s].
            force: specific force, base axes, (3,) [m/s2]; 9.81 upwards at rest.
        """
        if not math.isfinite(wxyz.sum() + rate.sum() + force.sum()):  # as any part of it is not
            return
        measured = rotation_from_quaternion(wxyz)
        if self._time is None:
            self._time, self.rotation = time, measured
            return
        step, self._time = time - self._time, time
        if 0.0 < step <= MAX_GAP:
            self._predict(step, rate - self.gyro_bias, force - self.accelerometer_bias)
        turn = turn_between(self.rotation, measured)
        self._correct("imu", turn, IMU_SEES, self.spec.attitude)

    def dvl(self, velocity: Array) -> None:
        """Take a velocity over ground in the axes of the base, (3,) [m/s]; NaN if not known."""
        place = np.array(self.spec.dvl_place)
        expected = rotate_back(self.rotation, self.velocity) + cross(self.rate, place)
        jacobian = np.zeros((3, SIZE))
        jacobian[:, VELOCITY] = self.rotation.T
        jacobian[:, ATTITUDE] = product(self.rotation.T, _cross(self.velocity))
        jacobian[:, GYRO_BIAS] = _cross(place)
        self._correct("dvl", velocity - expected, jacobian, self.spec.dvl)

    def depth(self, depth: float) -> None:
        """Take the depth of the sensor below the surface [m]."""
        arm = rotate(self.rotation, np.array(self.spec.depth_place))
        jacobian = np.zeros((1, SIZE))
        jacobian[0, 2] = 1.0
        jacobian[0, ATTITUDE] = -_cross(arm)[2]
        error = np.array([depth - float(self.position[2] + arm[2])])
        self._correct("depth", error, jacobian, self.spec.depth)

    def _predict(self, step: float, rate: Array, force: Array) -> None:
        spec = self.spec
        # the IMU's place moves with the base: its centripetal force is not the base's own
        if any(spec.imu_place):
            force = force - cross(rate, cross(rate, np.array(spec.imu_place)))
        acceleration = rotate(self.rotation, force) + GRAVITY
        self.covariance = propagated(
            self.covariance, self.rotation, acceleration - GRAVITY, step, self._noise
        )
        self.position = self.position + step * self.velocity + 0.5 * step**2 * acceleration
        self.velocity = self.velocity + step * acceleration
        self.rotation = turned_by(self.rotation, step * rate, in_base=True)
        self.rate = rate

    def _correct(self, sensor: str, error: Array, jacobian: Array, deviation: float) -> None:
        """Correct the state by the difference of measured and expected values (m,)."""
        if not np.isfinite(error).all():
            return
        rejected = self._rejected.get(sensor, 0)
        off = distance(self.covariance, jacobian, error, deviation**2) / GATE
        if off > 1.0 and rejected < MAX_REJECTED:
            self._rejected[sensor] = rejected + 1
            return
        if off > 1.0:  # it insists: what was believed is less sure than that
            self.covariance = off * self.covariance
        self._rejected[sensor] = 0
        by, self.covariance = corrected(self.covariance, jacobian, error, deviation**2)
        self._move(by)

    def _move(self, by: Array) -> None:
        """Add an error state (15,) to the state."""
        self.position = self.position + by[POSITION]
        self.velocity = self.velocity + by[VELOCITY]
        self.gyro_bias = self.gyro_bias + by[GYRO_BIAS]
        self.accelerometer_bias = self.accelerometer_bias + by[ACCELEROMETER_BIAS]
        self.rotation = turned_by(self.rotation, by[ATTITUDE], in_base=False)


def _cross(vector: Array) -> Array:
    """Return the matrix of ``vector x``, (3, 3)."""
    x, y, z = vector.tolist()
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
