"""Water whose density changes with depth: where a float comes to rest, and how it swings there."""

from __future__ import annotations

import math

import mujoco
import numpy as np
import pytest

from tests.physics.water_models import set_options
from uwsim.physics.hydrodynamics import prepare
from uwsim.physics.hydrodynamics.hydrodynamics import Hydrodynamics, install
from uwsim.scene.hydrodynamics import BodyHydrodynamics, FinSpec

LEVELS = ((0.0, 1000.0), (10.0, 1010.0), (20.0, 1030.0))
VOLUME = 0.01


def float_in(
    levels: tuple[tuple[float, float], ...], *, mass: float, depth: float, **water: object
) -> tuple[Hydrodynamics, mujoco.MjData]:
    """A float that begins at rest."""
    spec = mujoco.MjSpec()
    set_options(spec)
    body = spec.worldbody.add_body(name="body", mass=mass, inertia=[0.1] * 3, pos=[0, 0, -depth])
    body.explicitinertial = True
    body.add_freejoint()
    given = BodyHydrodynamics(link="body", volume=VOLUME, **water)
    fin = FinSpec(name="fin", link="body", area=0.02, lift_slope=3.0)
    prepare(spec, {"body": given}, None, {"fin": ("body", fin)}, levels=levels)
    model = spec.compile()
    return install(model), mujoco.MjData(model)


def test_a_float_settles_where_the_water_has_its_density() -> None:
    drag = (0.0, 0.0, 2.5, 0.0, 0.0, 0.0)
    water, data = float_in(LEVELS, mass=1020.0 * VOLUME, depth=11.0, linear_damping=drag)
    water.step(data, 60_000)
    assert data.qpos[2] == pytest.approx(-15.0, abs=0.001)


@pytest.mark.parametrize("added", [0.0, 5.0])
def test_a_float_swings_with_the_brunt_vaisala_frequency(added: float) -> None:
    mass, gradient = 1020.0 * VOLUME, 2.0  # [kg], [kg/m4]
    water, data = float_in(LEVELS, mass=mass, depth=15.1, added_mass=(0, 0, added, 0, 0, 0))
    # with the inertia of the water that it moves, which is that of 1000 kg/m3 times 1.02
    frequency = math.sqrt(9.81 * VOLUME * gradient / (mass + 1.02 * added))
    if added == 0.0:
        assert frequency == pytest.approx(math.sqrt(9.81 * gradient / 1020.0))
    places = []
    for _ in range(round(2.0 * math.pi / frequency / 0.1)):
        water.step(data, 50)
        places.append(data.qpos[2] + 15.0)
    times = 0.1 * np.arange(1, len(places) + 1)
    assert np.array(places) == pytest.approx(-0.1 * np.cos(frequency * times), abs=2e-4)


def test_drag_and_added_mass_are_those_of_the_water_there() -> None:
    drag = (0.0, 0.0, 20.0, 0.0, 0.0, 0.0)
    forces, inertias = [], []
    for depth in (0.5, 30.0):
        water, data = float_in(
            LEVELS, mass=10.0, depth=depth, quadratic_damping=drag, added_mass=(5.0,) * 6
        )
        data.qvel[2] = -1.0
        mujoco.mj_forward(water.model, data)
        matrix = np.empty((6, 6))
        mujoco.mj_fullM(water.model, data, matrix)
        data.qvel[2] = 0.0
        moving = data.qfrc_passive[2]
        mujoco.mj_forward(water.model, data)
        forces.append(moving - data.qfrc_passive[2])
        inertias.append(matrix[3, 3] - 0.1)
    assert forces[1] / forces[0] == pytest.approx(1.03 / 1.0005, rel=1e-3)
    assert inertias[1] / inertias[0] == pytest.approx(1.03 / 1.0005, rel=1e-9)


def test_levels_of_one_density_are_uniform_water_to_the_bit() -> None:
    states = []
    for levels in ((), ((0.0, 1000.0), (50.0, 1000.0))):
        water, data = float_in(levels, mass=9.9, depth=5.0, added_mass=(5.0,) * 6)
        data.qvel[:] = 0.5, 0.1, 0.2, 0.3, 0.1, 0.2
        water.step(data, 100)
        states.append(data.qpos.tobytes())
    assert states[0] == states[1]
