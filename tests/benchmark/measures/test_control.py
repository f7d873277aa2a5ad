"""Control: commands of every type, errors of bodies and topics, and what is refused."""

from __future__ import annotations

import math

import numpy as np
import pytest

from tests.support.fakes import FakeBody, FakeWorld
from uwsim.base.geometry import Pose, rotation_z
from uwsim.benchmark.measures.control import Control, ControlSpec
from uwsim.errors import BadSetting, UnknownName
from uwsim.messages import (
    Float64,
    Float64MultiArray,
    JointState,
    MultiArrayLayout,
    String,
    Twist,
    TwistStamped,
    Vector3,
    Wrench,
    WrenchStamped,
    floats,
    header,
)

DT = 0.01


def vector(x: float, y: float, z: float) -> Vector3:
    return Vector3(x=x, y=y, z=z)


def twist(vx: float, vy: float = 0.0, wz: float = 0.0) -> Twist:
    return Twist(linear=vector(vx, vy, 0.0), angular=vector(0.0, 0.0, wz))


def array(*values: float) -> Float64MultiArray:
    return Float64MultiArray(layout=MultiArrayLayout(dim=[], data_offset=0), data=np.array(values))


def joints(names: list[str], **given: list[float]) -> JointState:
    arrays = {kind: np.array(given.get(kind, [])) for kind in ("position", "velocity", "effort")}
    return JointState(header=header(0.0), name=names, **arrays)


def bound(world: FakeWorld, **given: object) -> Control:
    return ControlSpec(name="c", **given).bind(world)  # type: ignore[arg-type]


def go_on(control: Control, world: FakeWorld, steps: int = 1) -> None:
    for _ in range(steps):
        world.advance()
        control.update()


def send(control: Control, world: FakeWorld, message: object, steps: int = 1) -> None:
    """Publish a message and let it be in force for so many steps."""
    world.bus.publisher("u", type(message))(message)
    go_on(control, world, steps)


# -- commands ----------------------------------------------------------------------------------


def test_a_square_wave_varies_by_twice_its_amplitude_at_every_edge() -> None:
    world = FakeWorld(timestep=DT)
    control = bound(world, topic="u")
    control.start()
    for k in range(11):
        send(control, world, twist(0.3 if k % 2 == 0 else -0.3), 50)
    assert control.value == pytest.approx(10 * 0.6, abs=1e-9)
    details = control.details
    assert details["n"] == 11.0
    assert details["vx.variation"] == pytest.approx(6.0, abs=1e-9)
    assert details["vx.max"] == details["max"] == 0.3
    assert details["vx.effort"] == pytest.approx(0.09 * (11 * 50 - 1) * DT, abs=1e-9)
    assert details["vy.variation"] == details["vy.max"] == 0.0


def test_a_command_holds_until_the_next_however_rarely_they_come() -> None:
    world = FakeWorld(timestep=DT)
    control = bound(world, topic="u", quantity="effort")
    control.start()
    go_on(control, world, 100)
    assert control.value is None
    send(control, world, array(1.0, 2.0), 1 + 200)
    send(control, world, array(0.0, -1.0), 1 + 100)
    assert control.value == pytest.approx(5.0 * 2.01 + 1.0 * 1.0, abs=1e-9)
    assert control.details["u0.variation"] == 1.0
    assert control.details["u1.variation"] == 3.0
    assert control.details["max"] == 2.0
    assert control.unit == "s"


def test_a_sine_varies_by_four_amplitudes_a_period_and_has_half_its_square() -> None:
    world = FakeWorld(timestep=DT)
    control = bound(world, topic="u", axes="fz")
    control.start()
    for k in range(1001):
        force = 7.0 * math.sin(2 * math.pi * k / 400)  # 2.5 periods
        send(control, world, Wrench(force=vector(0.0, 0.0, force), torque=vector(9.0, 0.0, 0.0)))
    assert control.value == pytest.approx(2.5 * 4 * 7.0, abs=1e-9)
    assert control.details["effort"] == pytest.approx(0.5 * 49.0 * 10.0, abs=1e-9)
    assert control.details["max"] == pytest.approx(7.0)
    assert "tx.effort" not in control.details


@pytest.mark.parametrize(
    ("message", "axes", "unit"),
    [
        (twist(1.0), "vx vy vz wx wy wz", "m/s, rad/s"),
        (TwistStamped(header=header(0.0), twist=twist(1.0)), "vx vy vz wx wy wz", "m/s, rad/s"),
        (Wrench(force=vector(1.0, 0.0, 0.0), torque=vector(0.0, 0.0, 0.0)),
         "fx fy fz tx ty tz", "N, N m"),
        (WrenchStamped(header=header(0.0), wrench=Wrench(
            force=vector(1.0, 0.0, 0.0), torque=vector(0.0, 0.0, 0.0))),
         "fx fy fz tx ty tz", "N, N m"),
        (array(1.0, 0.0), "u0 u1", "1"),
        (joints(["slew", "elbow"], position=[1.0, 0.0]), "slew elbow", "rad or m"),
        (joints([], velocity=[1.0, 0.0]), "q0 q1", "rad/s or m/s"),
        (joints(["slew"], effort=[1.0]), "slew", "N m or N"),
    ],
)  # fmt: skip
def test_every_type_of_command_has_its_axes_and_units(
    message: object, axes: str, unit: str
) -> None:
    world = FakeWorld(timestep=DT)
    control = bound(world, topic="u", quantity="max")
    control.start()
    send(control, world, message)
    named = [name.removesuffix(".max") for name in control.details if name.endswith(".max")]
    assert named == axes.split()
    assert (control.value, control.unit) == (1.0, unit)
    assert control.detail_units["variation"] == unit


def test_units_of_what_is_squared_and_integrated_are_reported() -> None:
    world = FakeWorld(timestep=DT)
    world.bus.publisher("u", Twist)
    units = bound(world, topic="u", axes="vx vy").detail_units
    assert units["effort"] == units["vx.effort"] == "(m/s)^2 s"
    world.bus.publisher("v", Wrench)
    units = bound(world, topic="v").detail_units
    assert units["effort"] == "N^2 s, (N m)^2 s"
    assert units["n"] == "1"


def test_joints_that_a_message_does_not_name_keep_their_command() -> None:
    world = FakeWorld(timestep=DT)
    control = bound(world, topic="u")
    control.start()
    send(control, world, joints(["slew", "elbow"], position=[1.0, 2.0]), 101)
    send(control, world, joints(["elbow"], position=[0.5]), 101)
    assert control.details["slew.effort"] == pytest.approx(2.01, abs=1e-9)
    assert control.details["elbow.variation"] == 1.5


def test_what_is_in_force_when_it_goes_on_counts_as_effort_and_not_as_a_change() -> None:
    world = FakeWorld(timestep=DT)
    control = bound(world, topic="u")
    publish = world.bus.publisher("u", Twist)
    for vx in (0.7, 0.2):
        publish(twist(vx))
        world.advance()
    control.start()
    go_on(control, world, 100)
    assert control.value == 0.0
    assert control.details["effort"] == pytest.approx(0.04, abs=1e-9)
    assert control.details["max"] == 0.2
    assert control.details["n"] == 0.0
    send(control, world, twist(0.5))
    assert control.value == pytest.approx(0.3)


def test_the_next_level_knows_the_command_in_force() -> None:
    world = FakeWorld(timestep=DT)
    first = bound(world, topic="u")
    first.start()
    send(first, world, twist(0.5))
    first.close()
    second = bound(world, topic="u")
    second.start()
    send(second, world, twist(0.1))
    assert second.value == pytest.approx(0.4)


def test_commands_while_it_is_off_do_not_count() -> None:
    world = FakeWorld(timestep=DT)
    control = bound(world, topic="u")
    control.start()
    send(control, world, twist(1.0), 101)
    publish = world.bus.publisher("u", Twist)
    for vx in (5.0, -5.0, 2.0):
        publish(twist(vx))
        world.advance(100)
    control.start()
    go_on(control, world, 100)
    assert control.value == 0.0
    assert control.details["effort"] == pytest.approx(1.0 + 4.0, abs=1e-9)
    assert control.details["max"] == 2.0


def test_what_is_not_finite_is_passed_over_with_a_note() -> None:
    world = FakeWorld(timestep=DT)
    control = bound(world, topic="u")
    control.start()
    for vx in (0.1, math.nan, math.inf, 0.2):
        send(control, world, twist(vx))
    assert control.value == pytest.approx(0.1)
    assert control.details["n"] == 2.0
    assert control.notes == ("messages were passed over: not finite, or not of the kind before",)


def test_positions_and_velocities_of_joints_are_not_mixed() -> None:
    world = FakeWorld(timestep=DT)
    control = bound(world, topic="u")
    control.start()
    send(control, world, joints(["slew"], position=[1.0]))
    send(control, world, joints(["slew"], velocity=[9.0]))
    assert (control.value, control.details["max"]) == (0.0, 1.0)
    assert control.notes != ()


def test_without_commands_there_is_no_value_and_its_details_are_known_by_the_type() -> None:
    world = FakeWorld(timestep=DT)
    world.bus.publisher("u", TwistStamped)
    control = bound(world, topic="u", axes="vx")
    assert (control.value, control.missing_reason) == (None, "it was never on")
    control.start()
    assert (control.value, control.missing_reason) == (None, "no command on 'u'")
    assert control.details == {
        "variation": None, "effort": None, "max": None,
        "vx.variation": None, "vx.effort": None, "vx.max": None, "n": 0.0,
    }  # fmt: skip
    assert control.unit == "m/s"


def test_an_axis_that_commands_do_not_have_is_named() -> None:
    world = FakeWorld(timestep=DT)
    world.bus.publisher("v", Twist)
    with pytest.raises(UnknownName, match="Did you mean 'vx'"):
        bound(world, topic="v", axes="vxx")
    control = bound(world, topic="u", axes="u7")
    control.start()
    send(control, world, array(1.0))
    assert control.missing_reason == "the commands on 'u' have no axis u7"
    half = bound(world, topic="u", axes="u0 u7")
    half.start()
    send(half, world, array(1.0))
    assert half.value == 0.0
    assert half.notes == ("no command had the axis u7",)


def test_a_topic_of_another_type_is_refused_as_soon_as_it_is_known() -> None:
    world = FakeWorld(timestep=DT)
    early = bound(world, topic="u")
    early.start()
    send(early, world, String(data="forward"))
    said = "'u' carries std_msgs/msg/String; expected one of Float64MultiArray, JointState, Twist"
    assert early.missing_reason is not None
    assert early.missing_reason.startswith(said)
    with pytest.raises(BadSetting, match="carries std_msgs/msg/String; expected one of Float64Mul"):
        bound(world, topic="u")
    with pytest.raises(BadSetting, match="expected one of Float32MultiArray, Float64, Float64Mul"):
        bound(world, error_topic="u")


# -- errors ------------------------------------------------------------------------------------


def test_a_body_steps_to_its_set_point_in_the_frame_of_files() -> None:
    body = FakeBody()
    shift = Pose(np.array([0.0, 0.0, 1.0]), rotation_z(math.pi / 2))  # W = (-L.y, L.x, 1 + L.z)
    world = FakeWorld({"v": body}, timestep=DT, world_from_localized=shift)
    control = bound(world, target="v", position=(3.0, 1.0, -2.0), quantity="settlingTime")
    body.move(-1.0, 1.0, -1.0)  # L (1, 1, -2)
    control.start()
    for k in range(1, 1001):
        body.move(-1.0, 3.0 - 2.0 * math.exp(-k * DT / 0.5), -1.0)
        go_on(control, world)
    assert control.value == pytest.approx(0.5 * math.log(50.0), abs=DT)
    assert control.unit == "s"
    details = control.details
    assert details["step"] == pytest.approx(2.0)
    assert details["rise_time"] == pytest.approx(0.5 * math.log(9.0), abs=DT)
    assert details["iae"] == pytest.approx(1.0, abs=1e-4)
    assert details["overshoot"] == pytest.approx(0.0, abs=1e-9)
    assert details["steady_state_error"] == pytest.approx(0.0, abs=1e-6)
    assert control.detail_units["ise"] == "m^2 s"
    assert control.log_header == ("error [m]", "iae")
    assert control.log_values == (pytest.approx(0.0, abs=1e-6), pytest.approx(1.0, abs=1e-4))


def test_an_error_that_comes_in_messages_holds_and_its_time_counts_from_the_first() -> None:
    world = FakeWorld(timestep=DT)
    control = bound(world, error_topic="u", quantity="itae")
    control.start()
    go_on(control, world, 77)
    assert (control.value, control.missing_reason) == (None, "no error on 'u'")
    send(control, world, Float64(data=2.0), 101)
    send(control, world, Float64(data=-0.5), 100)
    assert control.details["iae"] == pytest.approx(2.0 * 1.01 + 0.5 * 0.99, abs=1e-9)
    assert control.details["ise"] == pytest.approx(4.0 * 1.01 + 0.25 * 0.99, abs=1e-9)
    assert control.value == pytest.approx(
        2.0 * 1.01**2 / 2 + 0.5 * (2.0**2 - 1.01**2) / 2, abs=1e-9
    )
    assert control.details["overshoot"] == pytest.approx(0.5)
    assert control.details["overshoot_percent"] == pytest.approx(25.0)
    assert control.unit == "s^2"


@pytest.mark.parametrize("message", [floats([3.0, 4.0]), array(3.0, 4.0)])
def test_an_error_may_be_a_vector(message: object) -> None:
    world = FakeWorld(timestep=DT)
    control = bound(world, error_topic="u")
    control.start()
    send(control, world, message, 101)
    assert control.value == pytest.approx(5.0)
    send(control, world, type(message)(layout=message.layout, data=message.data[:1]))  # type: ignore[attr-defined]
    assert control.notes != ()
    assert control.details["step"] == 5.0


def test_an_error_while_it_is_off_does_not_count() -> None:
    body = FakeBody((1.0, 0.0, 0.0))
    world = FakeWorld({"v": body}, timestep=DT)
    control = bound(world, target="v", position=(0.0, 0.0, 0.0))
    control.start()
    go_on(control, world, 100)
    world.advance(500)
    control.start()
    go_on(control, world, 100)
    assert control.value == pytest.approx(2.0, abs=1e-9)
    assert control.details["itae"] == pytest.approx(2.0, abs=1e-9)


def test_commands_and_error_are_judged_together() -> None:
    body = FakeBody((1.0, 0.0, 0.0))
    world = FakeWorld({"v": body}, timestep=DT)
    control = bound(world, topic="u", target="v", position=(0.0, 0.0, 0.0))
    control.start()
    send(control, world, twist(0.5), 10)
    assert control.log_header == ("variation", "effort", "n", "error [m]", "iae")
    assert control.log_values == pytest.approx((0.0, 0.25 * 9 * DT, 1.0, 1.0, 0.1))
    assert control.reasons == {
        "rise_time": "never rose to 90% of the step",
        "settling_time": "not within 0.02 of the step at the end",
    }


def test_a_quantity_that_is_not_there_says_why() -> None:
    body = FakeBody((0.001, 0.0, 0.0))
    world = FakeWorld({"v": body}, timestep=DT)
    control = bound(world, target="v", position=(0.0, 0.0, 0.0), quantity="overshoot")
    control.start()
    go_on(control, world, 10)
    assert (control.value, control.missing_reason) == (
        None,
        "no step: the error was 0.001 at the start",
    )


def test_only_what_an_algorithm_says_is_fed_by_it() -> None:
    world = FakeWorld({"v": FakeBody()}, timestep=DT)
    assert not bound(world, target="v", position=(0.0, 0.0, 0.0)).fed_by_algorithm
    assert bound(world, topic="u").fed_by_algorithm
    assert bound(world, error_topic="e").fed_by_algorithm


def test_it_listens_no_more_when_it_is_closed() -> None:
    world = FakeWorld(timestep=DT)
    control = bound(world, error_topic="e")
    assert world.bus.has_subscribers("e")
    control.close()
    assert not world.bus.has_subscribers("e")


def test_a_misspelt_target_is_an_error_that_names_the_right_one() -> None:
    with pytest.raises(UnknownName, match="Did you mean 'girona500'"):
        bound(FakeWorld({"girona500": FakeBody()}), target="girona50", position=(0.0, 0.0, 0.0))
