"""Free bodies keep their energy, and their way: against scipy's DOP853 (`fossen.py`)."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise

import mujoco
import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tests.physics.fossen import Fossen, angle_between, rotation
from tests.physics.water_models import FAR_BELOW, ROBOTS, free_body, random_added_mass, set_options
from uwsim.physics.free_objects import box_added_mass, box_drag, ellipsoid_added_mass
from uwsim.physics.hydrodynamics import prepare
from uwsim.physics.hydrodynamics.hydrodynamics import Hydrodynamics, install
from uwsim.scene.hydrodynamics import BodyHydrodynamics, VehicleHydrodynamics
from uwsim.scene.hydrodynamics.spec import matrix
from uwsim.scene.hydrodynamics.vehicle_file import read_vehicle
from uwsim.scene.hydrodynamics.vehicle_sets import vehicle_sets
from uwsim.scene.urdf.reader import read_urdf

TAG = BodyHydrodynamics(  # a plate of steel, 10 x 10 x 0.2 cm
    link="body",
    added_mass=(3e-4, 3e-4, 0.6329, 3.249e-4, 3.249e-4, 0.0),
    quadratic_damping=(0.105, 0.105, 5.25, 1.64e-4, 1.64e-4, 6.56e-6),
    volume=2e-5,
    implicitness=1.0,
)
TAG_INERTIA = tuple(0.157 / 12.0 * np.array([0.010004, 0.010004, 0.02]))
TILTED = (0.0, 0.0, -5.0, math.cos(math.pi / 12), 0.0, math.sin(math.pi / 12), 0.0)
FALL = 1.6089  # in 3 s, by scipy's DOP853 [m]
ADDED = (4.0, 20.0, 30.0, 0.3, 0.02, 0.1)
TUMBLE = np.array([0.3, -0.2, 0.4, 2.0, 2.2, 1.1])


@pytest.fixture(autouse=True)
def leave_the_slot_alone() -> Iterator[None]:
    yield
    mujoco.set_mjcb_passive(None)


def fallen(timestep: float) -> tuple[float, float]:
    """How far a tag falls in 3 s [m], and the greatest of its speeds [m/s, rad/s]."""
    model = free_body(TAG, mass=0.157, inertia=TAG_INERTIA, timestep=timestep)
    water, data = install(model), mujoco.MjData(model)
    data.qpos[:] = TILTED
    fastest = 0.0
    for _ in range(round(3.0 / timestep)):
        water.step(data)
        fastest = max(fastest, float(np.abs(data.qvel).max()))
    return -5.0 - float(data.qpos[2]), fastest


def test_a_thin_tag_flutters_down_and_stays_calm() -> None:
    assert fallen(0.002)[0] == pytest.approx(FALL, rel=0.005)
    far, fastest = fallen(0.01)
    assert far == pytest.approx(FALL, rel=0.05)
    assert fastest < 30.0


@pytest.mark.slow
def test_dop853_says_how_far_the_tag_falls() -> None:
    oracle = Fossen(
        mass=0.157, inertia=np.diag(TAG_INERTIA), centre_of_mass=np.zeros(3),
        added=matrix(TAG.added_mass), quadratic=matrix(TAG.quadratic_damping), displaced=0.02,
    )  # fmt: skip
    start = np.array([*TILTED, *np.zeros(6)])
    found = solve_ivp(oracle.rate, (0, 3), start, method="DOP853", rtol=1e-9, atol=1e-10)
    assert -5.0 - found.y[2, -1] == pytest.approx(FALL, abs=1e-4)


ASKEW = np.array([0.9366, 0.281, 0.187, 0.0937]) / math.hypot(0.9366, 0.281, 0.187, 0.0937)
NEEDLE = (0.1, 0.001, 0.001)  # edges [m]
SUNK = (-0.0342, -0.0991, -5.7389)  # where a needle of 0.4 g is after 2 s, by DOP853 [m]


def loose(
    edges: tuple[float, ...], mass: float, timestep: float, theta: float = 1.0
) -> tuple[mujoco.MjModel, Fossen]:
    """A loose box of any proportions in water, and the oracle of it."""
    sizes = np.array(edges)
    added = ellipsoid_added_mass(0.5 * sizes * (6.0 / math.pi) ** (1.0 / 3.0))
    added[:3] = box_added_mass(sizes)
    water = BodyHydrodynamics(
        link="body",
        added_mass=tuple(1000.0 * added),
        quadratic_damping=tuple(1000.0 * box_drag(sizes)),
        volume=float(np.prod(sizes)),
        implicitness=theta,
    )
    squares = sizes**2
    inertia = mass / 12.0 * (squares.sum() - squares)
    oracle = Fossen(
        mass=mass, inertia=np.diag(inertia), centre_of_mass=np.zeros(3),
        added=matrix(water.added_mass), quadratic=matrix(water.quadratic_damping),
        displaced=1000.0 * water.volume,
    )  # fmt: skip
    return free_body(water, mass=mass, inertia=tuple(inertia), timestep=timestep), oracle


def sunk(
    model: mujoco.MjModel, seconds: float, twist: tuple[float, ...] = (0.0,) * 6,
    current: tuple[float, float, float] = (0.0, 0.0, 0.0),
) -> tuple[np.ndarray, float]:  # fmt: skip
    """Where a body of 5 m depth is after a time, and its greatest spin [rad/s]."""
    water, data = install(model), mujoco.MjData(model)
    data.qpos[2], data.qpos[3:], data.qvel[:] = -5.0, ASKEW, twist
    water.set_current(data, current)
    fastest = 0.0
    for _ in range(round(seconds / model.opt.timestep)):
        water.step(data)
        fastest = max(fastest, float(np.abs(data.qvel[3:]).max()))
    return data.qpos[:3].copy(), fastest


@pytest.mark.parametrize(("timestep", "tolerance"), [(0.002, 0.005), (0.01, 0.025)])
def test_a_needle_that_sinks_does_not_spin_about_its_axis(
    timestep: float, tolerance: float
) -> None:
    model, _ = loose(NEEDLE, 4e-4, timestep)
    water, data = install(model), mujoco.MjData(model)
    data.qpos[2], data.qpos[3:] = -5.0, ASKEW
    for _ in range(round(2.0 / timestep)):
        water.step(data)
        assert abs(data.qvel[3]) < 1e-6
    assert np.abs(data.qpos[:3] - SUNK).max() < tolerance


@pytest.mark.slow
@pytest.mark.parametrize(
    ("edges", "mass"),
    [(NEEDLE, 4e-4), (NEEDLE, 1.05e-4), ((0.1, 0.1, 0.002), 0.0205), ((0.2, 0.1, 0.001), 0.03),
     ((0.5, 0.001, 0.001), 2e-3)],
    ids=["needle", "light needle", "plate", "foil", "wire"],
)  # fmt: skip
@pytest.mark.parametrize(
    ("twist", "current"),
    [((0.0,) * 6, (0.0, 0.0, 0.0)), ((0.2, 0.1, 0, 2, 3, -2), (0.5, 0.2, 0.0))],
    ids=["still", "current"],
)
def test_thin_bodies_go_where_dop853_says(
    edges: tuple[float, ...], mass: float, twist: tuple[float, ...],
    current: tuple[float, float, float],
) -> None:  # fmt: skip
    """With implicit drag at the middle of a step the error is of second order."""
    ends = []
    for timestep in (0.001, 0.002, 0.005, 0.01):
        model, oracle = loose(edges, mass, timestep, theta=0.5)
        ends.append(sunk(model, 1.0, twist, current)[0])
    oracle.current = lambda _: np.array(current)
    own = rotation(ASKEW).T @ np.array(twist[:3])
    start = np.array([0, 0, -5.0, *ASKEW, *own, *twist[3:]])
    found = solve_ivp(oracle.rate, (0, 1), start, method="DOP853", rtol=1e-8, atol=1e-10)
    errors = [float(np.abs(end - found.y[:3, -1]).max()) for end in ends]
    assert errors[1] < 2e-4
    assert [b / a for a, b in pairwise(errors)] == pytest.approx([4.0, 6.25, 4.0], rel=0.1)


@pytest.mark.parametrize("timestep", [0.005, 0.01])
def test_a_flat_wire_that_flutters_gains_no_energy_from_long_steps(timestep: float) -> None:
    """It flutters at 160 rad/s, too fast for such steps: Newton's method found no end."""
    model, _ = loose((0.5, 0.002, 0.001), 4e-3, timestep)
    place, fastest = sunk(model, 2.0)
    assert np.linalg.norm(place - (0.0, 0.0, -5.0)) < 3.0
    assert fastest < 1000.0


def tumbled(timestep: float) -> tuple[float, mujoco.MjData]:
    """Relative change of the energy of a neutral box without drag in 10 s, and its state."""
    water = BodyHydrodynamics(link="body", added_mass=ADDED, volume=0.0142)
    inertia = (0.08, 0.15, 0.19)
    model = free_body(water, mass=14.2, inertia=inertia, timestep=timestep)
    waters, data = install(model), mujoco.MjData(model)
    data.qvel[:] = TUMBLE
    waters.step(data, round(10.0 / timestep))
    whole = np.diag([14.2] * 3 + list(inertia)) + np.diag(ADDED)
    twist = data.qvel.copy()
    twist[:3] = rotation(data.qpos[3:]).T @ twist[:3]
    return float(twist @ whole @ twist / (TUMBLE @ whole @ TUMBLE)) - 1.0, data


def test_a_tumbling_box_keeps_its_energy_at_10_ms() -> None:
    assert abs(tumbled(0.01)[0]) < 1e-9


@pytest.mark.slow
def test_a_tumbling_box_is_where_dop853_says() -> None:
    oracle = Fossen(
        mass=14.2, inertia=np.diag([0.08, 0.15, 0.19]), centre_of_mass=np.zeros(3),
        added=np.diag(ADDED), displaced=14.2,
    )  # fmt: skip
    start = np.array([0.0, 0, 0, 1, 0, 0, 0, *TUMBLE])
    found = solve_ivp(oracle.rate, (0, 10), start, method="DOP853", rtol=1e-9, atol=1e-9).y[:, -1]
    _, data = tumbled(0.002)
    assert np.abs(data.qpos[:3] - found[:3]).max() < 5e-4
    assert math.degrees(angle_between(data.qpos[3:], found[3:7] / math.hypot(*found[3:7]))) < 0.1


def test_a_body_with_a_fixed_part_and_full_added_mass_keeps_its_energy_in_a_current() -> None:
    """Energy relative to the water, which carries it along."""
    spec = mujoco.MjSpec()
    set_options(spec, timestep=0.01, gravity=0.0)
    node = spec.worldbody.add_body(name="body", mass=5.0, ipos=[0.1, 0, -0.05], inertia=[1, 2, 2.5])
    node.explicitinertial = True
    node.add_freejoint()
    part = node.add_body(name="part", pos=[0.3, 0.1, 0], mass=2.0, ipos=[0, 0.1, 0])
    part.inertia, part.explicitinertial = [0.1, 0.1, 0.1], True
    added = random_added_mass(np.random.default_rng(3), 6.0)
    waters = {
        "body": BodyHydrodynamics(link="body", added_mass=added, reference=(0.0, 0.05, 0.0)),
        "part": BodyHydrodynamics(link="part", added_mass=(1.0, 2.0, 3.0, 0.0, 0.0, 0.0)),
    }
    prepare(spec, waters, surface=FAR_BELOW)
    model = spec.compile()
    water, data = install(model), mujoco.MjData(model)
    water.set_current(data, (0.3, -0.2, 0.1))
    data.qvel[:] = 0.5, 0.1, -0.3, 1.0, -1.5, 0.8
    energies = [energy(water, data)]
    for _ in range(4):
        water.step(data, 100)
        energies.append(energy(water, data))
    assert energies == pytest.approx([energies[0]] * 5, rel=1e-9)


def energy(water: Hydrodynamics, data: mujoco.MjData) -> float:
    """Of body and water, seen from the water [J]."""
    other = mujoco.MjData(water.model)
    other.qpos[:], other.qvel[:] = data.qpos, data.qvel
    other.qvel[:3] -= water.water(data)[1, :3]
    mujoco.mj_forward(water.model, other)
    full = np.empty((6, 6))
    mujoco.mj_fullM(water.model, other, full)
    return float(0.5 * other.qvel @ full @ other.qvel)


LAG, HOLD, SECONDS = 0.15, 0.2, 10.0  # [s]


def driven(name: str) -> tuple[mujoco.MjModel, VehicleHydrodynamics, Fossen, np.ndarray]:
    """A bundled vehicle alone: its model, its numbers, the oracle, and its thrusters' wrenches."""
    robot = read_urdf(ROBOTS[name])
    vehicle = read_vehicle(vehicle_sets()[name], [link.name for link in robot.links])
    body = vehicle.bodies[0]
    spec = mujoco.MjSpec()
    set_options(spec)
    spec.worldbody.add_body(name=robot.root).add_freejoint()
    lagging = [replace(one, time_constant=LAG) for one in vehicle.thrusters]
    prepare(
        spec, {robot.root: body}, {one.name: (robot.root, one) for one in lagging},
        surface=FAR_BELOW, density=vehicle.density,
    )  # fmt: skip
    xx, yy, zz, xy, xz, yz = body.inertia or (0.0,) * 6
    oracle = Fossen(
        mass=body.mass or 0.0,
        inertia=np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]),
        centre_of_mass=np.array(body.centre_of_mass),
        added=matrix(body.added_mass),
        linear=matrix(body.linear_damping),
        quadratic=matrix(body.quadratic_damping),
        displaced=vehicle.density * body.volume,
        centre_of_buoyancy=np.array(body.centre_of_buoyancy),
    )
    rows = [
        np.concatenate([one.direction, np.cross(one.position, one.direction)])
        / np.linalg.norm(one.direction)
        + one.torque * np.concatenate([np.zeros(3), one.direction])
        for one in vehicle.thrusters
    ]
    return spec.compile(), vehicle, oracle, np.array(rows)


def thrust(vehicle: VehicleHydrodynamics, rotors: np.ndarray) -> np.ndarray:
    forces = []
    for one, x in zip(vehicle.thrusters, rotors, strict=True):
        terms = one.forward if x > 0 or one.backward is None else one.backward
        force = sum(c * max(abs(x) - one.dead_zone, 0.0) ** (i + 1) for i, c in enumerate(terms))
        force *= 1.0 if x > 0 else -1.0
        forces.append(float(np.clip(force, *(one.saturation or (-math.inf, math.inf)))))
    return np.array(forces)


def commands(n: int, number: int) -> np.ndarray:
    return np.asarray(0.35 * np.sin((0.3 + 0.1 * np.arange(n)) * HOLD * number + np.arange(n)))


@pytest.mark.slow
@pytest.mark.parametrize(("name", "up"), [("bluerov2_heavy", 0.0), ("rexrov", 1.0)])
def test_a_driven_vehicle_goes_where_dop853_says_and_gains_nothing(name: str, up: float) -> None:
    model, vehicle, oracle, rows = driven(name)
    n = len(rows)
    water, data = install(model), mujoco.MjData(model)
    data.qpos[3:] = up, 1.0 - up, 0.0, 0.0
    state = np.concatenate([data.qpos, data.qvel, np.zeros(n)])

    def rate(_: float, y: np.ndarray) -> np.ndarray:
        wrench = thrust(vehicle, y[13:]) @ rows
        oracle.wrench = lambda _: wrench
        return np.concatenate([oracle.rate(0.0, y[:13]), (aim - y[13:]) / LAG])

    def power() -> np.ndarray:
        axes = rotation(data.qpos[3:])
        nu = np.concatenate([axes.T @ data.qvel[:3], data.qvel[3:]])
        drag = (oracle.linear @ nu + oracle.quadratic @ (np.abs(nu) * nu)) @ nu
        heights = (
            data.qpos[2] + axes[2] @ np.array([oracle.centre_of_mass, oracle.centre_of_buoyancy]).T
        )
        still = 9.81 * (oracle.mass * heights[0] - oracle.displaced * heights[1])
        moving = 0.5 * nu @ (oracle.rigid + oracle.added) @ nu
        return np.array([thrust(vehicle, data.act) @ rows @ nu, drag, moving + still])

    before, began = power(), power()[2]
    work = lost = 0.0
    for number in range(round(SECONDS / HOLD)):
        aim = commands(n, number)
        state = solve_ivp(rate, (0, HOLD), state, method="DOP853", rtol=1e-9, atol=1e-9).y[:, -1]
        water.set_thrusters(data, aim)
        for _ in range(round(HOLD / 0.002)):
            water.step(data)
            after = power()
            work, lost = work + 0.001 * (before + after)[0], lost + 0.001 * (before + after)[1]
            before = after
    assert np.abs(data.qpos[:3] - state[:3]).max() < 5e-5
    assert abs(before[2] - began - work + lost) < 1e-4 * work
