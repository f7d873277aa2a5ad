"""What thrusters and joints draw: the laws, their limits, and what a hydrodynamics file may say."""

from __future__ import annotations

import math
from functools import partial
from pathlib import Path

import pytest

from uwsim.physics.actuation.power import power_table
from uwsim.physics.actuation.power_kernel import joint_power, thruster_power
from uwsim.scene.hydrodynamics import ThrusterSpec, VehicleHydrodynamics
from uwsim.scene.hydrodynamics.checks import thruster_errors
from uwsim.scene.hydrodynamics.spec import JointDrive
from uwsim.scene.hydrodynamics.vehicle_file import VehicleError, read_vehicle
from uwsim.scene.hydrodynamics.vehicle_sets import vehicle_sets

T200 = [  # thrust [kgf] and power [W] at 12 V, Blue Robotics, September 2019
    (-2.90, 204.4), (-2.34, 144.0), (-1.53, 74.4), (-0.87, 28.9),
    (0.71, 15.6), (1.40, 45.6), (2.33, 106.8), (3.08, 156.5), (3.71, 202.9),
]  # fmt: skip

FILE = """<hydrodynamics name="mine">
  <body link="base_link"> <volume>0.01</volume> </body>
  <thruster name="t" link="base_link"> <forward>0 40</forward> {thruster} </thruster>
  {joint}
</hydrodynamics>"""


def thruster(**given: object) -> ThrusterSpec:
    return ThrusterSpec(name="t", link="base_link", forward=(0.0, 40.0), **given)  # type: ignore[arg-type]


def diagnostics_of(folder: Path, *, thruster: str = "", joint: str = "") -> list[str]:
    file = folder / "mine.xml"
    file.write_text(FILE.format(thruster=thruster, joint=joint))
    with pytest.raises(VehicleError) as caught:
        read_vehicle(file, ["base_link"], ["elbow", "wrist"])
    return [diagnostic.message for diagnostic in caught.value.diagnostics]


def test_a_propeller_at_rest_gives_the_water_of_its_disc_the_speed_of_momentum_theory() -> None:
    radius, density, thrust = 0.1, 1025.0, 80.0
    power = partial(thruster_power, power_table(thruster(radius=radius, efficiency=1.0), density))(
        thrust
    )
    disc = math.pi * radius**2
    wake = math.sqrt(2.0 * thrust / (density * disc))  # far behind; half of it in the disc
    assert density * disc * (wake / 2.0) * wake == pytest.approx(thrust)
    assert power == pytest.approx(thrust * wake / 2.0, rel=1e-12)
    half = partial(thruster_power, power_table(thruster(radius=radius, efficiency=0.5), density))
    assert half(thrust) == half(-thrust) == pytest.approx(2.0 * power, rel=1e-12)


def test_twice_the_power_is_not_twice_the_thrust() -> None:
    power = partial(thruster_power, power_table(thruster(), 1000.0))
    assert power(0.0) == 0.0
    assert power(8.0) / power(2.0) == pytest.approx(8.0)


def test_measured_power_replaces_the_law_and_may_differ_backward() -> None:
    both = partial(thruster_power, power_table(thruster(power=(1.0, 0.5)), 1000.0))
    assert both(4.0) == both(-4.0) == pytest.approx(12.0)
    uneven = partial(
        thruster_power, power_table(thruster(power=(1.0, 0.5), power_backward=(0.0, 2.0)), 1000.0)
    )
    assert (uneven(4.0), uneven(-4.0)) == (pytest.approx(12.0), pytest.approx(32.0))


def test_the_bundled_t200_draws_what_its_maker_measured() -> None:
    vehicle = read_vehicle(vehicle_sets()["bluerov2_heavy"])
    power = partial(thruster_power, power_table(vehicle.thrusters[0], 1000.0))
    for kgf, measured in T200:
        assert power(9.80665 * kgf) == pytest.approx(measured, rel=0.3)
    assert power(30.4) == pytest.approx(180.0, abs=1.0)


def test_the_bundled_girona_draws_what_the_coefficients_of_its_propeller_say() -> None:
    vehicle = read_vehicle(vehicle_sets()["g500_physical"])
    power = partial(thruster_power, power_table(vehicle.thrusters[0], vehicle.density))
    turns = math.sqrt(140.0 / (0.48 * 1000.0 * 0.18**4))  # [1/s]
    shaft = 2.0 * math.pi * turns * 0.05 * 1000.0 * 0.18**5 * turns**2
    assert power(140.0) == pytest.approx(shaft / 0.8, rel=0.01)


def test_a_joint_pays_for_its_work_and_for_its_torque_and_gets_nothing_back() -> None:
    drive = JointDrive(name="elbow", efficiency=0.5, copper_loss=0.02)
    assert joint_power(drive.efficiency, drive.copper_loss, 10.0, 0.3) == pytest.approx(6.0 + 2.0)
    assert joint_power(drive.efficiency, drive.copper_loss, 10.0, 0.0) == pytest.approx(2.0)  # held
    assert joint_power(drive.efficiency, drive.copper_loss, -10.0, 0.3) == pytest.approx(
        2.0
    )  # let down
    assert joint_power(drive.efficiency, drive.copper_loss, -10.0, -0.3) == pytest.approx(8.0)


def test_a_joint_that_the_file_does_not_name_has_the_documented_drive() -> None:
    vehicle = VehicleHydrodynamics(name="v", source="", bodies=())
    assert vehicle.drive("elbow") == JointDrive(name="elbow", efficiency=0.6, copper_loss=0.0)


def test_a_file_says_what_its_actuators_draw(tmp_path: Path) -> None:
    file = tmp_path / "mine.xml"
    file.write_text(
        FILE.format(
            thruster="<power>1 0.5</power> <powerBackward>2</powerBackward>",
            joint='<joint name="wrist"> <copperLoss>0.1</copperLoss> </joint>',
        )
    )
    vehicle = read_vehicle(file, ["base_link"], ["elbow", "wrist"])
    assert (vehicle.thrusters[0].power, vehicle.thrusters[0].power_backward) == ((1.0, 0.5), (2.0,))
    assert vehicle.drive("wrist") == JointDrive(name="wrist", copper_loss=0.1)


@pytest.mark.parametrize(
    ("given", "said"),
    [
        (
            "<efficiency>0</efficiency>",
            "<efficiency> is '0'; expected a number > 0 and <= 1.41 [1]",
        ),
        ("<efficiency>1.5</efficiency>", "<efficiency> is '1.5'; expected a number"),
        ("<power>1 x</power>", "<power> contains 'x'; expected numbers"),
        ("<power>1 1 1 1 1 1 1 1 1 1</power>", "power has 10 coefficients; expected 1 to 9"),
        ("<power>-3 0.1</power>", "power is -22.5 W at 15 N; expected none below 0"),
        ("<powerBackward>1</powerBackward>", "power backward is given without power"),
        ("<efficiency>0.3</efficiency> <power>1</power>", "both set its power; expected one"),
    ],
)
def test_a_power_that_no_thruster_can_draw_is_refused(
    tmp_path: Path, given: str, said: str
) -> None:
    diagnostics = diagnostics_of(tmp_path, thruster=given)
    assert any(said in diagnostic for diagnostic in diagnostics), diagnostics


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ('<joint name="elbo"/>', "the robot has no movable joint 'elbo'. Did you mean 'elbow'? "
         "Joints: elbow, wrist"),
        ('<joint name="elbow"/> <joint name="elbow"/>', "two <joint> for the joint 'elbow'"),
        ('<joint name="elbow"> <copperLoss>-1</copperLoss> </joint>',
         "<copperLoss> is '-1'; expected a number >= 0 [W/(N m)2, W/N2]"),
        ('<joint name="elbow"> <efficency>1</efficency> </joint>', "Did you mean efficiency?"),
    ],
)  # fmt: skip
def test_a_drive_that_no_joint_can_have_is_refused(tmp_path: Path, given: str, said: str) -> None:
    diagnostics = diagnostics_of(tmp_path, joint=given)
    assert len(diagnostics) == 1
    assert said in diagnostics[0]


def test_an_error_of_a_thruster_made_in_python_is_reported_too() -> None:
    assert thruster_errors(thruster(efficiency=0.0)) == [
        "thruster 't': efficiency is 0; expected a number > 0 and <= 1.41 [1]",
    ]
