"""Commands beyond the limits of a thruster that lags behind them."""

from __future__ import annotations

import math
from dataclasses import replace

import mujoco
import pytest

from tests.physics.water_models import free_body
from uwsim.physics.hydrodynamics.hydrodynamics import Hydrodynamics, install
from uwsim.scene.hydrodynamics import BodyHydrodynamics, ThrusterSpec

LAG = 0.2
SCREW = ThrusterSpec(name="screw", link="body", forward=(0.0, 100.0), time_constant=LAG)


def in_water(thruster: ThrusterSpec, integrator: str) -> Hydrodynamics:
    water = BodyHydrodynamics(link="body", quadratic_damping=(90.0, *[0.0] * 35))
    return install(
        free_body(
            water, mass=40.0, thrusters={"screw": thruster}, gravity=0.0, integrator=integrator
        )
    )


@pytest.mark.parametrize("integrator", ["implicitfast", "RK4"])
@pytest.mark.parametrize("limits", [(-1.0, 1.0), (-0.4, 0.7)], ids=["symmetric", "asymmetric"])
@pytest.mark.parametrize("sign", [1.0, -1.0], ids=["forward", "backward"])
def test_a_command_beyond_its_limit_is_its_limit_to_the_bit(
    integrator: str, limits: tuple[float, float], sign: float
) -> None:
    screw = replace(SCREW, limits=limits)
    ends = []
    for beyond in (1.0, 1.5, 1500.0, 1e9, math.inf):
        water = in_water(screw, integrator)
        data = mujoco.MjData(water.model)
        water.set_thrusters(data, [beyond * (limits[1] if sign > 0.0 else limits[0])])
        water.step(data, 20)
        ends.append((data.qpos.tobytes(), data.qvel.tobytes(), data.act.tobytes()))
    assert len(set(ends)) == 1


def test_a_command_far_beyond_its_limit_does_not_shorten_the_lag() -> None:
    water = in_water(SCREW, "implicitfast")
    data = mujoco.MjData(water.model)
    water.set_thrusters(data, [1500.0])
    mujoco.mj_forward(water.model, data)
    rotor = 1.0 - math.exp(-0.001 / LAG)  # in the middle of the step
    assert data.qfrc_passive[0] == pytest.approx(100.0 * rotor**2, rel=1e-9)
