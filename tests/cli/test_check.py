"""``uwsim check``: 0 without errors, 2 with, every error on its own line."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from uwsim.cli import main

DATA = Path(__file__).parents[2] / "src" / "uwsim" / "data"


def status(*words: str) -> int:
    return main(["check", *words])


def test_a_file_without_errors_is_status_0(capsys: pytest.CaptureFixture[str]) -> None:
    assert status(str(DATA / "scenes" / "cirs.xml"), str(DATA / "scenes" / "g500ARM5.urdf")) == 0
    said = capsys.readouterr().out
    assert "read, not simulated yet: waves" in said
    assert said.count(": no errors") == 2


def test_errors_are_status_2_and_all_are_reported(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "scene.xml"
    file.write_text(
        "<UWSimScene>\n<vehicel/>\n<simParams><lightRate>wide</lightRate></simParams></UWSimScene>"
    )
    assert status(str(file), str(tmp_path / "nothing.xml")) == 2
    said = capsys.readouterr().out.splitlines()
    assert said[0] == (
        f"{file}:2: <vehicel> is not an element of <UWSimScene>. Did you mean vehicle?"
    )
    assert said[1] == f"{file}:3: <lightRate> is 'wide'; expected a number >= 0 and <= 1e+06 [1]"
    assert f"{file}: 2 errors" in said
    assert any("there is no such file" in line for line in said)


def test_strict_holds_a_scene_against_the_originals_order(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "scene.xml"
    file.write_text("<UWSimScene><simParams/><oceanState/></UWSimScene>")
    assert status(str(file)) == 0
    assert status(str(file), "--strict") == 2
    assert "<oceanState> comes after <simParams>" in capsys.readouterr().out


def test_a_root_that_nobody_knows_says_what_was_expected(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "page.xml"
    file.write_text("<html/>")
    assert status(str(file)) == 2
    said = capsys.readouterr().out
    assert "expected <UWSimScene>, <benchmark>, <robot>, <hydrodynamics> or <suite>" in said


CHECK = """
import resource
import sys
import time
from pathlib import Path
from uwsim.checks import check_file
small, hostile = map(Path, sys.argv[1:])
assert check_file(small)  # now all is mapped that checking takes, however much that is here
mapped = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
resource.setrlimit(resource.RLIMIT_AS, (mapped + 200 * 2**20,) * 2)
until = int(time.process_time()) + 10  # 2 s are promised; no timed unit test
resource.setrlimit(resource.RLIMIT_CPU, (until, until))
assert check_file(hostile)
# the peak of this program: ru_maxrss would be that of the process that started it, if larger
status = dict(line.split(":", 1) for line in Path("/proc/self/status").read_text().splitlines())
assert int(status["VmHWM"].split()[0]) < 500 * 2**10
"""
UNKNOWN = b"".join(b"<oops%d/>" % i for i in range(49_000))
CAMERAS = b"".join(
    b"<virtualCamera><name>c%d</name><relativeTo>p%d</relativeTo></virtualCamera>" % (i, i)
    for i in range(16_000)
)
VEHICLE = b"<vehicle><name>v</name><file>data/scenes/g500ARM5.urdf</file>%s</vehicle>"


@pytest.mark.slow
@pytest.mark.parametrize(
    "inside",
    [
        UNKNOWN,
        VEHICLE % CAMERAS,
        b"<oceanState><windx>" + b"1" * 9_900_000 + b"</windx></oceanState>",
        b"<a/>" * 4_000_000,
        b"<a " + b" ".join(b"a%d=''" % i for i in range(90_000)) + b"/>",
        b"<a>" * 250 + b"&amp;" * 90_000 + b"</a>" * 250,
    ],
    ids=["unknown", "cameras", "text", "elements", "attributes", "deep"],
)
def test_a_hostile_file_costs_little_time_and_less_than_500_mb(
    inside: bytes, tmp_path: Path
) -> None:
    small, file = tmp_path / "small.xml", tmp_path / "scene.xml"
    small.write_bytes(b"<UWSimScene><oops/>" + VEHICLE % b"" + b"</UWSimScene>")
    file.write_bytes(b"<UWSimScene>" + inside + b"</UWSimScene>")
    assert file.stat().st_size <= 16 * 2**20
    subprocess.run(
        [sys.executable, "-c", CHECK, str(small), str(file)],
        env={**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"},
        check=True,
    )


def test_a_robot_that_is_nowhere_is_told_the_nearest_bundled_one(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "scene.xml"
    file.write_text(
        "<UWSimScene>\n<vehicle> <name>v</name>\n<file>data/scenes/g500_ARM5.urdf</file> </vehicle>"
        "</UWSimScene>"
    )
    assert status(str(file)) == 2
    said = capsys.readouterr().out
    assert f"{file}:2: robot file 'data/scenes/g500_ARM5.urdf' is not found, and no bundled" in said
    assert "Did you mean g500ARM5.urdf? Searched: " in said


def test_a_mesh_that_is_nowhere_is_reported_at_its_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "rov.urdf"
    file.write_text(
        '<robot name="rov">\n<link name="base_link">\n<visual> <geometry>\n'
        '<mesh filename="package://my_rov/meshes/hull.dae"/> </geometry> </visual>\n</link></robot>'
    )
    assert status(str(file)) == 0
    said = capsys.readouterr().out
    assert f"{file}:3: warning: there is no model 'package://my_rov/meshes/hull.dae'" in said


def test_names_of_a_benchmark_that_its_scene_does_not_have_are_errors(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = (DATA / "benchmarks" / "visibility.xml").read_text()
    text = text.replace("<camera>bowtech1", "<camera>bowtec", 1).replace(
        "<target>blackbox", "<target>blakbox"
    )
    file = tmp_path / "wrong.xml"
    file.write_text(text.replace('u:algorithm="esm"', 'u:algorithm="emm"'))
    assert status(str(file)) == 2
    said = capsys.readouterr().out
    assert "No virtual camera is called 'bowtec'. Did you mean 'bowtech1'?" in said
    assert "No body is called 'blakbox'. Did you mean 'blackbox'?" in said
    assert "No algorithm is called 'emm'. Did you mean 'esm'?" in said
    assert f"{file}:10: No virtual camera" in said


def test_a_wrong_name_is_reported_at_each_of_its_lines(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = (DATA / "benchmarks" / "visibility.xml").read_text()
    file = tmp_path / "wrong.xml"
    file.write_text(text.replace("<target>blackbox", "<target>blakbox"))
    lines = [n for n, line in enumerate(file.read_text().splitlines(), 1) if "blakbox" in line]
    assert len(lines) > 1
    assert status(str(file)) == 2
    said = capsys.readouterr().out
    assert all(f"{file}:{n}: No body is called 'blakbox'" in said for n in lines)


def test_names_of_a_benchmark_are_looked_up_next_to_its_other_errors(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = (DATA / "benchmarks" / "visibility.xml").read_text()
    text = text.replace("<camera>bowtech1", "<camera>bowtec", 1).replace(
        ">corners+centroid<", ">corners+middle<"
    )
    text = text.replace("<type>service</type>", "<type>onStart</type>")  # that of the benchmark
    file = tmp_path / "wrong.xml"
    file.write_text(text)
    assert status(str(file)) == 2
    said = capsys.readouterr().out
    assert f"{file}:10: No virtual camera is called 'bowtec'. Did you mean 'bowtech1'?" in said
    assert "no measure is called 'middle'" in said
    assert "<type> is 'onStart'; expected one of" in said
    assert "3 errors" in said
    assert "no level will ever begin" not in said  # it is not known when one will


def test_a_benchmark_whose_scene_is_nowhere_is_an_error(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = (DATA / "benchmarks" / "visibility.xml").read_text()
    file = tmp_path / "wrong.xml"
    file.write_text(text.replace("visibility-scene.xml", "nope.xml"))
    assert status(str(file)) == 2
    assert "'nope.xml' is neither a file nor one of the bundled scenes" in capsys.readouterr().out


def test_bundled_files_are_checked_by_their_bare_names() -> None:
    assert status("visibility-scene", "visibility", "--scene", "visibility-scene") == 0


def test_a_side_file_is_checked_by_itself(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "mine.xml"
    path.write_text(
        '<hydrodynamics name="mine">\n<body link="hull"/>\n'
        '<thruster name="t" link="hull"> <forward>0 -40</forward> </thruster>\n</hydrodynamics>'
    )
    assert status(str(path)) == 2
    assert capsys.readouterr().out.startswith(f"{path}:3: thruster 't': forward gives -40 N")
    path.write_text(path.read_text().replace("-40", "40"))
    assert status(str(path)) == 0


GHOSTLY = """<UWSimScene xmlns:u="urn:uwsim:1">
<vehicle> <name>rov</name> <file>bluerov2_heavy.urdf</file>
<position> <x>0</x> <y>0</y> <z>-2</z> </position>
<orientation> <r>M_PI</r> <p>0</p> <y>0</y> </orientation>
<u:dynamics>bluerov2_heavy</u:dynamics> </vehicle>
<vehicle> <name>other</name> <file>bluerov2_heavy.urdf</file> </vehicle>
<object> <name>wreck</name> <file>objects/ship.osg</file> </object>
<object> <name>terrain</name> <file>terrain/islands/islands.osg</file>
<position> <x>0</x> <y>0</y> <z>-15</z> </position> </object>
</UWSimScene>"""


def test_what_a_vehicle_can_pass_through_is_named_until_the_file_says_that_it_is_meant(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "scene.xml"
    file.write_text(GHOSTLY)
    assert status(str(file)) == 0
    said = capsys.readouterr().out
    assert (
        f"{file}:7: warning: vehicles with dynamics pass through objects without <physics>: 'wreck'"
        in said
    )
    assert f"{file}:6: warning: vehicle 'other': vehicles with dynamics pass through it" in said
    assert "'terrain'" not in said
    file.write_text(
        GHOSTLY.replace("osg</file> </object>\n<object>", "osg</file> <u:solid>0</u:solid> "
                        "</object>\n<object>")
        .replace("urdf</file> </vehicle>", "urdf</file> <u:accept>passable</u:accept> </vehicle>")
    )  # fmt: skip
    assert status(str(file)) == 0
    assert "pass through" not in capsys.readouterr().out


LOOSE = """<UWSimScene xmlns:u="urn:uwsim:1">
<simParams> <enablePhysics>1</enablePhysics> </simParams>
<object> <name>seabed</name> <file>terrain/islands/islands.osg</file> </object>
<object> <name>box</name> <file>objects/ship.osg</file>
<physics> <mass>5</mass> <collisionShapeType>box</collisionShapeType> </physics> </object>
</UWSimScene>"""


def test_scenery_that_the_originals_physics_moves_is_named(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "scene.xml"
    for scene, is_named in [
        (LOOSE, True),
        (LOOSE.replace("seabed", "terrain"), False),
        (LOOSE.replace("islands.osg</file>", "islands.osg</file> <u:solid>1</u:solid>"), False),
        (LOOSE.replace("<physics>", "<!--").replace("</physics>", "-->"), False),
        (LOOSE.replace("<enablePhysics>1", "<enablePhysics>0"), False),
    ]:
        file.write_text(scene)
        assert status(str(file)) == 0
        said = f"{file}:3: warning: an object without <physics> is a loose box of 1 kg"
        assert (said in capsys.readouterr().out) is is_named


def test_a_data_path_that_is_no_folder_is_an_error(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "scene.xml"
    file.write_text(LOOSE)
    gone = tmp_path / "gone"
    assert status("--data-path", str(gone), "--data-path", str(file), str(file)) == 2
    said = capsys.readouterr().err
    assert f"--data-path {gone}: there is no such folder." in said
    assert f"--data-path {file}: is no folder." in said
    assert status("--data-path", str(tmp_path), str(file)) == 0


def test_a_vehicle_without_any_shape_is_named(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "bare.urdf").write_text('<robot name="bare"> <link name="base_link"/> </robot>')
    file = tmp_path / "scene.xml"
    file.write_text(GHOSTLY.replace("bluerov2_heavy.urdf", "bare.urdf", 1))
    status(str(file))
    assert "passes through everything: no link has a <collision>" in capsys.readouterr().out


def test_json_says_the_same_to_programs(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "a.xml"
    file.write_text(
        "<UWSimScene>\n<oceanState>\n<fog>\x7f</fog></oceanState><nedOrigin/></UWSimScene>"
    )
    assert main(["check", str(file), "visibility"]) == 2
    lines = capsys.readouterr().out.splitlines()
    assert main(["check", "--json", str(file), "visibility"]) == 2
    said = json.loads(capsys.readouterr().out)
    first, second = said["files"]
    assert second["diagnostics"] == []
    assert said["n_errors"] == sum(f["severity"] == "error" for f in first["diagnostics"]) > 0
    assert (
        f"{file}:{first['diagnostics'][0]['line']}: {first['diagnostics'][0]['message']}"
        in lines[0]
    )


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ('<UWSimScene xmlns:u="urn:uwsim:2"><u:vary/></UWSimScene>', "xmlns:u='urn:uwsim:1'"),
        ("<UWSimScene><u:vary/></UWSimScene>", 'write <UWSimScene xmlns:u="urn:uwsim:1">'),
        ('<UWSimScene xmlns="urn:uwsim:1"/>', "write xmlns:u="),
    ],
)
def test_a_wrong_namespace_names_the_right_one(
    text: str, expected: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "scene.xml"
    file.write_text(text)
    assert status(str(file)) == 2
    assert expected in capsys.readouterr().out


@pytest.mark.parametrize("root", ["robot", "UWSimScene", "library", "root"])
@pytest.mark.parametrize(
    "extra",
    [
        "",
        '<xacro:property name="a" value="1"/><xacro:arg name="b"/>',
        '<material name="grey"><color rgba="1 1 1 1"/></material>',
    ],
)
def test_a_library_of_macros_is_stated_to_be_one(
    root: str, extra: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "parts.xacro"
    macros = "".join(f'<xacro:macro name="{name}"><link/></xacro:macro>' for name in ("fin", "pod"))
    xmlns = 'xmlns:xacro="http://www.ros.org/wiki/xacro"'
    file.write_text(f"<{root} {xmlns}><!-- parts -->{extra}{macros}</{root}>")
    assert status(str(file)) == 0
    said = capsys.readouterr().out
    assert "warning: a library of xacro macros: fin, pod. It contains nothing to simulate" in said
    file.write_text(f'<robot {xmlns}>{macros}<link name="a"/></robot>')
    assert status(str(file)) == 0
    assert "library of xacro" not in capsys.readouterr().out


def test_so_is_one_of_properties(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "params.xacro"
    xmlns = 'xmlns:xacro="http://www.ros.org/wiki/xacro"'
    file.write_text(f'<robot {xmlns}><xacro:property name="mass" value="2"/></robot>')
    assert status(str(file)) == 0
    assert "a library of xacro properties: mass. " in capsys.readouterr().out


def test_a_library_with_an_error_has_that_error(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "parts.xacro"
    xmlns = 'xmlns:xacro="http://www.ros.org/wiki/xacro"'
    macro = '<xacro:macro name="fin"/>\n<xacro:include filename="no.xacro"/>'
    file.write_text(f"<robot {xmlns}>{macro}</robot>")
    assert status(str(file)) == 2
    assert "parts.xacro:2: the file 'no.xacro' is not found" in capsys.readouterr().out
