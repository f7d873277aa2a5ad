"""Hydrodynamics files of hydrodynamics: read whole, with every error at once."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from uwsim.errors import UnknownName
from uwsim.scene.hydrodynamics import (
    BodyHydrodynamics,
    ThrusterSpec,
    VehicleHydrodynamics,
)
from uwsim.scene.hydrodynamics.checks import body_errors, thruster_errors
from uwsim.scene.hydrodynamics.spec import matrix
from uwsim.scene.hydrodynamics.vehicle_file import VehicleError, read_vehicle
from uwsim.scene.hydrodynamics.vehicle_sets import find_vehicle, vehicle_sets
from uwsim.scene.urdf.reader import read_urdf

DATA = Path(__file__).parents[2] / "src" / "uwsim" / "data"
ROBOTS = {
    "bluerov2_heavy": DATA / "vehicles" / "bluerov2_heavy.urdf",
    "g500_physical": DATA / "scenes" / "g500ARM5.urdf",
    "girona500": DATA / "vehicles" / "girona500.urdf",
    "remus100": DATA / "vehicles" / "remus100.urdf",
    "rexrov": DATA / "vehicles" / "rexrov.urdf",
    "uwsim_compat": DATA / "scenes" / "g500ARM5.urdf",
}

MINIMAL = """<hydrodynamics name="mine">
  <body link="base_link">
    <addedMass>1, 2, 3, 4, 5, 6</addedMass>
    <volume>0.01</volume>
    <centreOfBuoyancy> <x>0</x> <y>0</y> <z>0.1</z> </centreOfBuoyancy>
  </body>
  <thruster name="t" link="base_link"> <forward>0 40</forward> </thruster>
</hydrodynamics>"""


def diagnostics_of(path: Path, text: str, links: tuple[str, ...] = ("base_link",)) -> list[str]:
    file = path / "mine.xml"
    file.write_text(text)
    with pytest.raises(VehicleError) as caught:
        read_vehicle(file, links)
    return [f"{diagnostic.line}: {diagnostic.message}" for diagnostic in caught.value.diagnostics]


def test_a_short_file_is_read_with_defaults(tmp_path: Path) -> None:
    (tmp_path / "mine.xml").write_text(MINIMAL)
    vehicle = read_vehicle(tmp_path / "mine.xml", ["base_link"])
    assert vehicle == VehicleHydrodynamics(
        name="mine",
        source="",
        bodies=(
            BodyHydrodynamics(
                link="base_link",
                added_mass=(1.0, 2.0, 3.0, 4.0, 5.0, 6.0),
                volume=0.01,
                centre_of_buoyancy=(0.0, 0.0, 0.1),
            ),
        ),
        thrusters=(ThrusterSpec(name="t", link="base_link", forward=(0.0, 40.0)),),
    )


def test_every_error_of_a_file_is_reported_at_once_with_its_line(tmp_path: Path) -> None:
    text = """<hydrodynamics name="mine">
  <body link="base_lnk"> <addedMass>1 2 3</addedMass> </body>
  <body link="base_link"> <addedMass>-1 2 3 4 5 6</addedMass> <mss>3</mss> </body>
  <body link="base_link"> <linearDamping>1 2 x 4 5 6</linearDamping> <shape>bocks</shape>
    <quadraticDamping>1e10 2 3 4 5 6</quadraticDamping> </body>
  <thruster name="t" link="base_link"> <limits>1 2 3</limits> <forward>40</forward> </thruster>
  <thruster name="t" link="base_link"> <direction><x>0</x><y>0</y><z>0</z></direction>
    <forward>40</forward> <saturation>5 10</saturation> </thruster>
</hydrodynamics>"""
    said = "\n".join(diagnostics_of(tmp_path, text))
    for message in (
        "2: the robot has no link 'base_lnk'. Did you mean 'base_link'?",
        "2: link 'base_lnk': added mass has 3 numbers; expected 6 or 36",
        "3: link 'base_link': added mass is not positive semi-definite: its least eigenvalue is -1",
        "3: <mss> is not an element of <body>. Did you mean mass?",
        "4: two <body> for the link 'base_link'; only one is allowed",
        "4: <linearDamping> contains 'x'; expected numbers",
        "5: <quadraticDamping> contains '1e10'; no quantity is beyond 1e+09",
        "4: <shape> is 'bocks'; expected one of 'sphere', 'ellipsoid', 'box'",
        "6: <limits> has 3 numbers; expected 2",
        "7: two thrusters are called 't'",
        "7: thruster 't': direction is 0 0 0",
        "saturation are 5 10; expected least <= 0 <= greatest",
    ):
        assert message in said, f"{message}\n--\n{said}"


def test_a_shape_that_is_none_is_reported_once_and_its_lengths_are_not_counted(
    tmp_path: Path,
) -> None:
    shape = "<shape>cone</shape> <size>0.5 0.4 0.3</size> </body>"
    (said,) = diagnostics_of(tmp_path, MINIMAL.replace("</body>", shape))
    assert "<shape> is 'cone'; expected one of" in said
    (said,) = diagnostics_of(tmp_path, MINIMAL.replace("</body>", shape.replace("cone", "sphere")))
    assert said.endswith("a sphere has 1 length; found 3")


def test_an_added_mass_that_is_not_symmetric_names_the_entries(tmp_path: Path) -> None:
    rows = np.eye(6)
    rows[0, 4] = 0.5
    text = MINIMAL.replace("1, 2, 3, 4, 5, 6", " ".join(map(str, rows.ravel())))
    assert diagnostics_of(tmp_path, text) == [
        "2: link 'base_link': added mass is not symmetric: entry (1,5) is 0.5 and (5,1) is 0"
    ]


def test_an_inertia_that_no_body_has_is_refused(tmp_path: Path) -> None:
    text = MINIMAL.replace("<volume>", "<inertia>1 1 3 0 0 0</inertia> <volume>")
    assert "no body can have one above the sum" in diagnostics_of(tmp_path, text)[0]


def test_an_included_file_brings_its_bodies_and_its_errors(tmp_path: Path) -> None:
    (tmp_path / "arm.xml").write_text(
        '<hydrodynamics name="arm"> <body link="hand"> <volume>-1</volume> </body></hydrodynamics>'
    )
    text = MINIMAL.replace("<body", "<include>arm.xml</include> <body", 1)
    said = diagnostics_of(tmp_path, text, ("base_link", "hand"))
    assert said == ["2: in arm.xml, line 1: <volume> is '-1'; expected a number >= 0 [m3]"]


def test_a_bundled_part_is_included_by_its_path_unless_one_lies_beside_the_file(
    tmp_path: Path,
) -> None:
    (tmp_path / "mine.xml").write_text(
        MINIMAL.replace("<body", "<include>parts/arm5e.xml</include> <body", 1)
    )
    links = [body.link for body in read_vehicle(tmp_path / "mine.xml").bodies]
    assert links[:2] == ["base_link", "part0"]
    assert len(links) == 8
    (tmp_path / "parts").mkdir()
    (tmp_path / "parts" / "arm5e.xml").write_text('<hydrodynamics name="arm5e"/>')
    assert len(read_vehicle(tmp_path / "mine.xml").bodies) == 1


def test_an_unknown_set_is_reported_with_those_next_to_the_scene(tmp_path: Path) -> None:
    (tmp_path / "my_rov.xml").write_text(MINIMAL)
    (tmp_path / "scene.xml").write_text("<UWSimScene/>")
    with pytest.raises(UnknownName, match="Did you mean 'my_rov'") as wrong:
        find_vehicle("myrov", tmp_path / "scene.xml")
    assert "'scene'" not in str(wrong.value)
    assert " scene," not in str(wrong.value)


def test_a_file_that_includes_itself_is_refused(tmp_path: Path) -> None:
    text = MINIMAL.replace("<body", "<include>mine.xml</include> <body", 1)
    assert "includes itself" in diagnostics_of(tmp_path, text)[0]


def test_errors_of_parts_made_in_python_are_the_same() -> None:
    body = BodyHydrodynamics(link="a", shape="box")
    thruster = ThrusterSpec(name="t", link="b", forward=(1.0,) * 10)
    assert [*body_errors(body), *thruster_errors(thruster)] == [
        "link 'a': a box needs its 3 lengths (size) [m]",
        "thruster 't': forward has 10 coefficients; expected 1 to 9",
    ]


def test_the_bundled_sets_are_the_promised_ones() -> None:
    assert sorted(vehicle_sets()) == sorted(ROBOTS)
    with pytest.raises(UnknownName, match="Did you mean 'rexrov'"):
        find_vehicle("rexrow")


def test_fins_and_thrust_at_speed_are_read_and_their_faults_have_lines(tmp_path: Path) -> None:
    thruster = """<thruster name="screw" link="base_link"> <forward>0 40</forward>
      <advance>0 0.45, 0.9 0</advance> <wake>0.1</wake> </thruster>"""
    fin = """<fin name="rudder" link="base_link"> <position> <x>-1</x> <y>0</y> <z>0</z> </position>
      <area>0.01</area> <aspectRatio>2</aspectRatio> <rate>0.5</rate> </fin>"""
    text = MINIMAL.replace("</hydrodynamics>", f"{thruster}\n{fin}\n</hydrodynamics>")
    (tmp_path / "mine.xml").write_text(text)
    found = read_vehicle(tmp_path / "mine.xml")
    assert found.thrusters[1].advance == (0.0, 0.45, 0.9, 0.0)
    (rudder,) = found.fins
    assert rudder.slope == pytest.approx(1 / (1 / (1.8 * np.pi) + 1 / (2 * np.pi)))
    assert rudder.induced_drag_slope == pytest.approx(1 / (1.8 * np.pi))
    first = text.splitlines().index(thruster.splitlines()[0]) + 1
    for old, new, line, said in (
        ("0 0.45, 0.9 0", "0 0.45 0.9", first, "advance has 3 numbers; expected 2 to 12 pairs"),
        ("<aspectRatio>2</aspectRatio>", "", first + 2, "expected one of <aspectRatio>"),
        ('<fin name="rudder" link="base_link">', '<fin name="rudder" link="base">', first + 2,
         "the robot has no link 'base'"),
    ):  # fmt: skip
        (message,) = diagnostics_of(tmp_path, text.replace(old, new))
        assert message.startswith(f"{line}: ")
        assert said in message


def test_a_set_beside_the_scene_comes_before_a_bundled_one(tmp_path: Path) -> None:
    own = tmp_path / "rexrov.xml"
    own.write_text(MINIMAL)
    assert find_vehicle("rexrov", tmp_path / "scene.xml") == own
    assert find_vehicle("rexrov", DATA / "scene.xml") == vehicle_sets()["rexrov"]


@pytest.mark.parametrize("name", ROBOTS)
def test_a_bundled_set_fits_its_robot_names_its_source_and_floats(name: str) -> None:
    robot = read_urdf(ROBOTS[name])
    vehicle = read_vehicle(vehicle_sets()[name], [link.name for link in robot.links])
    assert vehicle.name == name
    assert len(vehicle.source) > 40
    assert vehicle.body(robot.root) is not None
    mass = sum(body.mass or 0.0 for body in vehicle.bodies)
    displaced = vehicle.density * sum(body.volume for body in vehicle.bodies)
    assert -0.01 < (displaced - mass) / mass < 0.025
    for body in vehicle.bodies:
        added = matrix(body.added_mass)
        assert (added == added.T).all()


def test_the_compat_set_is_the_mass_matrix_of_the_original_node() -> None:
    vehicle = read_vehicle(vehicle_sets()["uwsim_compat"])
    base = vehicle.body("base_link")
    assert base is not None
    assert base.centre_of_mass is not None
    assert base.inertia is not None
    assert base.mass == 98.0
    assert base.mass * base.centre_of_mass[2] == pytest.approx(4.9)
    steiner = base.mass * base.centre_of_mass[2] ** 2
    assert base.inertia[:3] == pytest.approx((8 - steiner, 8 - steiner, 8.0))
    thrust = [one.forward[1] for one in vehicle.thrusters]
    assert thrust == pytest.approx([6.835e-5 * 1500**2] * 5)


THRUST = "<forward>0 40</forward>"


@pytest.mark.parametrize(
    ("curve", "said"),
    [
        ("<forward>0 -40</forward>", "forward gives -40 N at the limit 1; expected more than 0"),
        ("<forward>0</forward>", "forward gives 0 N at the limit 1; expected more than 0"),
        ("<forward>40 -30</forward>", "forward falls from 13.33 N to 10 N at the command 1;"),
        ("<forward>-10 30</forward>", "forward falls from 0 N to -0.8333 N at the command 0.167;"),
        (f"{THRUST} <backward>0 -30</backward>", "backward gives -30 N at the limit 1"),
        ("<forward>0 1e8</forward>", "forward gives 1e+08 N; expected at most 1e+07 N"),
        (f"{THRUST} <backward>40 -30</backward>", "backward falls from 13.33 N to 10 N"),
        (f"{THRUST} <deadZone>1</deadZone>", "dead zone is 1; expected below 1"),
        (
            f"{THRUST} <limits>-0.2 1</limits> <deadZone>0.5</deadZone>",
            "dead zone is 0.5; expected below 0.2, the limit of a backward command",
        ),
        (f"{THRUST} <limits>1 -1</limits>", "limits are 1 -1; expected least <= 0 <= greatest"),
        (f"{THRUST} <limits>0 0</limits>", "limits are 0 0; expected least <= 0 <= greatest, not"),
        (f"{THRUST} <limits>0.5 1</limits>", "limits are 0.5 1; expected least <= 0"),
        (f"{THRUST} <saturation>0 0</saturation>", "saturation are 0 0; expected least <= 0"),
        (f"{THRUST} <torque>0.2</torque>", "torque is 0.2 per thrust; expected at most the prop"),
        (f"{THRUST} <timeConstant>61</timeConstant>", "<timeConstant> is '61'; expected a number"),
        ("<forward>,</forward>", "<forward> contains ','; expected numbers"),
        ("<forward>nan</forward>", "<forward> contains 'nan'; expected numbers"),
        (f"{THRUST} <radius>-inf</radius>", "<radius> is '-inf'; expected a number >= 0.001 [m]"),
        (f"<forward>{'1 ' * 201}</forward>", "<forward> has 201 numbers; expected 200 at most"),
    ],
)
def test_a_thruster_that_cannot_be_is_refused(curve: str, said: str, tmp_path: Path) -> None:
    (diagnostic,) = diagnostics_of(tmp_path, MINIMAL.replace(THRUST, curve))
    assert diagnostic.startswith("7: ")
    assert said in diagnostic


@pytest.mark.parametrize(
    "curve",
    [
        "<forward>0 40</forward> <limits>0 1</limits> <backward>0</backward>",
        "<forward>0 40</forward> <limits>-1 0</limits>",
        "<forward>8.9 0 176 0 -404.1 0 389.9 0 -140.3</forward>",  # sags by 0.7 % at the end
        "<forward>0.4</forward> <limits>-300 300</limits> <deadZone>20</deadZone>",
    ],
)
def test_a_thruster_of_one_way_or_measured_or_of_other_units_may_be(
    curve: str, tmp_path: Path
) -> None:
    (tmp_path / "mine.xml").write_text(MINIMAL.replace(THRUST, curve))
    assert len(read_vehicle(tmp_path / "mine.xml").thrusters) == 1


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("<z>0.1</z>", "<z>-600</z>", "centre of buoyancy is 0 0 -600; expected none beyond 500"),
        ("<volume>0.01", "<volume>-0.01", "<volume> is '-0.01'; expected a number >= 0 [m3]"),
        ("<volume>0.01", "<volume>inf", "<volume> is 'inf'; expected a number >= 0 [m3]"),
        ("1, 2, 3,", "1, NaN, 3,", "<addedMass> contains 'NaN'; expected numbers"),
        ("<body", "<density>1.025</density> <body", "<density> is '1.025'; expected a number >= 1"),
        ("<volume>", "<mass>-3</mass> <volume>", "<mass> is '-3'; expected a number > 0 [kg]"),
    ],
)
def test_a_number_that_no_vehicle_has_is_refused(
    old: str, new: str, said: str, tmp_path: Path
) -> None:
    (diagnostic,) = diagnostics_of(tmp_path, MINIMAL.replace(old, new, 1))
    assert said in diagnostic


@pytest.mark.parametrize("number", [math.nan, math.inf, -math.inf])
@pytest.mark.parametrize(
    "name", ["volume", "mass", "reference", "inertia", "size", "added_mass", "implicitness"]
)
def test_a_body_made_in_python_with_a_number_that_is_none_is_refused(
    name: str, number: float
) -> None:
    how_many = {"reference": 3, "inertia": 6, "size": 1, "added_mass": 6}.get(name)
    value = number if how_many is None else (number,) * how_many
    (said,) = body_errors(BodyHydrodynamics(link="a", **{name: value}))  # type: ignore[arg-type]
    assert "expected finite numbers" in said


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("nope.xml", "2: <include> 'nope.xml': there is no such file"),
        (".", "2: <include> '.': is a folder, not a file"),
        ("torn.xml", "2: <include> 'torn.xml': not well-formed XML: "),
        ("a" * 5000, "2: <include> 'aaaaaaaa"),
        ("inner/../mine.xml", "2: <include> 'inner/../mine.xml' includes itself"),
        ("arm.xml</include><include>arm.xml", "2: <include> 'arm.xml': it is included already"),
    ],
)
def test_what_cannot_be_included_is_reported_where_it_should_be(
    name: str, said: str, tmp_path: Path
) -> None:
    (tmp_path / "inner").mkdir()
    (tmp_path / "torn.xml").write_text("<hydrodynamics")
    (tmp_path / "arm.xml").write_text('<hydrodynamics name="arm"/>')
    text = MINIMAL.replace("\n  <body", f"\n<include>{name}</include> <body", 1)
    (diagnostic,) = diagnostics_of(tmp_path, text)
    assert diagnostic.startswith(said)


def test_what_has_no_name_is_refused(tmp_path: Path) -> None:
    text = MINIMAL.replace('name="mine"', 'name=" "').replace('name="t"', 'name=" "')
    assert diagnostics_of(tmp_path, text) == ["1: the set has no name", "7: a thruster has no name"]


@pytest.mark.parametrize("name", ["x" * 5000, "../mine", "a\0b"])
def test_a_set_whose_name_no_file_can_have_is_an_unknown_one(name: str, tmp_path: Path) -> None:
    (tmp_path / "mine.xml").write_text(MINIMAL)
    (tmp_path / "inner").mkdir()
    with pytest.raises(UnknownName, match="No hydrodynamics set is called"):
        find_vehicle(name, tmp_path / "inner" / "scene.xml")


def test_an_inertia_that_the_engine_refuses_and_a_propeller_of_no_size_are_errors(
    tmp_path: Path,
) -> None:
    tiny = "<inertia>1e-300 1e-300 1e-300 0 0 0</inertia> <volume>"
    text = MINIMAL.replace("<volume>", tiny).replace(THRUST, f"{THRUST} <radius>1e-300</radius>")
    said = diagnostics_of(tmp_path, text)
    assert "expected > 1e-12 [kg m2]" in said[0]
    assert "<radius> is '1e-300'; expected a number >= 0.001 [m]" in said[1]
