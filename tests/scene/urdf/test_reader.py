"""Robot files: UWSim's order of joints, limits, mimics, and the arm's forward kinematics."""

from __future__ import annotations

import contextlib
import math
import tempfile
import time
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from uwsim.checks import check_file
from uwsim.errors import SceneError
from uwsim.scene.urdf.kinematics import joint_positions, link_poses
from uwsim.scene.urdf.reader import read_robot, read_urdf
from uwsim.scene.urdf.robot import RobotSpec
from uwsim.schema import Diagnostics

G500 = Path(__file__).parents[3] / "src" / "uwsim" / "data" / "scenes" / "g500ARM5.urdf"


def robot_of(inside: str, folder: Path) -> RobotSpec:
    file = folder / "robot.urdf"
    file.write_text(f'<robot name="r">{inside}</robot>')
    return read_urdf(file)


def refused(inside: str, folder: Path) -> list[str]:
    with pytest.raises(SceneError) as caught:
        robot_of(inside, folder)
    return [diagnostic.message for diagnostic in caught.value.diagnostics]


def joint(name: str, inside: str = "", *, kind: str = "continuous", of: str = "a b") -> str:
    parent, child = of.split()
    return (
        f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>'
        f"{inside}</joint>"
    )


LINKS = '<link name="a"/><link name="b"/><link name="c"/>'


def test_the_joint_vector_of_the_girona_500() -> None:
    robot = read_urdf(G500)
    names = [joint.name for joint in robot.movable_joints]
    assert names == ["Slew", "Shoulder", "Elbow", "JawRotate", "JawOpening"]
    assert robot.root == "base_link"
    assert [link.mass for link in robot.links if link.mass] == [95.0]
    assert (robot.movable_joints[3].lower, robot.movable_joints[3].upper) == (-math.pi, math.pi)


@pytest.mark.parametrize(
    ("joints", "expected"),
    [
        (
            (),
            {
                "part2": (-0.0805, 0, 1.08),
                "part3": (-0.5190, 0, 1.1415),
                "part4_base": (-0.8567, 0, 1.2474),
                "end_effector": (-0.9840, 0, 1.3238),
            },
        ),
        (
            (0, 0, 2.15294, 0, 0.3),
            {"part4_base": (-0.2449, 0, 1.3653), "end_effector": (-0.1110, 0, 1.4296)},
        ),
        ((0, math.pi / 4, math.pi / 4, 0, 0), {"end_effector": (-0.1647, 0, 1.8985)}),
    ],
)
def test_the_arm_is_where_the_original_has_it(
    joints: tuple[float, ...], expected: dict[str, tuple[float, float, float]]
) -> None:
    poses = link_poses(read_urdf(G500), joints)
    for link, position in expected.items():
        np.testing.assert_allclose(poses[link].position, position, atol=6e-5)


def test_the_hand_points_where_the_original_has_it() -> None:
    pose = link_poses(read_urdf(G500), (0, math.pi / 4, math.pi / 4))["end_effector"]
    np.testing.assert_allclose(pose.rotation[:, 2], [0.5147, 0, 0.8573], atol=5e-5)


def test_joints_are_held_at_their_limits() -> None:
    positions = joint_positions(read_urdf(G500), (9, -9, 2.2, 9, -0.3))
    assert positions["Slew"] == 0.5488
    assert positions["Shoulder"] == 0
    assert positions["Elbow"] == 2.15294
    assert positions["JawRotate"] == math.pi
    assert positions["JawOpening"] == -0.05816


def test_the_second_jaw_follows_the_first() -> None:
    positions = joint_positions(read_urdf(G500), (0, 0, 0, 0, 0.7))
    assert positions["part4_to_link4_jaw2"] == positions["JawOpening"] == 0.7


def test_children_are_walked_in_the_order_of_their_joints_names(tmp_path: Path) -> None:
    robot = robot_of(LINKS + joint("a", of="a b") + joint("B", of="a c"), tmp_path)
    assert [joint.name for joint in robot.joints] == ["B", "a"]
    assert [link.name for link in robot.links] == ["a", "c", "b"]


@pytest.mark.parametrize("kind", ["revolute", "prismatic"])
def test_a_limit_without_bounds_freezes_the_joint(kind: str, tmp_path: Path) -> None:
    given = joint("s", '<limit effort="1" velocity="1"/>', kind=kind)
    (slew,) = robot_of('<link name="a"/><link name="b"/>' + given, tmp_path).joints
    assert (slew.lower, slew.upper) == (0, 0)


def test_a_prismatic_joint_without_limit_slides_from_minus_pi_to_pi(tmp_path: Path) -> None:
    robot = robot_of(
        '<link name="a"/><link name="b"/>' + joint("s", '<axis xyz="0 0 2"/>', kind="prismatic"),
        tmp_path,
    )
    pose = link_poses(robot, (4.0,))["b"]
    np.testing.assert_allclose(pose.position, [0, 0, math.pi])


def test_floating_joints_are_fixed(tmp_path: Path) -> None:
    robot = robot_of('<link name="a"/><link name="b"/>' + joint("s", kind="floating"), tmp_path)
    assert robot.movable_joints == ()


def test_a_joint_that_mimics_nobody_is_free_and_that_is_reported(tmp_path: Path) -> None:
    file = tmp_path / "robot.urdf"
    inside = LINKS + joint("jaw_1") + joint("jaw_2", '<mimic joint="jaw1"/>', of="a c")
    file.write_text(f'<robot name="r">{inside}</robot>')
    diagnostics = Diagnostics(file)
    robot = read_robot(file, diagnostics)
    assert robot is not None
    assert [joint.name for joint in robot.movable_joints] == ["jaw_1", "jaw_2"]
    (said,) = diagnostics.to_list()
    assert said.severity == "warning"
    assert "'jaw1', which is no joint. Did you mean jaw_1?" in said.message


def test_a_slider_crank_follows_its_own_law(tmp_path: Path) -> None:
    robot = robot_of(
        LINKS + joint("1") + joint("slidercrank", '<mimic joint="1" offset="0.5"/>', of="a c"),
        tmp_path,
    )
    positions = joint_positions(robot, (0.4,))
    assert positions["slidercrank"] == pytest.approx(-(0.4 + math.asin(0.5 * math.sin(0.4))))


def test_all_visuals_and_collisions_of_a_link_count_and_materials_go_by_name(
    tmp_path: Path,
) -> None:
    robot = robot_of(
        '<material name="red"><color rgba="1 0 0 0.5"/></material>'
        '<link name="a"><visual><geometry><cylinder radius="0.2" length="0.6"/></geometry>'
        '<material name="red"/></visual>'
        '<visual><origin xyz="0 0 1"/><geometry><box size="1 2 3"/></geometry></visual>'
        '<collision><geometry><sphere radius="1"/></geometry></collision>'
        '<collision><geometry><box size="1 1 1"/></geometry></collision></link>',
        tmp_path,
    )
    link = robot.links[0]
    assert link.visual is link.visuals[0]
    assert [(visual.kind, visual.size, visual.colour) for visual in link.visuals] == [
        ("cylinder", (0.4, 0.4, 0.6), (1, 0, 0, 0.5)),
        ("box", (1, 2, 3), None),
    ]
    assert [solid.kind for solid in link.solids] == ["sphere", "box"]


def test_without_collisions_all_that_is_seen_of_a_link_is_touched(tmp_path: Path) -> None:
    seen = '<visual><geometry><box size="1 1 {}"/></geometry></visual>'
    robot = robot_of(f'<link name="a">{seen.format(1)}{seen.format(2)}</link>', tmp_path)
    assert [solid.size[2] for solid in robot.links[0].solids] == [1, 2]


def test_a_material_that_one_visual_defines_another_may_name(tmp_path: Path) -> None:
    box = '<geometry><box size="1 1 1"/></geometry>'
    robot = robot_of(
        f'<link name="a"><visual>{box}<material name="hull"/></visual>'
        f'<visual>{box}<material name="hull"><color rgba="1 0.5 0 1"/></material></visual>'
        f'<visual>{box}<material name="hull"><color rgba="0 0 2 1"/></material></visual></link>',
        tmp_path,
    )
    colours = [visual.colour for visual in robot.links[0].visuals]
    assert colours == [(1, 0.5, 0, 1), (1, 0.5, 0, 1), (0, 0, 1, 1)]


def test_a_material_that_nothing_defines_is_warned_of_once(tmp_path: Path) -> None:
    box = '<visual><geometry><box size="1 1 1"/></geometry><material name="{}"/></visual>'
    uses = "".join(map(box.format, ("Gazebo/Grey", "hul", "hull", "skin", "", "Gazebo/Grey")))
    file = tmp_path / "robot.urdf"
    file.write_text(
        f'<robot name="r"><link name="a">{uses}</link>'
        '<material name="hull"><color rgba="1 0 0 1"/></material>'
        '<material name="skin"><texture filename="skin.png"/></material></robot>'
    )
    diagnostics = Diagnostics(file)
    assert read_robot(file, diagnostics) is not None
    assert [each.message for each in diagnostics.to_list()] == [
        "no material is called 'Gazebo/Grey': it gives no colour.",
        "no material is called 'hul': it gives no colour. Did you mean hull?",
    ]


def test_what_other_programs_wrote_is_passed_over(tmp_path: Path) -> None:
    robot = robot_of('<gazebo><plugin/></gazebo><link name="a"/><transmission/>', tmp_path)
    assert robot.root == "a"


def test_every_error_of_a_robot_is_reported_at_once(tmp_path: Path) -> None:
    said = refused(
        '<link name="arm"/><link name="arm"/>'
        '<link name="b"><visual><geometry><mesh/></geometry></visual></link>'
        + joint("1", kind="fixde", of="arm b")
        + joint("2", of="amr b")
        + joint("3", '<origin xyz="0 0"/><mimic joint="x"/>', of="arm b"),
        tmp_path,
    )
    assert said == [
        "two links are called 'arm'",
        "<mesh> lacks the attribute filename",
        "joint '1' has the type 'fixde'; expected one of revolute, continuous, prismatic, fixed, "
        "floating, planar. Did you mean fixed?",
        "joint '2': its parent 'amr' is no link. Did you mean arm?",
        "xyz of <origin> is '0 0'; expected 3 numbers",
    ]


@pytest.mark.parametrize(
    ("inside", "said"),
    [
        ("", "the robot has no <link>"),
        (LINKS, "3 links have no parent"),
        (LINKS + joint("1", of="a b") + joint("2", of="b c") + joint("3", of="c a"), "a loop"),
        ('<link name="d"/>' + LINKS + joint("1", of="b c") + joint("2", of="c b")
         + joint("3", of="d a"), "part of a loop"),
        ('<link name="a"/><link name="b"/>' + joint("1") + joint("2"), "has two parent joints"),
        ('<link name="a"/><link name="b"/>' + joint("1", '<origin xyz="${x} 0 0"/>'), "xacro"),
        ('<link name="a"/><link name="b"/>' + joint("1", '<axis xyz="nan 0 0"/>'), "3 numbers"),
    ],
)  # fmt: skip
def test_a_robot_that_is_no_tree_is_refused(inside: str, said: str, tmp_path: Path) -> None:
    assert any(said in message for message in refused(inside, tmp_path))


SEED = G500.read_bytes()


@settings(max_examples=100, deadline=None)
@given(st.integers(0, len(SEED)), st.integers(0, 60), st.binary(max_size=6), st.booleans())
def test_no_mutation_of_a_robot_raises_anything_but_a_scene_error(
    at: int, length: int, piece: bytes, cut: bool
) -> None:
    text = SEED[:at] + piece + (b"" if cut else SEED[at + length :])
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "robot.urdf"
        file.write_bytes(text)
        with contextlib.suppress(SceneError):
            link_poses(read_urdf(file), (0.1, 0.2, 0.3))


def chain(n: int) -> str:
    links = "".join(f'<link name="{i}"/>' for i in range(n + 1))
    return links + "".join(joint(f"j{i}", kind="fixed", of=f"{i} {i + 1}") for i in range(n))


def test_a_chain_of_3000_links_is_an_error_and_no_recursion_error(tmp_path: Path) -> None:
    assert len(robot_of(chain(256), tmp_path).joints) == 256
    assert refused(chain(3000), tmp_path) == ["joint 'j256' ends a chain of more than 256 joints"]


@pytest.mark.parametrize("order", [("p", "q", "r"), ("r", "q", "p"), ("q", "r", "p")])
def test_a_joint_that_mimics_one_that_mimics_follows_the_first(
    order: tuple[str, str, str], tmp_path: Path
) -> None:
    joints = {
        "p": joint("p", of="a b"),
        "q": joint("q", '<mimic joint="p" multiplier="2" offset="0.1"/>', of="b c"),
        "r": joint("r", '<mimic joint="q" multiplier="-1" offset="0.2"/>', of="c d"),
    }
    robot = robot_of(LINKS + '<link name="d"/>' + "".join(joints[n] for n in order), tmp_path)
    for value in (0.5, -0.3):
        followed = 2.0 * value + 0.1
        assert joint_positions(robot, (value,)) == pytest.approx(
            {"p": value, "q": followed, "r": 0.2 - followed}
        )


def test_a_chain_with_a_slider_crank_is_not_followed_and_said_so(tmp_path: Path) -> None:
    joints = (
        joint("p", of="a b")
        + joint("slidercrank", '<mimic joint="p" offset="0.5"/>', of="b c")
        + joint("r", '<mimic joint="slidercrank" offset="0.2"/>', of="c d")
    )
    file = tmp_path / "r.urdf"
    file.write_text(f'<robot name="r">{LINKS}<link name="d"/>{joints}</robot>')
    (told,) = [each for each in check_file(file) if "mimics" in each.message]
    assert told.severity == "warning"
    assert "joint 'r' mimics 'slidercrank'" in told.message
    assert joint_positions(read_urdf(file), (0.4,))["r"] == 0.2


def test_a_chain_whose_multipliers_grow_beyond_all_bounds_is_an_error(tmp_path: Path) -> None:
    n = 8
    links = "".join(f'<link name="{i}"/>' for i in range(n + 1))
    mimic = '<mimic joint="j{}" multiplier="1000"/>'
    joints = "".join(
        joint(f"j{i}", mimic.format(i - 1) if i else "", of=f"{i} {i + 1}") for i in range(n)
    )
    assert "expected at most 1e+06" in refused(links + joints, tmp_path)[0]


def test_joints_that_mimic_each_other_are_a_loop(tmp_path: Path) -> None:
    joints = joint("j", '<mimic joint="k"/>') + joint("k", '<mimic joint="j"/>', of="b c")
    assert refused(LINKS + joints, tmp_path) == [
        "joint 'j' mimics 'k' mimics 'j': a loop",
        "joint 'k' mimics 'j' mimics 'k': a loop",
    ]


@pytest.mark.parametrize("last", ["", '<mimic joint="j0"/>'], ids=["a chain", "a loop"])
def test_1200_joints_that_mimic_the_next_are_followed_once_each(last: str, tmp_path: Path) -> None:
    n = 1200
    links = '<link name="a"/>' + "".join(f'<link name="{i}"/>' for i in range(n))
    mimics = [*(f'<mimic joint="j{i + 1}"/>' for i in range(n - 1)), last]
    text = links + "".join(joint(f"j{i}", mimics[i], of=f"a {i}") for i in range(n))
    start = time.process_time()
    if last:
        assert "and 1100 more errors" in refused(text, tmp_path)
    else:
        assert len(robot_of(text, tmp_path).joints) == n
    assert time.process_time() - start < 2.0  # it took 4 s and 14 s


@pytest.mark.parametrize(
    ("shape", "said"),
    [
        ('<sphere radius="-3"/>', "radius of <sphere> is '-3'; expected 0 to 1e+06"),
        ('<cylinder radius="1" length="-1"/>', "length of <cylinder> is '-1'; expected 0"),
        ('<box size="1 -1 1"/>', "size of <box> is '1 -1 1'; expected numbers >= 0"),
        ('<box size="1 1e300 1"/>', "expected numbers up to 1e+06"),
    ],
)
def test_negative_and_endless_sizes_are_errors(shape: str, said: str, tmp_path: Path) -> None:
    (message,) = refused(
        f'<link name="a"><visual><geometry>{shape}</geometry></visual></link>', tmp_path
    )
    assert said in message


@pytest.mark.parametrize(
    ("inside", "said"),
    [
        ('<axis xyz="0 0 0"/><limit lower="-1" upper="1"/>', "has the axis 0 0 0; it is fixed"),
        ('<limit lower="1" upper="-1"/>', "lower 1 is above upper -1"),
        (
            '<limit lower="-1" upper="1"/><dynamics friction="-2"/>',
            "has the friction -2; expected 0 or more: 0",
        ),
    ],
)
def test_joints_that_cannot_move_are_warned_of_with_their_line(
    inside: str, said: str, tmp_path: Path
) -> None:
    file, pair = tmp_path / "robot.urdf", '<link name="a"/><link name="b"/>'
    file.write_text(f'<robot name="r">\n{pair}\n{joint("j", inside, kind="revolute")}</robot>')
    diagnostics = Diagnostics(file)
    read_robot(file, diagnostics)
    (warning,) = diagnostics.to_list()
    assert (warning.line, warning.severity) == (3, "warning")
    assert said in warning.message
