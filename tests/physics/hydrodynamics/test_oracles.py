"""Closed forms: what a textbook says a body in water does."""

from __future__ import annotations

import math

import mujoco
import numpy as np
import pytest

from tests.physics.water_models import FAR_BELOW, free_body, set_options
from uwsim.physics.hydrodynamics import prepare
from uwsim.physics.hydrodynamics.hydrodynamics import install
from uwsim.scene.hydrodynamics import BodyHydrodynamics

G = 9.81
SPHERE = 4 / 3 * math.pi * 0.1**3  # volume, radius 0.1 m [m3]
SPHERE_DRAG = 0.5 * 0.5 * 1000.0 * math.pi * 0.1**2  # Cd 0.5 [N s2/m2]


def sphere(mass: float, *, timestep: float = 0.002) -> mujoco.MjModel:
    added = 0.5 * 1000.0 * SPHERE
    water = BodyHydrodynamics(
        link="body",
        added_mass=(added, added, added, 0, 0, 0),
        quadratic_damping=(0, 0, SPHERE_DRAG, 0, 0, 0),
        volume=SPHERE,
    )
    return free_body(water, mass=mass, timestep=timestep, inertia=(0.02, 0.02, 0.02))


def test_a_massless_bubble_starts_upwards_with_2_g() -> None:
    model = sphere(1e-6)
    install(model)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    assert data.qacc[2] == pytest.approx(2 * G, rel=1e-5)


def test_a_falling_sphere_follows_the_hyperbolic_tangent() -> None:
    model = sphere(5.0)
    water, data = install(model), mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    assert data.qacc[2] == pytest.approx(-1.12173, abs=1e-5)
    water.step(data, 150)
    assert data.qvel[2] == pytest.approx(-0.32452, rel=1e-3)
    water.step(data, 350)
    assert data.qpos[2] == pytest.approx(-0.472851, rel=2e-3)
    water.step(data, 10_000)
    assert data.qvel[2] == pytest.approx(-1.00660, rel=1e-5)


def test_a_light_sphere_rises_to_its_terminal_speed() -> None:
    model = sphere(2.0)
    water, data = install(model), mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    assert data.qacc[2] == pytest.approx(5.24425, abs=1e-5)
    water.step(data, 10_000)
    assert data.qvel[2] == pytest.approx(1.65345, rel=1e-5)


@pytest.mark.parametrize(("density", "ratio"), [(7850.0, 1.1041), (2700.0, 1.3720), (1500.0, 2.0)])
def test_a_pendulum_swings_slower_in_water(density: float, ratio: float) -> None:
    """T_water / T_vacuum = sqrt((rho_s + rho/2) / (rho_s - rho)): a bob on a massless rod."""
    mass, added, length = density * SPHERE, 0.5 * 1000.0 * SPHERE, 1.0
    spec = mujoco.MjSpec()
    set_options(spec, timestep=0.001, integrator="RK4")
    bob = spec.worldbody.add_body(name="bob", mass=mass, ipos=[0, 0, -length])
    bob.inertia = [1e-9, 1e-9, 1e-9]
    bob.explicitinertial = True
    bob.add_joint(type=mujoco.mjtJoint.mjJNT_HINGE, axis=[0, 1, 0])
    # the added mass of the bob, moved to the origin of its body, which is the pivot
    moved = np.diag([added, added, added, 0.0, 0.0, 0.0])
    lever = np.array([0.0, 0.0, -length])
    skew = np.array([[0, -lever[2], lever[1]], [lever[2], 0, -lever[0]], [-lever[1], lever[0], 0]])
    moved[:3, 3:], moved[3:, :3] = -added * skew, added * skew
    moved[3:, 3:] = -added * skew @ skew
    water = BodyHydrodynamics(
        link="bob",
        added_mass=tuple(moved.ravel()),
        volume=SPHERE,
        centre_of_buoyancy=(0.0, 0.0, -length),
    )
    prepare(spec, {"bob": water}, surface=FAR_BELOW)
    model = spec.compile()
    hydrodynamics, data = install(model), mujoco.MjData(model)
    data.qpos[0] = 0.01
    crossings: list[float] = []
    last = data.qpos[0]
    while len(crossings) < 3:
        hydrodynamics.step(data)
        if last > 0 >= data.qpos[0] or last < 0 <= data.qpos[0]:
            share = last / (last - data.qpos[0])
            crossings.append(data.time - 0.001 * (1 - share))
        last = float(data.qpos[0])
    period = crossings[2] - crossings[0]
    vacuum = 2 * math.pi * math.sqrt(length / G) * (2 / math.pi) * ellipk(0.01)
    assert period / vacuum == pytest.approx(ratio, rel=1e-4)


def ellipk(angle: float) -> float:
    """Complete elliptic integral of the first kind at sin(angle/2), by the AGM."""
    a, b = 1.0, math.cos(angle / 2)
    while abs(a - b) > 1e-15:
        a, b = (a + b) / 2, math.sqrt(a * b)
    return math.pi / (2 * a)


def test_a_metacentric_pendulum_rocks_at_its_frequency() -> None:
    mass, inertia, added, arm = 100.0, 8.0, 4.0, 0.05
    water = BodyHydrodynamics(
        link="body",
        added_mass=(0, 0, 0, added, added, added),
        volume=0.1,
        centre_of_buoyancy=(0, 0, arm),
    )
    model = free_body(water, mass=mass, inertia=(inertia,) * 3, integrator="RK4")
    hydrodynamics, data = install(model), mujoco.MjData(model)
    roll = 0.01
    data.qpos[3:] = math.cos(roll / 2), math.sin(roll / 2), 0, 0
    period = 2 * math.pi / math.sqrt(mass * G * arm / (inertia + added))
    hydrodynamics.step(data, round(period / 0.002))
    assert 2 * math.asin(data.qpos[4]) == pytest.approx(roll, rel=1e-3)
    assert abs(data.qvel[3]) < 0.01 * roll


def test_a_passive_body_ends_up_moving_with_the_current() -> None:
    water = BodyHydrodynamics(
        link="body",
        added_mass=(20, 60, 60, 1, 2, 2),
        linear_damping=(10, 20, 20, 5, 5, 5),
        quadratic_damping=(50, 90, 90, 5, 5, 5),
        volume=0.1,
        centre_of_buoyancy=(0, 0, 0.05),
    )
    model = free_body(water, mass=100.0, inertia=(8, 8, 8))
    hydrodynamics, data = install(model), mujoco.MjData(model)
    hydrodynamics.set_current(data, (0.3, -0.2, 0.1))
    hydrodynamics.step(data, 100_000)
    assert data.qvel[:3] == pytest.approx([0.3, -0.2, 0.1], abs=1e-5)
    assert data.qvel[3:] == pytest.approx([0, 0, 0], abs=1e-5)


def test_a_neutral_body_goes_along_with_water_that_accelerates() -> None:
    water = BodyHydrodynamics(link="body", added_mass=(20, 60, 40, 0, 0, 0), volume=0.1)
    model = free_body(water, mass=100.0)
    hydrodynamics, data = install(model), mujoco.MjData(model)
    hydrodynamics.set_current(data, (0, 0, 0), (0.3, -0.1, 0.2))
    mujoco.mj_forward(model, data)
    assert data.qacc[:3] == pytest.approx([0.3, -0.1, 0.2], rel=1e-12)


def test_a_slender_body_at_incidence_feels_the_munk_moment() -> None:
    water = BodyHydrodynamics(link="body", added_mass=(10, 90, 90, 0, 4, 4), volume=0.1)
    model = free_body(water, mass=100.0, inertia=(1, 8, 8), integrator="RK4")
    install(model)
    data = mujoco.MjData(model)
    u, v = 1.2, 0.3
    data.qvel[:2] = u, v
    mujoco.mj_forward(model, data)
    # N = (Y_vdot - X_udot) u v with the derivatives -90 and -10: it turns the body broadside
    assert data.qacc[5] * (8 + 4) == pytest.approx((-90 + 10) * u * v, rel=1e-12)


def test_added_mass_does_no_work_by_turning() -> None:
    """nu^T C(nu) nu = 0: power into a free body is the rate of its energy, for any twist."""
    rng = np.random.default_rng(1)
    root = rng.normal(size=(6, 6))
    added = root @ root.T
    model = free_body(
        BodyHydrodynamics(link="body", added_mass=tuple(added.ravel())), mass=3.0, gravity=0.0,
        inertia=(1.0, 1.0, 1.0), integrator="RK4",
    )  # fmt: skip
    install(model)
    data = mujoco.MjData(model)
    data.qvel[:] = rng.normal(size=6)
    mujoco.mj_forward(model, data)
    full = added + np.diag([3.0, 3, 3, 1, 1, 1])
    # body axes are world axes here: nu_dot = (R^T v)' = a - omega x v
    rate = data.qacc - np.concatenate([np.cross(data.qvel[3:], data.qvel[:3]), np.zeros(3)])
    assert data.qvel @ full @ rate == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("shape", ["cylinder", "box"])
def test_a_floating_cylinder_heaves_at_its_frequency(shape: str) -> None:
    """w^2 = rho g A / (m + m_a): upright, half under water, small heave."""
    radius, height = 0.2, 0.6
    area = math.pi * radius**2 if shape == "cylinder" else (2 * radius) ** 2
    volume = area * height
    mass, added = 1000.0 * volume / 2, 30.0
    water = BodyHydrodynamics(
        link="body",
        added_mass=(0, 0, 2 * added, 0, 0, 0),  # of the whole; half of it is under water
        volume=volume,
        shape=shape,  # type: ignore[arg-type]  # one of the two
        size=(radius, height) if shape == "cylinder" else (2 * radius, 2 * radius, height),
    )
    model = free_body(
        water, mass=mass, centre_of_mass=(0, 0, -0.2), surface=0.0, timestep=0.001,
        integrator="RK4",
    )  # fmt: skip
    hydrodynamics, data = install(model), mujoco.MjData(model)
    data.qpos[2] = 1e-4
    omega = math.sqrt(1000.0 * G * area / (mass + added))
    heights = []
    for _ in range(round(4 * 2 * math.pi / omega / 0.001)):
        hydrodynamics.step(data)
        heights.append(float(data.qpos[2]))
    found = np.array(heights) * 1e4
    times = 0.001 * np.arange(1, len(found) + 1)
    assert np.abs(found - np.cos(omega * times)).max() < 0.002


def test_a_box_that_leans_rights_itself_with_its_metacentric_height() -> None:
    """Moment = rho g V GM sin(roll), GM = KB + I/V - KG, for a small roll."""
    length, breadth, height, draught, roll = 1.0, 0.6, 0.3, 0.12, 0.002
    volume = length * breadth * height
    mass = 1000.0 * length * breadth * draught
    water = BodyHydrodynamics(
        link="body", volume=volume, shape="box", size=(length, breadth, height)
    )
    model = free_body(water, mass=mass, inertia=(5, 5, 5), surface=0.0)
    install(model)
    data = mujoco.MjData(model)
    data.qpos[2] = height / 2 - draught
    data.qpos[3:] = math.cos(roll / 2), math.sin(roll / 2), 0, 0
    mujoco.mj_forward(model, data)
    metacentric = draught / 2 + breadth**2 / (12 * draught) - height / 2
    assert data.qacc[3] * 5 == pytest.approx(-mass * G * metacentric * roll, rel=1e-4)


def test_out_of_the_water_there_is_only_weight() -> None:
    model = sphere(5.0)
    model.body_user[0, 1] = -50.0
    install(model)
    data = mujoco.MjData(model)
    data.qvel[:] = 1, 2, 3, 1, 1, 1
    mujoco.mj_forward(model, data)
    assert data.qacc == pytest.approx([0, 0, -G, 0, 0, 0], abs=1e-12)


def test_a_wave_that_lifts_the_surface_wets_a_body() -> None:
    model = sphere(5.0)
    model.body_user[0, 1] = -1.0
    water, data = install(model), mujoco.MjData(model)
    water.water(data)[:, 6] = 2.0
    mujoco.mj_forward(model, data)
    assert data.qacc[2] == pytest.approx(-1.12173, abs=1e-5)
