"""The names of coefficients, and what their values change."""

from __future__ import annotations

import numpy as np
import pytest

from tests.identification.vehicles import bluerov2
from uwsim.errors import BadSetting
from uwsim.identification.parameters import apply_values, choose_parameters
from uwsim.physics.hydrodynamics import columns as c


def names(*free: str) -> list[str]:
    return [parameter.name for parameter in choose_parameters(free, bluerov2())]


def test_a_group_stands_for_its_coefficients_that_are_not_zero() -> None:
    assert names("linear_damping") == [f"linear_damping[{k}]" for k in ("surge", "heave", "pitch")]
    assert len(names("added_mass")) == 6
    assert names("drag[surge]") == ["linear_damping[surge]", "quadratic_damping[surge]"]


def test_a_coefficient_of_zero_can_be_named() -> None:
    (sway,) = choose_parameters(["linear_damping[sway]"], bluerov2())
    assert sway.first_guess == 0.0
    assert sway.plausible_error > 0.0


def test_a_name_that_is_given_twice_counts_once() -> None:
    assert names("added_mass[surge]", "added_mass").count("added_mass[surge]") == 1


def test_every_wrong_name_is_reported_with_the_nearest() -> None:
    with pytest.raises(BadSetting) as error:
        names("aded_mass", "added_mass[surg]", "thrust[bow]", "mass[x")
    text = str(error.value)
    assert "Did you mean 'added_mass'?" in text
    assert "Did you mean 'surge'?" in text
    assert "thrust[bow]" in text
    assert "mass[x" in text


def test_all_thrusters_and_one_thruster_exclude_each_other() -> None:
    with pytest.raises(BadSetting, match="choose either"):
        names("thrust", "thrust[bow_port]")


def test_values_change_the_numbers_of_the_simulation_and_not_the_vehicle() -> None:
    model = bluerov2()
    free = (
        "added_mass[yaw]", "quadratic_damping[sway]", "mass", "inertia[pitch]", "buoyancy",
        "centre_of_buoyancy[z]", "thrust[bow_port]", "time_constant", "current[y]",
    )  # fmt: skip
    parameters = choose_parameters(free, model)
    numbers = apply_values(
        model, parameters, np.array([9.0, 8.0, 7.0, 6.0, 0.02, -0.05, 2.0, 0.3, 0.1])
    )
    body = numbers.vehicle.bodies[0]
    assert body[c.M_A + 35] == 9.0
    assert body[c.QUADRATIC + 7] == 8.0
    assert numbers.vehicle.rigid_body[0] == 7.0
    assert numbers.vehicle.rigid_body[5] == 6.0
    assert body[c.DISPLACED_MASS] == 20.0
    assert body[c.CENTRE + 2] == -0.05
    thrust = numbers.vehicle.actuators[:, c.FORWARD] / model.numbers.actuators[:, c.FORWARD]
    assert thrust.tolist() == [1.0, 2.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0]
    assert set(numbers.vehicle.actuators[:, c.LAG]) == {0.3}
    np.testing.assert_allclose(numbers.water[:3], [0.1, 0.0, 0.0], atol=1e-15)  # L.y is W.x
    assert model.numbers.rigid_body[0] == 13.5


def test_the_first_guess_changes_nothing() -> None:
    model = bluerov2()
    parameters = choose_parameters(["added_mass", "drag", "mass", "inertia", "thrust"], model)
    guesses = np.array([parameter.first_guess for parameter in parameters])
    vehicle = apply_values(model, parameters, guesses).vehicle
    for part, original in zip(vehicle[:-1], model.numbers[:-1], strict=True):
        assert part.tobytes() == original.tobytes()
