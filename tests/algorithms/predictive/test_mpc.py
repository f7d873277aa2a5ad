"""The plan of mpc is held against a bounded least-squares solver, its observer against the drag."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.optimize import lsq_linear

from tests.algorithms.fake_node import FakeNode
from uwsim.algorithms.predictive import DobMpc, Mpc
from uwsim.algorithms.predictive.planner import N_STEPS, STEP, AxisModel, Planner
from uwsim.base.geometry import Array
from uwsim.errors import BadSetting

MODEL = AxisModel(
    mass=np.array([20.0, 21.0, 32.0]),
    linear=np.array([14.0, 0.0, 33.0]),
    quadratic=np.array([141.0, 217.0, 190.0]),
    limit=np.array([15.0, 60.0, 120.0]),
)
RHO, SIGMA = 0.02, 0.03


def solve_independently(axis: int, error: float, velocity: float, reference: float) -> Array:
    """Return the bounded plan of an axis as a least-squares problem of simulated pulses."""
    mass, linear, quadratic = (
        float(numbers[axis]) for numbers in (MODEL.mass, MODEL.linear, MODEL.quadratic)
    )

    def errors_of(forces: Array) -> Array:
        e, v, errors = error, velocity, []
        for force in forces:
            drag = (linear + 2.0 * quadratic * abs(velocity)) * v
            drag -= quadratic * abs(velocity) * velocity
            v += STEP * (force - drag) / mass
            e += STEP * (reference - v)
            errors.append(e)
        return np.array(errors)

    free_errors = errors_of(np.zeros(N_STEPS))
    effect = np.stack([errors_of(pulse) - free_errors for pulse in np.eye(N_STEPS)], axis=1)
    change = np.eye(N_STEPS) - np.eye(N_STEPS, k=-1)
    rows = np.vstack([effect, RHO / mass * np.eye(N_STEPS), SIGMA / mass * change])
    limit = float(MODEL.limit[axis])
    solution = lsq_linear(
        rows, np.concatenate([-free_errors, np.zeros(2 * N_STEPS)]), (-limit, limit)
    )
    return np.asarray(solution.x)


def test_the_plan_is_that_of_an_independent_solver() -> None:
    error, velocity, reference = (
        np.array(numbers) for numbers in ((0.3, -0.1, 0.05), (0.1, 0.2, -0.1), (0.15, 0.0, 0.0))
    )
    planner = Planner(MODEL, force_weight=RHO, change_weight=SIGMA)
    _, response = planner._predict(error, velocity, reference, np.zeros(3))
    free_errors, _ = planner._predict(error, velocity, reference, np.zeros(3))
    hessian, gradient = planner._condense(free_errors, response)
    for _ in range(20):  # each from the last plan, not shifted
        planner._plan = np.concatenate([planner._plan[:, :1], planner._plan[:, :-1]], axis=1)
        planner._plan = planner._minimise(hessian, gradient)
    cost = [
        0.5 * plan @ matrix @ plan + slope @ plan
        for plan, matrix, slope in zip(planner._plan, hessian, gradient, strict=True)
    ]
    for axis in range(3):
        plan = solve_independently(axis, error[axis], velocity[axis], reference[axis])
        expected = 0.5 * plan @ hessian[axis] @ plan + gradient[axis] @ plan
        assert cost[axis] == pytest.approx(expected, rel=1e-3)
    assert np.abs(planner._plan[0]).max() == 15.0  # at its limit


def test_the_force_is_that_of_the_drag_at_the_speed_of_the_place() -> None:
    planner = Planner(MODEL, force_weight=1e-4, change_weight=1e-4)
    velocity = np.array([0.15, -0.1, 0.1])
    for _ in range(40):
        force = planner.improve(np.zeros(3), velocity, velocity, np.zeros(3))
    drag = (MODEL.linear + MODEL.quadratic * np.abs(velocity)) * velocity
    np.testing.assert_allclose(force, drag, rtol=0.02)


def test_the_observer_finds_a_constant_force() -> None:
    controller, force, velocity = DobMpc(), np.array([5.0, -3.0, 2.0]), np.zeros(3)
    controller.start(FakeNode())
    for _ in range(100):
        controller._observe(velocity, 0.05)
        controller._velocity, controller._force = velocity, np.zeros(3)
        velocity = velocity + 0.05 * controller._model.acceleration(velocity, force)
    np.testing.assert_allclose(controller._disturbance, force, rtol=1e-6)


def test_the_torque_is_that_of_a_critically_damped_pendulum() -> None:
    controller = Mpc()
    controller.start(FakeNode(parameters={"attitude_rate": 2.0, "inertia": "1 1 1"}))
    roll, pitch = 0.1, -0.2
    down = [-math.sin(pitch), math.sin(roll) * math.cos(pitch), math.cos(roll) * math.cos(pitch)]
    parts = {
        "gravity": np.array(down),
        "heading": np.array([1.0, 0.0]),
        "angularVelocity": np.array([0.0, 0.0, 0.3]),
    }
    np.testing.assert_allclose(controller._torque(parts), [-4 * roll, -4 * pitch, -4 * 0.3])
    parts["heading"] = np.array([math.cos(0.4), math.sin(0.4)])
    np.testing.assert_allclose(controller._torque(parts)[2], -4 * 0.4 - 4 * 0.3)


@pytest.mark.parametrize("text", ["1 2", "1 2 x", "1 -2 3"])
def test_a_vector_is_three_numbers(text: str) -> None:
    with pytest.raises(BadSetting, match=r"algorithm\.mass is '.*'; expected three numbers"):
        Mpc.check_parameters({"mass": text})
