r"""The steering of a vehicle in manoeuvres, from its hydrodynamics: thrust, rudders and gains.

*Fins.* A small turn by :math:`\delta` of a fin with the area S, the slope a of its lift and the
position r exerts the force :math:`\frac12 \rho U^2 S a \delta` along :math:`n`, the product of its
axis and its chord. Its moments about the vertical and the lateral axis say how much it is a rudder
or an elevator; the fins of an X-tail are both.

*Thrusters.* The approach has half of the greatest surge force, so that the rest can steer. The yaw
moment at 35° of rudder is the greatest that the thrusters add to that force to either side.

*Gains.* The loops of fins and of depth are those of :math:`I \ddot\psi = k \delta` with the
frequency U / L and a damping ratio of 1, without the moments of the hull. The speed U is that at
which the thrust equals the drag of the hull. Thrusters hold heading, roll and pitch with four times
this frequency and with the Munk moment :math:`(A_{22} - A_{11}) U^2` in their stiffness. The loops
hold the vehicle in the approach; the numbers of a manoeuvre depend on them by depth, roll and pitch
alone.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..base.geometry import Array
from ..errors import BadSetting
from ..model.scene_model import SceneModel
from ..physics.actuation.allocation import Allocation, allocate, thrusters_on_base
from ..scene.hydrodynamics import VehicleHydrodynamics
from ..scene.hydrodynamics.spec import FinSpec, matrix

SURGE, SWAY, HEAVE, ROLL, PITCH, YAW = 0, 1, 2, 3, 4, 5
STIFF_FACTOR = 4.0
"""The frequency of the loops of thrusters for heading, roll and pitch, in units of U / L [1]."""
INTEGRAL_SHARE = 0.2
"""The integral gain of the heading, as a share of its proportional gain times U / L [1]."""
HARD_OVER = 35.0
"""The rudder angle of a ship that is hard over, and that of a vehicle without rudder [deg]."""
APPROACH_SHARE = 0.5
"""The share of the greatest surge force in the approach of a vehicle that thrusters steer [1]."""
MIN_SHARE = 0.05
"""The share of the greatest moment of a fin below which a fin does not count [1]."""
N_TIME_CONSTANTS = 10.0
"""The duration of the approach, in time constants of the speed [1]."""


def compute_steering(model: SceneModel, length: float) -> dict[str, float | str]:
    """Compute the parameters of steering for manoeuvring algorithms.

    Args:
        model: the model of the scene of an experiment.
        length: the length of the vehicle [m].

    Raises:
        BadSetting: the vehicle has no thrust ahead, or nothing that turns it.
    """
    dynamics = model.dynamics[0]
    robot = model.robots[0]
    rotation = model.scene.vehicles[0].localized_from_base.rotation
    side = 1.0 if rotation[2, 2] > 0.0 else -1.0  # z of the base points down, or up
    thrusters = thrusters_on_base(robot, dynamics.thrusters)
    allocation = allocate(thrusters, np.zeros(3))
    if SURGE not in allocation.axes:
        raise BadSetting(f"The thrusters of {dynamics.name!r} cannot push the vehicle ahead.")
    backward, forward = allocation.force_limits(SURGE)
    mass, added_mass = compute_mass(model), compute_added_mass(dynamics)
    linear, quadratic = damping(dynamics, SURGE)
    rudders, elevators, moments, limit = classify_fins(dynamics, side)
    has_rudders = any(rudders)
    surge_force = forward if has_rudders else APPROACH_SHARE * forward
    speed = steady_speed(surge_force, linear, quadratic)
    if not speed > 0.0:
        raise BadSetting(f"The hull of {dynamics.name!r} has no drag along surge.")
    time_constant = mass[SURGE] / (linear + 2.0 * quadratic * speed)
    parameters: dict[str, float | str] = {
        "ahead": surge_force,
        "astern": -backward,
        "approach": min(max(N_TIME_CONSTANTS * time_constant, 20.0), 300.0),
        "limit": HARD_OVER,
    }
    hull = Hull(mass=mass, added_mass=added_mass, speed=speed, length=length)
    if has_rudders:
        pressure = 0.5 * dynamics.density * speed**2
        parameters |= {
            "rudders": join_numbers(rudders),
            "elevators": join_numbers(elevators),
            "limit": math.degrees(limit),
            **hull.gains("heading", YAW, pressure * moments[0]),
        }
        if moments[1] > 0.0:
            parameters |= hull.gains("pitch", PITCH, pressure * moments[1])
            parameters["pitch_per_depth"] = 0.2 / length
    else:
        per_radian = find_yaw_moment(allocation, surge_force) / math.radians(HARD_OVER)
        parameters["yaw_moment"] = per_radian
        parameters |= hull.stiff_gains("heading", YAW, per_radian)
    parameters["heading_ki"] = INTEGRAL_SHARE * speed / length * float(parameters["heading_kp"])
    if not any(elevators):
        for name, axis in (("roll", ROLL), ("trim", PITCH)):
            if axis in allocation.axes:
                parameters |= hull.stiff_gains(name, axis, 1.0)
        if HEAVE in allocation.axes:
            parameters |= hull.gains("heave", HEAVE, 1.0)
    topics: dict[str, float | str] = {"odometry_topic": "/odometry", "wrench_topic": "/wrench"}
    topics["fins_topic"] = "/fins" if dynamics.fins else ""
    numbers = {k: v if isinstance(v, str) else float(v) for k, v in parameters.items()}
    return {**topics, "yaw_moment": 0.0, **numbers}


@dataclass(frozen=True, eq=False, kw_only=True)
class Hull:
    """The numbers of a hull that gains follow from."""

    mass: Array
    """The masses and inertias with added mass, (6,) [kg, kg m2]."""
    added_mass: Array
    """The added masses, (6,) [kg, kg m2]."""
    speed: float
    """The speed U [m/s]."""
    length: float
    """The length L [m]."""

    def gains(self, name: str, axis: int, effect: float) -> dict[str, float]:
        """Return gains with the frequency U / L and a damping ratio of 1.

        Args:
            name: the name of the loop.
            axis: the index of the axis.
            effect: the force or moment per command.
        """
        frequency = self.speed / self.length
        return self._name_gains(name, axis, effect, self.mass[axis] * frequency**2)

    def stiff_gains(self, name: str, axis: int, effect: float) -> dict[str, float]:
        """Return gains with a multiple of U / L, and with the Munk moment in their stiffness."""
        frequency = STIFF_FACTOR * self.speed / self.length
        lateral_axis = SWAY if axis == YAW else HEAVE
        munk = max(self.added_mass[lateral_axis] - self.added_mass[SURGE], 0.0) * self.speed**2
        return self._name_gains(name, axis, effect, self.mass[axis] * frequency**2 + munk)

    def _name_gains(
        self, name: str, axis: int, effect: float, stiffness: float
    ) -> dict[str, float]:
        damping_constant = 2.0 * math.sqrt(stiffness * self.mass[axis])
        return {f"{name}_kp": stiffness / effect, f"{name}_kd": damping_constant / effect}


def compute_mass(model: SceneModel) -> Array:
    """Return the sums of the masses and inertias of all links, with added mass, about axes (6,).

    Inertias of links other than the root are taken at the root, an estimate for gains.
    """
    dynamics, robot = model.dynamics[0], model.robots[0]
    total = np.zeros(6)
    for link in robot.links:
        body = dynamics.body(link.name)
        mass = link.mass if body is None or body.mass is None else body.mass
        inertia = link.inertia if body is None or body.inertia is None else body.inertia
        total[:3] += mass
        total[3:] += inertia[:3]
    return total + compute_added_mass(dynamics)


def compute_added_mass(dynamics: VehicleHydrodynamics) -> Array:
    """Return the sum of the added masses of all bodies, the diagonal, (6,)."""
    total = np.zeros(6)
    for body in dynamics.bodies:
        total += np.diag(matrix(body.added_mass))
    return total


def damping(dynamics: VehicleHydrodynamics, axis: int) -> tuple[float, float]:
    """Return the sums of linear and quadratic damping of all bodies along an axis."""
    linear = sum(float(matrix(body.linear_damping)[axis, axis]) for body in dynamics.bodies)
    quadratic = sum(float(matrix(body.quadratic_damping)[axis, axis]) for body in dynamics.bodies)
    return linear, quadratic


def steady_speed(force: float, linear: float, quadratic: float) -> float:
    """Return the speed at which linear and quadratic drag equal a force [m/s]; 0 without drag."""
    if quadratic > 0.0:
        root = math.sqrt(linear**2 + 4.0 * quadratic * force)
        return (root - linear) / (2.0 * quadratic)
    return force / linear if linear > 0.0 else 0.0


def classify_fins(
    dynamics: VehicleHydrodynamics, side: float
) -> tuple[list[float], list[float], tuple[float, float], float]:
    """Return the angles of the fins for rudder and elevator, their moments and their limit.

    Args:
        dynamics: the hydrodynamics of the vehicle, whose fins are on its root link.
        side: 1 if z of the base points down, -1 if it points up.

    Returns:
        The angle of each fin per rudder angle to starboard and per elevator angle bow up [1]; the
        moments of both per angle and dynamic pressure [m3/rad]; the limit of the rudder [rad].
    """
    moments = np.array([fin_moments(fin, side) for fin in dynamics.fins]).reshape(-1, 2)
    weights = np.zeros_like(moments)
    sums = [0.0, 0.0]
    for axis in range(2):
        greatest_moment = float(np.abs(moments[:, axis]).max(initial=0.0))
        if greatest_moment > MIN_SHARE * float(np.abs(moments).max(initial=0.0)):
            weights[:, axis] = moments[:, axis] / greatest_moment
            weights[np.abs(weights[:, axis]) < MIN_SHARE, axis] = 0.0
            sums[axis] = float((weights[:, axis] * moments[:, axis]).sum())
    limits = [
        min(-fin.limits[0], fin.limits[1])
        for fin, weight in zip(dynamics.fins, weights[:, 0], strict=True)
        if weight
    ]
    limit = min([math.radians(HARD_OVER), *limits])
    return weights[:, 0].tolist(), weights[:, 1].tolist(), (sums[0], sums[1]), limit


def fin_moments(fin: FinSpec, side: float) -> tuple[float, float]:
    """Return the moments to starboard and bow up, per angle and dynamic pressure [m3/rad]."""
    axis, chord = (np.array(v) / math.sqrt(sum(x * x for x in v)) for v in (fin.axis, fin.chord))
    normal = np.cross(axis, chord)
    moment = fin.area * fin.slope * np.cross(np.array(fin.position), normal)
    return side * float(moment[2]), side * float(moment[1])


def find_yaw_moment(allocation: Allocation, surge_force: float) -> float:
    """Return the greatest yaw moment to either side beside a surge force [N m].

    Raises:
        BadSetting: the thrusters cannot turn the vehicle.
    """
    if YAW not in allocation.axes:
        raise BadSetting("Neither fins nor thrusters can turn the vehicle.")
    base = surge_force * allocation.inverse_allocation_matrix[:, allocation.axes.index(SURGE)]
    column = allocation.inverse_allocation_matrix[:, allocation.axes.index(YAW)]
    moments = []
    for thrusts in (column, -column):
        for k in np.flatnonzero(np.abs(thrusts) > 1e-9).tolist():
            end = allocation.max_thrusts[k] if thrusts[k] > 0.0 else allocation.min_thrusts[k]
            moments.append(float((end - base[k]) / thrusts[k]))
    return max(min(moments), 0.0)


def join_numbers(numbers: list[float]) -> str:
    """Return numbers as text, separated by blanks."""
    return " ".join(f"{number:.9g}" for number in numbers)
