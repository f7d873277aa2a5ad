"""The bundled vehicles move as their numbers, and what was measured on them, say."""

from __future__ import annotations

import math

import mujoco
import numpy as np
import pytest

from tests.physics.water_models import bundled
from uwsim.physics.hydrodynamics.hydrodynamics import Hydrodynamics, install

THRUST = 153.7875  # of one thruster of the original's Girona 500 at full command [N]


def compat() -> tuple[mujoco.MjModel, Hydrodynamics, mujoco.MjData]:
    """The original's Girona 500 alone."""
    model, _ = bundled("uwsim_compat", only_base=True)
    return model, install(model), mujoco.MjData(model)


def on_rails(name: str, direction: tuple[float, ...], commands: dict[str, float]) -> float:
    """Speed after 60 s when a vehicle may only move along one line."""
    model, _ = bundled(
        name, only_base=True, z_down=name != "rexrov", rail=direction, gravity=9.82
    )  # fmt: skip
    water, data = install(model), mujoco.MjData(model)
    for thruster, command in commands.items():
        water.set_thruster(data, water.thruster(thruster), command)
    water.step(data, 30_000)
    return float(data.qvel[0])


def run_forward(seconds: float) -> float:
    _, water, data = compat()
    water.set_thrusters(data, [-1.0, -1.0, 0.0, 0.0, 0.0])
    water.step(data, round(seconds / 0.002))
    return float(data.qvel[0])


def test_the_original_g500_reaches_its_terminal_surge_speed() -> None:
    assert run_forward(30.0) == pytest.approx(math.sqrt(2 * THRUST / 148), rel=1e-4)
    assert run_forward(30.0) == pytest.approx(1.4416, abs=2e-4)


def test_the_original_g500_accelerates_as_a_hyperbolic_tangent() -> None:
    _, water, data = compat()
    water.set_thrusters(data, [-1.0, -1.0, 0.0, 0.0, 0.0])
    data.act[:2] = -1.0  # the rotors turn already
    water.step(data, 250)
    tau = 147 / math.sqrt(2 * THRUST * 148)
    assert tau == pytest.approx(0.689, abs=5e-4)
    assert data.qvel[0] == pytest.approx(1.4416 * math.tanh(0.5 / tau), rel=2e-3)


def test_the_original_g500_sways_at_its_terminal_speed() -> None:
    _, water, data = compat()
    water.set_thrusters(data, [0.0, 0.0, 0.0, 0.0, 1.0])
    water.step(data, 20_000)
    # to starboard, which with z down is -y of W
    assert data.qvel[1] == pytest.approx(-1.0194, abs=2e-4)


def test_the_original_g500_turns_at_its_limit() -> None:
    _, water, data = compat()
    water.set_thrusters(data, [-1.0, 1.0, 0.0, 0.0, 0.0])
    water.step(data, 10_000)
    assert data.qvel[5] == pytest.approx(0.5411, abs=2e-4)


def test_the_original_g500_coasts_by_the_logarithm() -> None:
    _, water, data = compat()
    data.qvel[0] = 1.0
    water.step(data, 2500)
    assert data.qvel[0] == pytest.approx(0.16573, rel=2e-3)
    assert data.qpos[0] == pytest.approx(1.78527, abs=1e-3)


@pytest.mark.parametrize(("speed", "force"), [(0.05, 0.37), (0.1, 1.48), (0.2, 5.92), (0.4, 23.68)])
def test_holding_the_original_g500_in_a_current_takes_its_drag(speed: float, force: float) -> None:
    model, water, data = compat()
    water.set_current(data, (speed, 0.0, 0.0))
    mujoco.mj_forward(model, data)
    assert data.qfrc_passive[0] == pytest.approx(force, abs=0.005)


def test_the_original_g500_never_rocks_visibly() -> None:
    """Its rotational drag makes roll overdamped (zeta 3.3): it creeps back without a swing."""
    _, water, data = compat()
    turn = np.empty(4)
    mujoco.mju_mulQuat(
        turn, np.array([0.0, 1, 0, 0]), np.array([math.cos(0.1), 0, math.sin(0.1), 0])
    )
    data.qpos[3:7] = turn
    pitches = []
    for _ in range(60):
        water.step(data, 250)
        axes = data.xmat[1].reshape(3, 3)
        pitches.append(-axes[2, 0])
    assert abs(pitches[0]) > 0.15
    assert (np.diff(np.abs(pitches)) <= 1e-12).all()
    assert abs(pitches[-1]) < 0.005


def test_bluerov2_heavys_top_surge_speed_is_the_measured_one() -> None:
    """von Benzon's set predicts 0.7338 m/s; the experiment gave 0.72."""
    horizontal = ("bow_starboard", "bow_port", "stern_starboard", "stern_port")
    speed = on_rails("bluerov2_heavy", (1.0, 0.0, 0.0), dict.fromkeys(horizontal, 1.0))
    assert speed == pytest.approx(0.7338, rel=1e-3)
    assert speed == pytest.approx(0.73, rel=0.02)


def test_bluerov2_heavy_sways_and_dives_as_von_benzons_numbers_say() -> None:
    sway = {"bow_starboard": -1.0, "bow_port": 1.0, "stern_starboard": 1.0, "stern_port": -1.0}
    assert on_rails("bluerov2_heavy", (0.0, 1.0, 0.0), sway) == pytest.approx(0.6295, rel=2e-3)
    dive = {f"down_{end}_{side}": 1.0 for end in ("bow", "stern") for side in ("starboard", "port")}
    # 4 * 30.4 N and 0.1 kg of weight in water
    heave = on_rails("bluerov2_heavy", (0.0, 0.0, 1.0), dive)
    root = (-33 + math.sqrt(33**2 + 4 * 190 * (4 * 30.4 + 0.1 * 9.82))) / 380
    assert heave == pytest.approx(root, rel=1e-3)
    assert heave == pytest.approx(0.7179, rel=5e-3)


def test_bluerov2_heavy_rolls_and_pitches_with_its_natural_periods() -> None:
    for axis, inertia, period in ((3, 0.26 + 0.189, 3.67), (4, 0.23 + 0.135, 3.31)):
        stiffness = 13.4 * 9.82 * 0.01
        assert 2 * math.pi / math.sqrt(stiffness / inertia) == pytest.approx(period, abs=0.02)
        model, _ = bundled("bluerov2_heavy", only_base=True, gravity=9.82)
        install(model)
        data = mujoco.MjData(model)
        small = np.zeros(3)
        small[axis - 3] = 0.001
        mujoco.mju_quatIntegrate(data.qpos[3:7], small, 1.0)
        mujoco.mj_forward(model, data)
        assert -data.qacc[axis] / 0.001 == pytest.approx(stiffness / inertia, rel=3e-3)


def test_rexrov_rises_at_the_speed_of_its_reserve_buoyancy() -> None:
    speed = on_rails("rexrov", (0.0, 0.0, 1.0), {})
    lift = (1.83826 * 1028 - 1862.87) * 9.82
    root = (-728.4 + math.sqrt(728.4**2 + 4 * 1821.01 * lift)) / (2 * 1821.01)
    assert speed == pytest.approx(root, rel=1e-3)


def test_rexrovs_vertical_thrusters_together_push_straight_up() -> None:
    model, vehicle = bundled("rexrov", z_down=False)
    model.opt.integrator = mujoco.mjtIntegrator.mjINT_RK4  # forces at the start of a step
    water, data = install(model), mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    still = data.qfrc_passive.copy()
    water.set_thrusters(data, [1.0] * 4 + [0.0] * 4)
    data.act[:] = data.ctrl
    mujoco.mj_forward(model, data)
    push = data.qfrc_passive - still
    assert push[2] == pytest.approx(4 * 2000 * math.sin(math.radians(74.53)), rel=1e-6)
    assert np.abs(np.delete(push, 2)).max() < 1e-3
    assert len(vehicle.thrusters) == 8


def test_the_physical_g500_floats_upright_and_nearly_level_with_its_arm_stowed() -> None:
    model, _ = bundled("g500_physical")
    water, data = install(model), mujoco.MjData(model)
    water.step(data, 30_000)
    axes = data.xmat[1].reshape(3, 3)
    assert axes[2, 2] < -0.999  # z of the vehicle points down
    assert abs(math.degrees(math.asin(axes[2, 0]))) < 2.0
    assert abs(math.degrees(math.asin(axes[2, 1]))) < 2.0
    # a kilogram of reserve buoyancy lets it rise slowly
    assert 0.02 < data.qvel[2] < 0.15


def test_the_physical_g500_makes_about_a_metre_a_second() -> None:
    commands = {"surge_port": 1.0, "surge_starboard": 1.0}
    speed = on_rails("g500_physical", (1.0, 0.0, 0.0), commands)
    assert speed == pytest.approx((-30 + math.sqrt(900 + 4 * 230 * 280)) / 460, rel=1e-3)
    assert 0.9 < speed < 1.1


def test_the_arm_weighs_in_water_what_its_maker_says() -> None:
    model, vehicle = bundled("g500_physical")
    arm = [body for body in vehicle.bodies if body.link != "base_link"]
    weight = sum((body.mass or 0.0) - 1000.0 * body.volume for body in arm)
    assert weight == pytest.approx(18.5)
    assert model.nbody > 8
