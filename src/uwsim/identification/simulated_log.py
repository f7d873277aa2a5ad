"""A log that the full simulation makes: for trials of identification, and for tests.

The vehicle receives random steps along all axes, each by the thrusters that drive it, and steps of
all fins. The measured motion has the noise of a good outfit: a DVL, an attitude reference, a
gyroscope and an acoustic or optical position.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..base.geometry import Array, quaternion_from_rotation
from ..base.rng import stream
from ..logs import CommandSeries, MotionSeries, VehicleLog
from ..logs.frames import multiply_quaternions, rotate_vectors, rotate_vectors_back
from ..logs.vehicle_log import CommandKind
from ..physics.hydrodynamics import columns as c
from ..physics.hydrodynamics.kernel.free_rows import simulate_rows
from ..physics.hydrodynamics.kernel.free_step import ACTUATORS
from ..scene.spec import SceneSpec
from .parameters import AXES
from .vehicle_model import VehicleModel, open_vehicle

MAX_FIN_SHARE = 0.3
"""The greatest angle of fins, as a share of their limits."""
FREE_STEP = 0.005
"""The step of a vehicle alone in deep water [s]."""


@dataclass(frozen=True, kw_only=True)
class LogNoise:
    """The standard deviations of the measured motion."""

    position: float = 0.005
    """The standard deviation of positions [m]."""
    attitude: float = 0.0035
    """The standard deviation of the attitude about each axis [rad]."""
    velocity: float = 0.003
    """The standard deviation of the velocity over ground [m/s]."""
    angular_velocity: float = 0.00175
    """The standard deviation of the angular velocity [rad/s]."""


@dataclass(frozen=True, kw_only=True)
class Excitation:
    """The commands of a simulated log."""

    duration: float = 120.0
    """The length [s]."""
    amplitudes: tuple[float, ...] = (0.4, 0.4, 0.35, 0.012, 0.012, 0.06)
    """The greatest commands along surge, sway, heave, roll, pitch and yaw [1]."""
    heave_offset: float = 0.0
    """The command along heave that is added to all, against a free weight [1]."""
    min_hold: float = 0.8
    """The shortest time for which a command holds [s]."""
    max_hold: float = 3.0
    """The longest time for which a command holds [s]."""


def simulate_log(
    scene: SceneSpec,
    *,
    seed: int = 0,
    excitation: Excitation | None = None,
    noise: LogNoise | None = None,
    rate: float = 10.0,
    name: str = "simulated",
) -> VehicleLog:
    """Simulate a vehicle with the full engine, and return its log.

    Args:
        scene: a scene with one vehicle with dynamics.
        seed: the seed of commands and noise.
        excitation: the commands; None: the usual ones.
        noise: the noise of the motion; None: the usual one.
        rate: the rate of the measured motion [Hz].
        name: the name of the log, as its path.
    """
    from ..physics.compile_scene import compile_scene
    from ..simulation import Simulation

    excitation, noise = excitation or Excitation(), noise or LogNoise()
    vehicle = open_vehicle(scene)
    times, commands = draw_commands(vehicle, excitation, seed)
    is_thruster = np.array([row[c.ROLE] == c.PROPELLER for row in vehicle.numbers.actuators])
    with Simulation(compile_scene(scene, seed=seed)) as simulation:
        body = simulation.world.vehicles.find(vehicle.name)
        samples, next_command, next_sample = [], 0, 0
        while next_sample / rate <= excitation.duration + 1e-9:
            while next_command < len(times) and simulation.time >= times[next_command] - 1e-9:
                assert body.autopilot is not None
                body.autopilot.set_thrusters(commands[next_command, is_thruster])
                if not is_thruster.all():
                    body.turn_fins(commands[next_command, ~is_thruster])
                next_command += 1
            if simulation.time >= next_sample / rate - 1e-9:
                pose, twist = simulation.pose(vehicle.name), simulation.velocity(vehicle.name)
                samples.append((simulation.time, pose.position, pose.quaternion, twist))
                next_sample += 1
            simulation.advance()
    return _make_log(vehicle, times, commands, _add_noise(samples, noise, seed), name)


def _make_log(
    vehicle: VehicleModel, times: Array, commands: Array, motion: MotionSeries, name: str
) -> VehicleLog:
    is_thruster = np.array([row[c.ROLE] == c.PROPELLER for row in vehicle.numbers.actuators])
    names = np.array(vehicle.actuators)
    kinds: tuple[tuple[CommandKind, Array], ...] = (
        ("thrusters", is_thruster),
        ("fins", ~is_thruster),
    )
    series = [
        CommandSeries(
            kind=kind, names=tuple(names[mask].tolist()), times=times, values=commands[:, mask]
        )
        for kind, mask in kinds
        if mask.any()
    ]
    return VehicleLog(
        path=name, format="csv", sha256="", vehicle=vehicle.name, motion=motion,
        commands=tuple(series),
    )  # fmt: skip


def simulate_free_log(
    vehicle: VehicleModel,
    *,
    seed: int = 0,
    excitation: Excitation | None = None,
    noise: LogNoise | None = None,
    rate: float = 10.0,
    name: str = "simulated",
) -> VehicleLog:
    """Simulate a vehicle in deep water by the steps of a fit, and return its log.

    It takes a hundredth of the time of `simulate_log`, and differs from it by 0.1 mm over 10 s. The
    vehicle starts level and at rest at the origin of L.

    Args:
        vehicle: the vehicle with its true coefficients.
        seed: the seed of commands and noise.
        excitation: the commands; None: the usual ones.
        noise: the noise of the motion; None: the usual one.
        rate: the rate of the measured motion [Hz].
        name: the name of the log, as its path.
    """
    excitation, noise = excitation or Excitation(), noise or LogNoise()
    times, commands = draw_commands(vehicle, excitation, seed)
    n_steps = round(excitation.duration / FREE_STEP)
    command_rows = np.searchsorted(times, FREE_STEP * (np.arange(n_steps) + 0.5), side="right") - 1
    pose = vehicle.world_from_localized
    states = np.zeros((1, ACTUATORS + len(vehicle.actuators)))
    states[0, :3] = pose.position
    states[0, 3:7] = quaternion_from_rotation(pose.rotation)
    path = np.empty((1, n_steps + 1, ACTUATORS))
    water = np.zeros(c.WATER_COLUMNS)
    simulate_rows(vehicle.numbers, states, commands[command_rows][None], water, FREE_STEP, path)
    indices = np.rint(np.arange(int(excitation.duration * rate) + 1) / (rate * FREE_STEP))
    rows = path[0, np.minimum(indices.astype(np.int64), n_steps)]
    inverse = pose.inverse()
    to_localized = np.tile(quaternion_from_rotation(inverse.rotation), (len(rows), 1))
    samples = zip(
        (indices * FREE_STEP).tolist(),
        rotate_vectors(to_localized, rows[:, :3]) + inverse.position,
        multiply_quaternions(to_localized, rows[:, 3:7]),
        np.column_stack([rotate_vectors_back(rows[:, 3:7], rows[:, 7:10]), rows[:, 10:]]),
        strict=True,
    )
    return _make_log(vehicle, times, commands, _add_noise(list(samples), noise, seed), name)


def draw_commands(vehicle: VehicleModel, excitation: Excitation, seed: int) -> tuple[Array, Array]:
    """Return times (n,) [s], and the commands from then on, (n, actuators)."""
    mixing = _mix_axes(vehicle)  # (actuators, 6)
    generator = stream(seed, "identification/commands")
    edges: set[float] = {0.0}
    steps: list[list[tuple[float, float]]] = []
    for amplitude in excitation.amplitudes:
        time, axis_steps = 0.0, []
        while time < excitation.duration:
            axis_steps.append((time, amplitude * float(generator.uniform(-1.0, 1.0))))
            edges.add(time)
            hold = generator.uniform(excitation.min_hold, excitation.max_hold)
            time = round(time + float(hold), 1)
        steps.append(axis_steps)
    times = np.array(sorted(edges))
    along_axes = np.zeros((len(times), len(AXES)))
    for axis, axis_steps in enumerate(steps):
        starts = np.array([time for time, _ in axis_steps])
        rows = np.searchsorted(starts, times + 1e-9) - 1
        along_axes[:, axis] = np.array([value for _, value in axis_steps])[rows]
    along_axes[:, AXES.index("heave")] += excitation.heave_offset
    commands = (along_axes[:, None, :] * mixing).sum(axis=2)
    fins = np.array([row[c.ROLE] == c.FIN for row in vehicle.numbers.actuators])
    limits = np.where(fins[:, None], np.inf, vehicle.numbers.limits)
    limits[fins, 0] = -np.inf
    return times, np.clip(commands, limits[:, 0], limits[:, 1])


def _mix_axes(vehicle: VehicleModel) -> Array:
    """Return the share of each axis in the command of each actuator, (actuators, 6).

    A thruster takes part in an axis by the sign of its force or moment, if that is at least a tenth
    of the greatest one. Fins with a span along y turn for pitch, others for yaw.
    """
    numbers = vehicle.numbers
    wrenches = np.zeros((len(numbers.actuators), 6))
    for i, (row, site) in enumerate(zip(numbers.actuators, numbers.sites, strict=True)):
        axes = site[3:].reshape(3, 3)
        if row[c.ROLE] == c.PROPELLER:
            wrenches[i, :3] = axes[:, 0]
            wrenches[i, 3:] = np.cross(site[:3] - numbers.rigid_body[1:4], axes[:, 0])
    max_share = np.abs(wrenches).max(axis=0, initial=1e-9)
    shares: Array = np.sign(wrenches) * (np.abs(wrenches) >= 0.1 * np.maximum(max_share, 1e-6))
    for i, (row, site) in enumerate(zip(numbers.actuators, numbers.sites, strict=True)):
        if row[c.ROLE] == c.FIN:
            span = site[3:].reshape(3, 3)[:, 2]
            axis = 4 if abs(span[1]) > abs(span[2]) else 5
            sign = np.sign(span[1] if axis == 4 else span[2])
            shares[i, axis] = MAX_FIN_SHARE * row[c.MAX_ANGLE] * sign / 0.35
    return shares


def _add_noise(
    samples: list[tuple[float, Array, Array, Array]], noise: LogNoise, seed: int
) -> MotionSeries:
    generator = stream(seed, "identification/noise")
    n = len(samples)
    positions = np.array([position for _, position, _, _ in samples])
    quaternions = np.array([quaternion for _, _, quaternion, _ in samples])
    twists = np.array([twist for *_, twist in samples])
    turns = np.ones((n, 4))
    turns[:, 1:] = 0.5 * noise.attitude * generator.standard_normal((n, 3))
    turns /= np.sqrt((turns * turns).sum(axis=1, keepdims=True))
    scales = np.repeat([noise.velocity, noise.angular_velocity], 3)
    return MotionSeries(
        times=np.array([time for time, *_ in samples]),
        positions=positions + noise.position * generator.standard_normal((n, 3)),
        quaternions=multiply_quaternions(quaternions, turns),
        twists=twists + scales * generator.standard_normal((n, 6)),
    )
