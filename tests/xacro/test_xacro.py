"""Xacro and includes are expanded as a scene or robot is read, without running any code."""

from __future__ import annotations

from pathlib import Path

import pytest
from lxml import etree

from uwsim.checks import check_file
from uwsim.errors import SceneError
from uwsim.scene.reader import read_scene
from uwsim.scene.urdf.reader import read_urdf
from uwsim.scene.xacro import parse_expanded
from uwsim.scene.xacro.expression import evaluate
from uwsim.scene.xacro.value import ExpressionError

NAMESPACES = 'xmlns:xacro="http://ros.org/wiki/xacro" xmlns:xi="http://www.w3.org/2001/XInclude"'


def expanded(folder: Path, body: str) -> etree._Element:
    path = folder / "a.xml"
    path.write_text(f"<a {NAMESPACES}>{body}</a>")
    return parse_expanded(path, error=SceneError).root


def plain(folder: Path, body: str) -> str:
    found = expanded(folder, body)
    return "".join(shown(child) for child in found)


def shown(node: etree._Element) -> str:
    """An element as text, without the blanks and namespace declarations of the file."""
    attributes = "".join(f' {key}="{value}"' for key, value in node.attrib.items())
    if not isinstance(node.tag, str):
        return node.tail or ""
    content = (node.text or "").strip() + "".join(map(shown, node))
    return f"<{node.tag}{attributes}>{content}</{node.tag}>"


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ('<xacro:property name="x" value="2"/><b>${x + 1}</b>', "<b>3</b>"),
        ('<xacro:property name="x" value="2"/><b v="${x/4} m"/>', '<b v="0.5 m"></b>'),
        ('<b>${y}</b><xacro:property name="y" value="1"/>', None),
        (
            '<xacro:property name="x" value="${y*2}"/><xacro:property name="y" value="3"/>'
            "<b>${x}</b>",
            "<b>6</b>",
        ),
        ("<b>$${x} $5</b>", "<b>${x} $5</b>"),
        ("<b>${-pi/2}</b>", "<b>-1.5707963267948966</b>"),
        ('<b>${1 if 2 > 1 and not False else 0}${"a" + "b"}</b>', "<b>1ab</b>"),
        (
            '<xacro:if value="${1 == 1.0}"><b/></xacro:if><xacro:if value="0"><c/></xacro:if>',
            "<b></b>",
        ),
        ("<b><!-- ${no} -->${1 + 1}<!-- more --></b>", "<b>2</b>"),
        ('<xacro:unless value="false"><b/></xacro:unless>', "<b></b>"),
        ('<xacro:arg name="n" default="7"/><b>$(arg n)</b>', "<b>7</b>"),
        (
            '<xacro:macro name="m" params="p q:=4 r:=${q2}"><b>${p} ${q} ${r}</b></xacro:macro>'
            '<xacro:property name="q2" value="9"/><xacro:m p="1"/><xacro:m q="2" p="${3}" r="5"/>',
            "<b>1 4 9</b><b>3 2 5</b>",
        ),
        (
            '<xacro:macro name="m" params="*one **many"><b><xacro:insert_block name="many"/>'
            '<xacro:insert_block name="one"/></b></xacro:macro>'
            "<xacro:m><c>1</c><d><e/><f/></d></xacro:m>",
            "<b><e></e><f></f><c>1</c></b>",
        ),
        (
            '<xacro:property name="p"><c/></xacro:property><b><xacro:insert_block name="p"/></b>',
            "<b><c></c></b>",
        ),
        (
            """<xacro:macro name="m" params="p=:='0 0 0' q:='a b' r := 'c'd'e' s:=$(arg k) t:=u">"""
            "<b>${p}|${q}|${r}|${s}|${t}</b></xacro:macro><xacro:arg name='k' default='7'/>"
            "<xacro:m/>",
            "<b>:='0 0 0'|a b|c'd'e|7|u</b>",
        ),
        (
            '<xacro:macro name="m" params="x:=^|1"><b>${x}</b></xacro:macro><xacro:m/>'
            '<xacro:property name="x" value="2"/><xacro:m/><xacro:call macro="m" x="3"/>',
            "<b>1</b><b>2</b><b>3</b>",
        ),
        (
            '<xacro:macro name="m" params="x:=^false y:=^"><b>${x}</b></xacro:macro>'
            '<xacro:property name="y" value="4"/><xacro:m/>'
            '<xacro:property name="x" value="2"/><xacro:m/><xacro:m x="3"/>',
            "<b>False</b><b>2</b><b>3</b>",
        ),
        (
            '<xacro:macro name="count" params="n"><b>${n}</b>'
            '<xacro:if value="${n > 1}"><xacro:count n="${n - 1}"/></xacro:if></xacro:macro>'
            '<xacro:count n="3"/>',
            "<b>3</b><b>2</b><b>1</b>",
        ),
    ],
)
def test_what_it_expands_to(tmp_path: Path, body: str, expected: str | None) -> None:
    if expected is None:
        with pytest.raises(SceneError, match="no property is called 'y'"):
            plain(tmp_path, body)
    else:
        assert plain(tmp_path, body) == expected


@pytest.mark.parametrize(
    ("body", "message"),
    [
        ("<xacro:mm/>", r"no macro is called 'mm'. Known: none"),
        (
            '<xacro:macro name="thruster"/><xacro:macro name="arm"/><xacro:trhuster/>',
            "no macro is called 'trhuster'. Did you mean 'thruster'? Known: thruster, arm",
        ),
        (
            '<xacro:macro name="thruster"/><xacro:macro name="arm"/><xacro:lamp/>',
            "no macro is called 'lamp'. Known: thruster, arm",
        ),
        (
            "".join(f'<xacro:macro name="part{i}"/>' for i in range(90)) + "<xacro:part7x/>",
            "no macro is called 'part7x'. Did you mean 'part7'? Nearest of 90: part7",
        ),
        (
            '<xacro:macro name="m" params="p"><b/></xacro:macro><xacro:m/>',
            "lacks its parameter 'p'",
        ),
        ('<xacro:macro name="m"><b/></xacro:macro><xacro:m q="1"/>', "has no parameter 'q'"),
        ('<xacro:macro name="m" params="*b"><b/></xacro:macro><xacro:m/>', "lacks its block 'b'"),
        ('<xacro:macro name="m" params="1p"><b/></xacro:macro>', "is no parameter"),
        ('<xacro:if value="maybe"/>', "neither true nor false"),
        ('<xacro:property name="x" value="${x}"/><b>${x}</b>', "refers to itself"),
        ("<b>$(env HOME)</b>", "not supported"),
        ("<b>$(arg n)</b>", "no such <xacro:arg>"),
        ('<xacro:include filename="nowhere.xacro"/>', "is not found"),
        ('<xacro:include filename="/etc/passwd"/>', "outside the searched folders"),
        ('<xacro:include filename="../../../../../../etc/passwd"/>', ""),
        ('<xacro:include filename="a.xml"/>', "nested deeper than 60 levels"),
        ('<xacro:macro name="m"><xacro:m/><xacro:m/></xacro:macro><xacro:m/>', "60 levels"),
        (
            '<xacro:macro name="m" params="n"><b/><xacro:if value="${n}"><xacro:m n="${n-1}"/>'
            '<xacro:m n="${n-1}"/></xacro:if></xacro:macro><xacro:m n="40"/>',
            "more than 50000 elements",
        ),
        (
            "".join(
                f'<xacro:property name="x{i}" value="${{x{i - 1}}}${{x{i - 1}}}"/>'
                for i in range(1, 40)
            )
            + '<xacro:property name="x0" value="ab"/><b>${x39}</b>',
            "longer than 4096 characters",
        ),
    ],
)
def test_what_is_wrong_is_an_error_with_its_line(tmp_path: Path, body: str, message: str) -> None:
    with pytest.raises(SceneError) as caught:
        expanded(tmp_path, f"\n{body}")
    assert message in str(caught.value)
    assert caught.value.diagnostics[0].line == 2


@pytest.mark.parametrize(
    "code",
    [
        "__import__('os').system('touch /tmp/x')",
        "open('/etc/passwd').read()",
        "().__class__.__bases__[0].__subclasses__()",
        "(lambda: 1)()",
        "'a' * 10**9",
        "math.__loader__",
        "f'{1}'",
        "str.format('{0.__class__}', 1)",
        "(" * 500 + "1" + ")" * 500,
        "1/0",
        "min(1, key=1)",
        "1 in 2",
    ],
)
def test_an_expression_runs_no_code(code: str) -> None:
    with pytest.raises(ExpressionError):
        evaluate(code, lambda name: 1)


def test_powers_and_large_numbers_end(tmp_path: Path) -> None:
    assert evaluate("2**10", lambda name: 0) == 1024
    assert evaluate("2**0.5", lambda name: 0) == pytest.approx(1.4142135623730951)
    with pytest.raises(ExpressionError):
        evaluate("9**9**9**9", lambda name: 0)
    assert evaluate("9**9**2", lambda name: 0) == pytest.approx(9.0**81)


VEHICLE = """<robot xmlns:xacro="http://www.ros.org/wiki/xacro" name="rov">
  <xacro:property name="width" value="0.5"/>
  <xacro:macro name="thruster" params="side y">
    <link name="${side}"/>
    <joint name="to_${side}" type="fixed"> <parent link="base"/> <child link="${side}"/>
      <origin xyz="0 ${y * width} 0"/> </joint>
  </xacro:macro>
  <link name="base"/>
  <xacro:thruster side="left" y="1"/>
  <xacro:thruster side="right" y="-1"/>
</robot>
"""
LIBRARY = """<library xmlns:xacro="http://ros.org/wiki/xacro">
  <fragment/>
  <xacro:macro name="buoy" params="name x *orientation">
    <object> <name>${name}</name> <file>objects/box.obj</file>
      <position> <x>${x}</x> <y>0</y> <z>0</z> </position>
      <xacro:insert_block name="orientation"/>
    </object>
  </xacro:macro>
</library>
"""
ODOMETRY = (
    "<rosInterfaces> <PATToROSOdom> <topic>/{0}</topic> <vehicleName>rov</vehicleName>"
    " </PATToROSOdom> </rosInterfaces>"
)
SCENE = f"""<UWSimScene xmlns:xacro="http://ros.org/wiki/xacro"
            xmlns:xi="http://www.w3.org/2001/XInclude">
  <xacro:include filename="library.xacro"/>
  <xi:include href="vehicle.xml"/>
  <xacro:buoy name="first" x="${{2*3}}">
    <orientation> <r>0</r> <p>0</p> <y>${{pi/4}}</y> </orientation>
  </xacro:buoy>
  {ODOMETRY.format("one")}
  <xi:include href="topics.xml"/>
</UWSimScene>
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "rov.urdf.xacro").write_text(VEHICLE)
    (tmp_path / "library.xacro").write_text(
        LIBRARY.replace("library", "fragment").replace("  <fragment/>\n", "")
    )
    (tmp_path / "scene.xml").write_text(SCENE)
    (tmp_path / "topics.xml").write_text(f"<UWSimScene>{ODOMETRY.format('two')}</UWSimScene>")
    (tmp_path / "vehicle.xml").write_text(
        "<vehicle> <name>rov</name> <file>rov.urdf.xacro</file> </vehicle>"
    )
    return tmp_path


def test_a_robot_in_xacro_is_read(folder: Path) -> None:
    robot = read_urdf(folder / "rov.urdf.xacro")
    assert [link.name for link in robot.links] == ["base", "left", "right"]


def test_a_scene_includes_a_vehicle_a_library_and_another_scene(folder: Path) -> None:
    scene = read_scene(folder / "scene.xml")
    assert [vehicle.name for vehicle in scene.vehicles] == ["rov"]
    (buoy,) = scene.objects
    assert (buoy.name, buoy.position[0]) == ("first", 6.0)
    assert buoy.orientation[2] == pytest.approx(0.785398)
    assert [each.topic for each in scene.ros_interfaces] == ["/one", "/two"]  # type: ignore[attr-defined]


def test_a_library_of_macros_may_have_any_root_element(folder: Path) -> None:
    """As in ROS, which drops the root of what is included."""
    library = (folder / "library.xacro").read_text()
    (folder / "library.xacro").write_text(library.replace("fragment", "root"))
    assert [thing.name for thing in read_scene(folder / "scene.xml").objects] == ["first"]


def test_what_is_included_may_be_in_a_folder_of_the_data_path(folder: Path) -> None:
    elsewhere = folder / "elsewhere"
    elsewhere.mkdir()
    (folder / "topics.xml").rename(elsewhere / "topics.xml")
    (folder / "library.xacro").rename(elsewhere / "library.xacro")
    scene = read_scene(folder / "scene.xml", data_path=(elsewhere,))
    assert [each.topic for each in scene.ros_interfaces] == ["/one", "/two"]  # type: ignore[attr-defined]
    found = [each.message for each in check_file(folder / "scene.xml", data_path=(elsewhere,))]
    assert [message for message in found if "nowhere" in message] == []
    with pytest.raises(SceneError, match=r"'library.xacro' is not found; searched: "):
        read_scene(folder / "scene.xml")


def test_errors_are_at_lines_of_the_file_that_was_written(folder: Path) -> None:
    path = folder / "scene.xml"
    path.write_text(SCENE.replace("<r>0</r>", "<r>x</r>").replace('x="${2*3}"', 'x="far"'))
    found = [(each.line, each.message) for each in check_file(path) if each.severity == "error"]
    assert [line for line, _ in found] == [5, 6]
    (folder / "library.xacro").write_text(LIBRARY.replace("${x}", "${far}"))
    path.write_text(SCENE)
    with pytest.raises(SceneError) as caught:
        read_scene(path)
    assert str(caught.value).startswith(f"{folder / 'library.xacro'}:5: ")


def test_files_without_xacro_are_left_as_they_are(tmp_path: Path) -> None:
    path = tmp_path / "a.xml"
    path.write_text("<a><b>${x}</b></a>")
    assert parse_expanded(path).root[0].text == "${x}"


def test_a_robot_may_call_macros_without_the_prefix_as_up_to_melodic(tmp_path: Path) -> None:
    robot = tmp_path / "old.urdf.xacro"
    robot.write_text(
        f'<robot name="old" {NAMESPACES}>\n<link name="base"/>\n'
        '<property name="x" value="2"/>\n'
        '<macro name="part" params="n"><link name="${n}"/><joint name="to_${n}" type="fixed">'
        '<parent link="base"/><child link="${n}"/><origin xyz="${x} 0 0"/></joint></macro>\n'
        '<xacro:macro name="link" params="name"><link name="${name}x"/></xacro:macro>\n'
        '<part n="b"/>\n<xacro:part n="c"/>\n</robot>'
    )
    spec = read_urdf(robot)
    assert [link.name for link in spec.links] == ["base", "b", "c"]
    assert spec.joints[0].position == (2.0, 0.0, 0.0)
    assert [(each.line, each.message.split(">")[0]) for each in spec.expansion.warnings] == [
        *((3, "<property"), (4, "<macro"), (6, "<part"))
    ]


def test_elements_of_other_files_are_no_macros_without_the_prefix(tmp_path: Path) -> None:
    body = '<xacro:macro name="part"><c/></xacro:macro><part/><xacro:part/>'
    assert plain(tmp_path, body) == "<part></part><c></c>"


def robot_of(folder: Path, body: str) -> etree._Element:
    path = folder / "r.urdf.xacro"
    path.write_text(f'<robot name="r" {NAMESPACES}>{body}</robot>')
    return parse_expanded(path, error=SceneError).root


@pytest.mark.parametrize("name", ["camera", "imu", "ray", "contact"])
@pytest.mark.parametrize(
    "around",
    [
        '<gazebo reference="a"><sensor>{}</sensor></gazebo>',
        "<gazebo>{}</gazebo>",
        '<gazebo><xacro:if value="1">{}</xacro:if></gazebo>',
        '<ros2_control name="c"><joint name="j">{}</joint></ros2_control>',
        "<transmission>{}</transmission>",
        '<link name="l"><sensor>{}</sensor></link>',
        "<xacro:block><w>{}</w></xacro:block>",
    ],
)
def test_sdf_in_a_robot_calls_no_macro_of_its_name(name: str, around: str, tmp_path: Path) -> None:
    content = f"<{name}><rate>5</rate></{name}>"
    macros = (
        f'<xacro:macro name="{name}" params="needed"><link name="${{needed}}"/></xacro:macro>'
        '<xacro:macro name="block" params="**b"><gazebo><xacro:insert_block name="b"/></gazebo>'
        "</xacro:macro>"
    )
    if "block" in around:
        around = around.replace("<w>", "<gazebo>").replace("</w>", "</gazebo>")
    root = robot_of(tmp_path, macros + around.format(content) + f'<{name} needed="x"/>')
    assert [each.text for each in root.iter("rate")] == ["5"]
    assert [each.get("name") for each in root.findall("link")][-1] == "x"


def test_an_element_that_is_the_block_of_a_call_is_no_call(tmp_path: Path) -> None:
    body = (
        '<xacro:macro name="imu" params="n"><link name="${n}"/></xacro:macro>'
        '<xacro:macro name="at" params="*b"><gazebo><xacro:insert_block name="b"/></gazebo>'
        "</xacro:macro><xacro:at><imu><rate>7</rate></imu></xacro:at>"
    )
    assert robot_of(tmp_path, body).findtext("gazebo/imu/rate") == "7"


def test_a_macro_without_the_prefix_is_called_in_a_link(tmp_path: Path) -> None:
    body = (
        '<xacro:macro name="round" params="m"><inertial><mass value="${m}"/></inertial>'
        '</xacro:macro><link name="a"><round m="4"/></link>'
    )
    mass = robot_of(tmp_path, body).find("link/inertial/mass")
    assert mass is not None
    assert mass.get("value") == "4"


def of_property(attributes: str) -> str:
    return f"<xacro:property {attributes}/>"


@pytest.mark.parametrize(
    ("properties", "expected"),
    [
        (('name="w" value="3"', 'name="a" value="${w}"', 'name="w" value="8"'), "8"),
        (
            ('name="w" value="3"', 'name="a" value="${w}" lazy_eval="false"', 'name="w" value="8"'),
            "3",
        ),
        (('name="a" value="4"', 'name="a" value="${a + 1}" lazy_eval="false"'), "5"),
        (
            (
                *('name="k" value="false"', 'name="w" value="3"'),
                *('name="a" value="${w}" lazy_eval="${k}"', 'name="w" value="8"'),
            ),
            "3",
        ),
        (('name="a" value="5"', 'name="a" remove="true"', 'name="a" default="3"'), "3"),
        (('name="a" value="5"', 'name="a" remove="false" default="3"'), "5"),
        (('name="p" value="a"', 'name="${p}" value="6"'), "6"),
    ],
)
@pytest.mark.parametrize("in_macro", [False, True])
def test_when_a_property_is_evaluated_or_removed(
    properties: tuple[str, ...], expected: str, in_macro: bool, tmp_path: Path
) -> None:
    body = "".join(map(of_property, properties)) + "<b>${a}</b>"
    if in_macro:
        body = f'<xacro:macro name="m">{body}</xacro:macro><xacro:m/>'
    assert plain(tmp_path, body) == f"<b>{expected}</b>"


def test_a_property_in_a_macro_is_evaluated_when_it_is_used(tmp_path: Path) -> None:
    body = (
        of_property('name="r" value="1"')
        + '<xacro:macro name="m" params="q">'
        + of_property('name="d" value="${2*r + q}"')
        + of_property('name="r" value="5"')
        + "<b>${d}</b></xacro:macro>"
        + '<xacro:m q="3"/><xacro:m q="4"/><c>${r}</c>'
    )
    assert plain(tmp_path, body) == "<b>13</b><b>14</b><c>1</c>"


@pytest.mark.parametrize("scope", ["parent", "global"])
def test_a_property_with_a_computed_name_is_set_outside_its_macro(
    scope: str, tmp_path: Path
) -> None:
    body = (
        '<xacro:macro name="size" params="p v">'
        + of_property(f'name="${{p}}_size" value="${{v}}" scope="{scope}"')
        + '</xacro:macro><xacro:size p="hand" v="2"/><xacro:size p="arm" v="4"/>'
        "<b>${arm_size - hand_size}</b>"
    )
    assert plain(tmp_path, body) == "<b>2</b>"


@pytest.mark.parametrize(
    ("attributes", "message"),
    [
        ('name="a" value="1" default="2"', "only one of value, default, remove"),
        ('name="a" value="1" remove="true"', "only one of value, default, remove"),
        ('name="a" value="1" lazy_eval="maybe"', "lazy_eval='maybe' is neither true nor false"),
        ('name="a" value="${a}"', 'lazy_eval="false"'),
    ],
)
def test_a_wrong_property_is_one_error(attributes: str, message: str, tmp_path: Path) -> None:
    with pytest.raises(SceneError) as caught:
        plain(tmp_path, of_property(attributes) + "<b>${a if 1 else 0}</b>")
    assert message in str(caught.value)
