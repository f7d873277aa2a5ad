"""Draw the noise of an IMU and of a GPS against their specification, as in docs/sensors.md.

    python examples/sensor_noise_figures.py docs/images/sensor-noise.png       1 min

The IMU is at rest for ten hours. The figures show the Allan deviations of its three axes, the curve
of its specification with a 95 % interval, and the terms of this curve. Then a vehicle with a GPS
moves along a square of 40 m, and dives on two of the sides.
"""

from __future__ import annotations

import argparse
from dataclasses import replace
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes

import uwsim
from uwsim.analysis.plots import PALETTE, save_plot, styled_figure
from uwsim.assets.bundled import bundled_files
from uwsim.base.geodesy import Geodetic
from uwsim.messages import NavSatFix, Twist, TwistStamped, Vector3, header, seconds
from uwsim.scene.reader import read_scene
from uwsim.sensors.drift import DriftSpec
from uwsim.sensors.gps_sensor import GpsSensorSpec
from uwsim.sensors.imu import ImuSpec
from uwsim.topics.ros_twist_to_pat import ROSTwistToPATSpec
from uwsim.topics.sensor_topic import GPSSensorToROSSpec

NAME = "g500"
RATE, N_SAMPLES = 10.0, 360_000
GYRO = DriftSpec(noise_density=8.7e-5, bias_instability=1.5e-5, random_walk=3e-7)
ACCELEROMETER = DriftSpec(noise_density=6e-4, bias_instability=2e-4, random_walk=6e-6)
STD = 0.5
SIDES = ((0.0, 0.0), (0.1, -0.1), (0.0, 0.0), (0.1, -0.1))
"""The heave in the first and second half of each side of the square, downwards [m/s]."""
SURGE, SIDE, TURN = 1.0, 40.0, 5.0
"""The speed [m/s], the length of a side [m], the duration of a turn [s]."""
TRUTH = {"color": "0.6", "lw": 2.0}


def sample_imu() -> tuple[np.ndarray, np.ndarray]:
    """Return angular rates and specific forces of an IMU at rest, (n, 3) each."""
    imu = ImuSpec(name="imu", relative_to="base_link", gyro=GYRO, accelerometer=ACCELEROMETER)
    scene = read_scene(bundled_files("scenes")["survey-scene"])
    vehicle = replace(scene.vehicles[0], parts=(imu,), dynamics=None)
    scene = replace(scene, vehicles=(vehicle,), ros_interfaces=())
    rates, forces = np.empty((2, N_SAMPLES, 3))
    with uwsim.load(scene, seed=1, is_blind=True) as simulation:
        sensor = simulation.world.sensors.sensor("imu", ("imu",))
        for sample_index in range(N_SAMPLES):
            message = sensor.sample((sample_index + 1) / RATE)
            rate, force = message.angular_velocity, message.linear_acceleration
            rates[sample_index], forces[sample_index] = (
                (rate.x, rate.y, rate.z),
                (force.x, force.y, force.z),
            )
    return rates, forces


def allan_deviation(series: np.ndarray, m: int) -> np.ndarray:
    """Compute the overlapping Allan deviation of columns (n, k) over m samples.

    Source: IEEE Std 952, C.1.
    """
    sums = np.cumsum(series - series.mean(axis=0), axis=0)
    means = (sums[m:] - sums[:-m]) / m
    return np.sqrt(0.5 * np.mean((means[m:] - means[:-m]) ** 2, axis=0))


def noise_terms(spec: DriftSpec, tau: np.ndarray) -> dict[str, np.ndarray]:
    """Compute the Allan deviation of each error term of the specification."""
    s, t = spec.bias_std, spec.correlation_time
    decay = 3.0 - 4.0 * np.exp(-tau / t) + np.exp(-2.0 * tau / t)
    return {
        "noiseDensity": spec.noise_density / np.sqrt(tau),
        "biasInstability": s * np.sqrt(2.0 * t / tau * (1.0 - t / (2.0 * tau) * decay)),
        "randomWalk": spec.random_walk * np.sqrt(tau / 3.0),
    }


def draw_allan(axes: Axes, series: np.ndarray, spec: DriftSpec, label: str) -> None:
    numbers = np.unique(np.geomspace(1, N_SAMPLES // 6, 40).astype(int))
    tau = numbers / RATE
    terms = noise_terms(spec, tau)
    expected = np.sqrt(sum(term**2 for term in terms.values()))
    half_width = 1.96 / np.sqrt(2.0 * (N_SAMPLES / numbers - 1.0))  # IEEE Std 952, C.2
    axes.fill_between(
        tau, expected * (1 - half_width), expected * (1 + half_width), color="0.9", lw=0
    )
    for (name, term), style in zip(terms.items(), (":", "--", "-."), strict=True):
        axes.plot(tau, term, style, color="0.6", lw=1.0, label=name)
    axes.plot(tau, expected, color="0.4", lw=1.5, label="sum of the terms")
    deviations = np.array([allan_deviation(series, m) for m in numbers])
    for k, axis in enumerate("xyz"):
        axes.plot(tau, deviations[:, k], ".", ms=4.0, color=PALETTE[k], label=axis)
    axes.set(xscale="log", yscale="log", xlabel="averaging time [s]", ylabel=label)
    axes.set_ylim(0.3 * expected.min(), 2.0 * expected.max())
    axes.legend(fontsize=7, ncols=2)


def swim_square() -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Return times (n,) and positions (n, 3) of the antenna, and of GPS fixes, (m,) and (m, 2)."""
    antenna = (0.0, 0.0, -0.4)
    gps = GpsSensorSpec(name="gps", relative_to="base_link", position=antenna, std=STD)
    scene = read_scene(bundled_files("scenes")["survey-scene"])
    vehicle = replace(scene.vehicles[0], parts=(gps,), dynamics=None, position=(0.0, 0.0, 0.3))
    twist = ROSTwistToPATSpec(topic="/twist", vehicle_name=NAME)
    fixes = GPSSensorToROSSpec(name="gps", topic="/gps", rate=5)
    scene = replace(scene, vehicles=(vehicle,), ros_interfaces=(twist, fixes))
    times, positions = [], []
    with uwsim.load(scene, seed=1, is_blind=True) as simulation:
        simulation.advance(0.0)
        inbox = simulation.bus.inbox("/gps", NavSatFix)

        def swim(duration: float, surge: float, heave: float, yaw: float) -> None:
            for _ in range(round(duration / 0.2)):
                motion = Twist(linear=Vector3(x=surge, z=heave), angular=Vector3(z=yaw))
                stamp = header(simulation.time)
                simulation.publish("/twist", TwistStamped(header=stamp, twist=motion))
                simulation.advance(0.2)
                body = simulation.world.bodies.find(f"{NAME}/base_link").world_from_body
                times.append(simulation.time)
                positions.append(body.transform(np.array([antenna]))[0])

        for down, up in SIDES:
            swim(0.5 * SIDE / SURGE, SURGE, down, 0.0)
            swim(0.5 * SIDE / SURGE, SURGE, up, 0.0)
            swim(TURN, 0.0, 0.0, 0.5 * np.pi / TURN)
        origin = scene.earth_origin or Geodetic(latitude=0.0, longitude=0.0)
        return np.array(times), np.array(positions), *local_positions(inbox.take(), origin)


def local_positions(fixes: list[NavSatFix], origin: Geodetic) -> tuple[np.ndarray, np.ndarray]:
    """Return times (n,), and positions east and north of the origin (n, 2); NaN without a fix."""
    positions = []
    for fix in fixes:
        latitude, longitude = np.radians([fix.latitude, fix.longitude]).tolist()
        position = Geodetic(latitude=latitude, longitude=longitude, altitude=fix.altitude)
        north, east, _ = origin.north_east_down(position)
        positions.append((east, north))
    return np.array([seconds(fix.header.stamp) for fix in fixes]), np.array(positions)


def draw_track(axes: Axes, positions: np.ndarray, fixes: np.ndarray) -> None:
    axes.plot(positions[:, 0], positions[:, 1], **TRUTH)
    axes.plot(*fixes.T, ".", ms=2.0, color=PALETTE[0])
    axes.set_aspect("equal")
    axes.set(xlabel="gpsSensor: east [m]", ylabel="north [m]")


def draw_errors(
    axes: Axes, times: np.ndarray, positions: np.ndarray, fix_times: np.ndarray, fixes: np.ndarray
) -> None:
    for k, name in enumerate(("east", "north")):
        error = fixes[:, k] - np.interp(fix_times, times, positions[:, k])
        label = f"{name}, deviation {np.nanstd(error):.2f} m"
        axes.plot(fix_times, error, ".", ms=2.0, color=PALETTE[k], label=label)
    for sign in (-1, 1):
        axes.axhline(sign * 1.96 * STD, **{**TRUTH, "lw": 1.0})
    axes.plot(times, positions[:, 2], color="0.3", lw=1.0, label="height of the antenna")
    axes.set(xlabel="time [s]", ylabel="gpsSensor: error [m]", ylim=(None, 2.6))
    axes.legend(fontsize=7)


def main() -> None:
    parser = argparse.ArgumentParser(description="Draw the noise of an IMU and of a GPS.")
    parser.add_argument("file", type=Path)
    options = parser.parse_args()
    rates, forces = sample_imu()
    times, positions, fix_times, fixes = swim_square()
    with styled_figure((9.0, 7.0)) as figure:
        axes = figure.subplots(2, 2)
        draw_allan(axes[0, 0], rates, GYRO, "imu, gyro: Allan deviation [rad/s]")
        label = "imu, accelerometer: Allan deviation [m/s$^2$]"
        draw_allan(axes[0, 1], forces, ACCELEROMETER, label)
        draw_track(axes[1, 0], positions, fixes)
        draw_errors(axes[1, 1], times, positions, fix_times, fixes)
        save_plot(figure, options.file)


if __name__ == "__main__":
    main()
