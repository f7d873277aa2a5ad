r"""The experiments of a towing tank: tow, coast-down, bollard pull, free decay.

*Tow.* The vehicle is pulled along a rail by constant forces until its speed is steady. The forces
over the speeds give linear and quadratic damping. They contain the drag of fins and links.

*Coast-down.* The vehicle is released on the rail at a speed. The impulse of the drag that the tow
found, over the loss of speed, is the mass with added mass:
:math:`m = \int (d_1 v + d_2 v^2) \, dt \, / \, (v_0 - v_1)`.

*Bollard pull.* The vehicle is fixed; its thrusters push ahead together, by commands from -1 to 1.

*Free decay.* The vehicle is trimmed to neutral buoyancy, as in a tank. It is released at rest with
a list or trim of 10° and swings about its metacentre, free in all directions. In the closed form,
sway and surge follow roll and pitch. With the matrix M of mass and added mass, and the stiffness
:math:`K = z_G W - z_B B` about the origin of the base, :math:`\omega^2 = K (M^{-1})_{kk}`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..base.geometry import Array, Pose
from ..base.numerics.linear import inverse
from ..benchmark.metrics.manoeuvres import Decay, Resistance, fit_decay, fit_resistance
from ..messages import Vector3, Wrench, WrenchStamped, header
from ..physics.actuation.allocation import allocate, thrusters_on_base
from ..scene.hydrodynamics.spec import matrix
from .experiment import TOPICS, Experiment, trim_vehicle
from .rail import Rail
from .steering import SURGE, compute_mass, damping, steady_speed

AXES = ("surge", "sway", "heave", "roll", "pitch", "yaw")
TOWED_AXES = (0, 1, 2, 5)
"""The indices of the axes of tows."""
SPEED_SHARES = (0.15, 0.3, 0.5, 0.7, 0.85, 1.0)
"""The speeds of tows, as shares of the vehicle's speed or of U / L [1]."""
COMMANDS = tuple(k / 10.0 for k in range(-10, 11))
"""The commands of the bollard pull [1]."""
RELEASE_ANGLE = math.radians(10.0)
"""The list or trim at which a vehicle is released [rad]."""
DECAY_TIME = 40.0
"""The duration of the record of a decay [s]."""
DECAY_SAMPLE = 0.02
"""The time between two samples of a decay [s]."""
N_COAST = 400


@dataclass(frozen=True, eq=False, kw_only=True)
class Tow:
    """Tows and a coast-down along one axis."""

    axis: int
    """The index of the axis."""
    resistance: Resistance
    """The resistance that was found."""
    file_damping: tuple[float, float]
    """The linear and quadratic damping of the bodies in the hydrodynamics file."""
    mass: float
    """The mass with added mass that the coast-down found [kg or kg m2]."""
    file_mass: float
    """The mass with added mass in the files [kg or kg m2]."""


@dataclass(frozen=True, eq=False, kw_only=True)
class DecayRecord:
    """The free decay about one axis."""

    axis: int
    """The index of the axis: 3 roll, 4 pitch."""
    times: Array
    """The times, (n,) [s]."""
    angles: Array
    """The angles, (n,) [rad]."""
    decay: Decay | None
    """The period and damping that were found; None if the vehicle does not swing."""
    file_period: float | None
    """The period of the closed form [s]; None if the vehicle has several bodies with mass."""


@dataclass(frozen=True, eq=False, kw_only=True)
class TankResults:
    """The results of all experiments in the tank."""

    tows: tuple[Tow, ...]
    """The tows, by axis."""
    commands: Array
    """The commands of the bollard pull, (n,) [1]."""
    pulls: Array
    """The forces of the bollard pull ahead, (n,) [N]."""
    decays: tuple[DecayRecord, ...]
    """The free decays in roll and pitch."""


def run_tank(experiment: Experiment) -> TankResults:
    """Run all experiments of the tank."""
    commands, pulls = pull_bollard(experiment)
    trimmed_experiment = trim_vehicle(experiment)
    return TankResults(
        tows=tuple(tow(experiment, axis) for axis in TOWED_AXES),
        commands=commands,
        pulls=pulls,
        decays=tuple(release(trimmed_experiment, axis) for axis in (3, 4)),
    )


def tow(experiment: Experiment, axis: int) -> Tow:
    """Tow a vehicle along an axis at several forces, and let it coast."""
    dynamics = experiment.hydrodynamics
    linear, quadratic = damping(dynamics, axis)
    speed = design_speed(experiment) / (1.0 if axis < 3 else experiment.length)
    forces = [(linear + quadratic * v) * v or v for v in (s * speed for s in SPEED_SHARES)]
    rail = Rail(experiment.model, axis)
    speeds = np.array([rail.pull(force) for force in forces])
    resistance = fit_resistance(speeds, np.array(forces))
    file_mass = float(compute_mass(experiment.model)[axis])
    duration = file_mass / (resistance.linear + resistance.quadratic * speeds[-1])
    times = np.linspace(0.0, duration, N_COAST + 1)
    coast = Rail(experiment.model, axis)
    coast_speeds = coast.coast(float(speeds[-1]), _on_steps(times))
    drag = resistance.linear * coast_speeds + resistance.quadratic * coast_speeds**2
    steps = np.diff(_on_steps(times))
    impulse = float((0.5 * (drag[1:] + drag[:-1]) * steps).sum())
    return Tow(
        axis=axis,
        resistance=resistance,
        file_damping=(linear, quadratic),
        mass=impulse / float(coast_speeds[0] - coast_speeds[-1]),
        file_mass=file_mass,
    )


def _on_steps(times: Array) -> Array:
    """Return times, each at the end of a step, without repetitions."""
    return np.unique(np.round(times / 0.002)) * 0.002


def design_speed(experiment: Experiment) -> float:
    """Return the speed at which the approach's thrust equals the drag of the hull [m/s]."""
    linear, quadratic = damping(experiment.hydrodynamics, SURGE)
    return steady_speed(float(experiment.parameters["ahead"]), linear, quadratic)


def pull_bollard(experiment: Experiment) -> tuple[Array, Array]:
    """Return commands and the forces ahead of a vehicle that is fixed."""
    dynamics = experiment.hydrodynamics
    thrusters = thrusters_on_base(experiment.model.robots[0], dynamics.thrusters)
    allocation = allocate(thrusters, np.zeros(3))
    shares = allocation.inverse_allocation_matrix[:, allocation.axes.index(SURGE)]
    pattern = shares / float(np.abs(shares).max())
    settling = 0.2 + 12.0 * max(thruster.time_constant for thruster in dynamics.thrusters)
    rail = Rail(experiment.model, SURGE, is_fixed=True)
    pulls = [rail.measure_thrust(command * pattern, settling) for command in COMMANDS]
    return np.array(COMMANDS), np.array(pulls)


def release(experiment: Experiment, axis: int) -> DecayRecord:
    """Release a vehicle with a list (axis 3) or a trim (axis 4), and record its angle."""
    name = experiment.vehicle
    with experiment.open() as simulation:
        simulation.advance(0.0)
        pose = simulation.pose(name)
        zero = Vector3(x=0.0, y=0.0, z=0.0)
        zero_wrench = WrenchStamped(header=header(0.0), wrench=Wrench(force=zero, torque=zero))
        simulation.publish(TOPICS["wrench"], zero_wrench)
        simulation.advance(simulation.timestep * 2)
        angles = (RELEASE_ANGLE, 0.0, 0.0) if axis == 3 else (0.0, RELEASE_ANGLE, 0.0)
        tilted_pose = pose @ Pose.from_rpy((0.0, 0.0, 0.0), angles)
        simulation.set_pose(name, tilted_pose)
        simulation.publish(TOPICS["wrench"], zero_wrench)
        times, values = [], []
        begin = simulation.time
        while simulation.time < begin + DECAY_TIME:
            base = pose.inverse() @ simulation.pose(name)
            row = base.rotation[2]
            times.append(simulation.time - begin)
            values.append(math.atan2(row[1], row[2]) if axis == 3 else -math.asin(row[0]))
            simulation.advance(DECAY_SAMPLE)
    record, time_axis = np.array(values), np.array(times)
    return DecayRecord(
        axis=axis,
        times=time_axis,
        angles=record,
        decay=fit_decay(time_axis, record),
        file_period=expected_period(experiment, axis),
    )


def expected_period(experiment: Experiment, axis: int) -> float | None:
    """Return the period of the closed form [s]; None for a vehicle with several masses."""
    model, dynamics = experiment.model, experiment.hydrodynamics
    robot = model.robots[0]
    body = dynamics.body(robot.root)
    if (
        body is None
        or len(dynamics.bodies) > 1
        or any(link.mass > 0.0 for link in robot.links if link.name != robot.root)
    ):
        return None
    root = next(link for link in robot.links if link.name == robot.root)
    mass = root.mass if body.mass is None else body.mass
    centre = np.array(root.centre_of_mass if body.centre_of_mass is None else body.centre_of_mass)
    inertia = root.inertia if body.inertia is None else body.inertia
    total = rigid_body_matrix(mass, centre, inertia) + matrix(body.added_mass)
    side = 1.0 if model.scene.vehicles[0].localized_from_base.rotation[2, 2] > 0.0 else -1.0
    gravity = float(-model.engine_model.opt.gravity[2])
    buoyancy = dynamics.density * body.volume
    stiffness = (
        gravity * side * (mass * float(centre[2]) - buoyancy * float(body.centre_of_buoyancy[2]))
    )
    if stiffness <= 0.0 or any(body.reference):
        return None
    return 2.0 * math.pi / math.sqrt(stiffness * float(inverse(total)[axis, axis]))


def rigid_body_matrix(mass: float, centre: Array, inertia: tuple[float, ...]) -> Array:
    """Return the mass matrix of a rigid body about the origin of its frame, (6, 6).

    Args:
        mass: the mass [kg].
        centre: the centre of mass, (3,) [m].
        inertia: the inertia about the centre of mass: xx, yy, zz, xy, xz, yz [kg m2].
    """
    x, y, z = centre.tolist()
    lever = mass * np.array([[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]])
    xx, yy, zz, xy, xz, yz = inertia
    moments = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    offset = mass * ((x * x + y * y + z * z) * np.eye(3) - np.outer(centre, centre))
    return np.block([[mass * np.eye(3), lever], [lever.T, moments + offset]])
