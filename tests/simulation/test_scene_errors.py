"""Names of what is simulated are looked up before anything is, and said with their lines."""

from pathlib import Path

import pytest

from tests.simulation.girona500 import SCENE
from tests.support.opened import open_scene
from uwsim.checks import check_file
from uwsim.errors import SceneError
from uwsim.scene.reader import read_scene

TEXT = SCENE.read_text()
DYNAMICS = "<u:dynamics>g500_physical</u:dynamics>"
END = "  </rosInterfaces>"
WAYS = {
    "a thruster": (
        DYNAMICS,
        f"{DYNAMICS}\n<u:fault> <u:thruster>swayy</u:thruster> </u:fault>",
        "No thruster is called 'swayy'. Did you mean 'sway'?",
    ),
    "a fault that ends before it begins": (
        DYNAMICS,
        f"{DYNAMICS} <u:fault> <u:thruster>sway</u:thruster> </u:fault>\n<u:fault> "
        "<u:thruster>sway</u:thruster> <u:start>9</u:start> <u:end>3</u:end> </u:fault>",
        "<u:fault> ends at 3 s and begins at 9 s",
    ),
    "a fault of a vehicle that is not simulated": (
        DYNAMICS,
        "\n<u:fault> <u:thruster>sway</u:thruster> </u:fault>",
        "the vehicle 'girona500' has no <u:dynamics>",
    ),
    "a set": (
        DYNAMICS,
        "\n<u:dynamics>g500_fysical</u:dynamics>",
        "No hydrodynamics set is called 'g500_fysical'. Did you mean 'g500_physical'?",
    ),
    "thruster commands for nobody": (
        END,
        "\n<u:ROSThrustersToPAT> <u:topic>/a</u:topic> <u:vehicleName>girona50</u:vehicleName> "
        f"</u:ROSThrustersToPAT>{END}",
        "no vehicle is called 'girona50'. Did you mean 'girona500'?",
    ),
    "angles of fins that it has not": (
        END,
        "\n<u:ROSFinsToPAT> <u:topic>/a</u:topic> <u:vehicleName>girona500</u:vehicleName> "
        f"</u:ROSFinsToPAT>{END}",
        "the hydrodynamics file of the vehicle 'girona500' has no <fin>",
    ),
    "two kinds of messages on a topic": (
        END,
        "\n<u:ROSWrenchToPAT> <u:topic>dataNavigator</u:topic> "
        f"<u:vehicleName>girona500</u:vehicleName> </u:ROSWrenchToPAT>{END}",
        "'dataNavigator' carries geometry_msgs/msg/WrenchStamped, but "
        "geometry_msgs/msg/TwistStamped of <ROSTwistToPAT>",
    ),
    "a field that is not there": (
        "<oceanState>",
        "<oceanState> <u:current>\n<u:field> <u:file>fjord.nc</u:file> </u:field> </u:current>",
        "'fjord.nc' is in none of the folders searched",
    ),
}


@pytest.mark.parametrize("way", WAYS)
def test_a_name_that_leads_nowhere_is_reported_with_its_line(way: str, tmp_path: Path) -> None:
    old, new, said = WAYS[way]
    assert TEXT.count(old) == 1
    changed = TEXT.replace(old, new)
    line = changed[: changed.index(new) + new.index("\n") + 1].count("\n") + 1
    path = tmp_path / "scene.xml"
    path.write_text(changed)
    diagnostics = [diagnostic for diagnostic in check_file(path) if diagnostic.severity == "error"]
    assert [(diagnostic.file, diagnostic.line) for diagnostic in diagnostics] == [(str(path), line)]
    assert said in diagnostics[0].message
    with pytest.raises(SceneError) as caught:
        open_scene(read_scene(path), is_blind=True)
    assert caught.value.diagnostics == tuple(diagnostics)


def test_a_wrong_hydrodynamics_file_is_reported_with_its_own_lines(tmp_path: Path) -> None:
    (tmp_path / "mine.xml").write_text(
        '<hydrodynamics name="mine">\n<body link="base_lnk"> <mass>1</mass> </body>\n'
        '<joint name="Elbo"> <efficiency>0.5</efficiency> </joint>\n</hydrodynamics>'
    )
    path = tmp_path / "scene.xml"
    path.write_text(TEXT.replace("g500_physical", "mine"))
    diagnostics = [
        str(diagnostic) for diagnostic in check_file(path) if diagnostic.severity == "error"
    ]
    assert [diagnostic.rpartition("mine.xml")[2][:3] for diagnostic in diagnostics] == [
        ":2:",
        ":3:",
    ]
    assert "Did you mean 'base_link'?" in diagnostics[0]
    assert "Did you mean 'Elbow'?" in diagnostics[1]


def test_a_set_that_is_not_named_as_its_file_is_a_warning(tmp_path: Path) -> None:
    (tmp_path / "mine.xml").write_text(
        '<hydrodynamics name="other">\n<body link="base_link"> <mass>180</mass> '
        "<volume>0.18</volume> </body></hydrodynamics>"
    )
    path = tmp_path / "scene.xml"
    path.write_text(TEXT.replace("g500_physical", "mine"))
    (said,) = [
        diagnostic for diagnostic in check_file(path) if "the set is called" in diagnostic.message
    ]
    assert (said.file, said.line, said.severity) == (str(tmp_path / "mine.xml"), 1, "warning")
    assert said.message.endswith("'other'; scenes find it by the name of its file, 'mine'")


def test_dynamics_that_name_no_set_are_an_error(tmp_path: Path) -> None:
    path = tmp_path / "scene.xml"
    path.write_text(TEXT.replace("g500_physical", " "))
    (diagnostic,) = [
        str(diagnostic) for diagnostic in check_file(path) if diagnostic.severity == "error"
    ]
    assert "<u:dynamics> is empty; expected text" in diagnostic


@pytest.mark.parametrize("element", ["ForceSensor", "u:lamp"])
def test_a_device_on_no_link_is_refused_with_its_line(tmp_path: Path, element: str) -> None:
    parts = {
        "ForceSensor": "<name>f</name> <target>part9</target> "
        "<offsetp> <x>0</x> <y>0</y> <z>0</z> </offsetp> "
        "<offsetr> <x>0</x> <y>0</y> <z>0</z> </offsetr>",
        "u:lamp": "<u:name>f</u:name> <u:relativeTo>part9</u:relativeTo>",
    }
    device = f"\n<{element}> {parts[element]} </{element}>\n</vehicle>"
    path = tmp_path / "scene.xml"
    path.write_text(TEXT.replace("</vehicle>", device, 1))
    line = path.read_text().splitlines().index(device.splitlines()[1]) + 1
    with pytest.raises(SceneError, match="No link is called 'part9'") as caught:
        open_scene(read_scene(path))
    (diagnostic,) = caught.value.diagnostics
    assert diagnostic.line == line
    assert diagnostic.message.startswith(f"<{element}>: ")


def test_all_are_reported_at_once(tmp_path: Path) -> None:
    changed = TEXT
    for way in ("a thruster", "thruster commands for nobody", "a field that is not there"):
        changed = changed.replace(*WAYS[way][:2])
    path = tmp_path / "scene.xml"
    path.write_text(changed)
    assert (
        len([diagnostic for diagnostic in check_file(path) if diagnostic.severity == "error"]) == 3
    )


def test_a_field_is_read_by_a_check_but_the_users_function_only_looked_for(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "my_wild_water_of_the_tests.py").write_text("1 / 0")
    monkeypatch.syspath_prepend(tmp_path)
    (tmp_path / "field.csv").write_text("x,y,u\n1,2,3\n")
    field = "<u:field> <u:file>field.csv</u:file> </u:field>"
    name = "my_wild_water_of_the_tests"
    function = f"<u:pythonFunction> <u:function>{name}:eddy</u:function> </u:pythonFunction>"
    path = tmp_path / "scene.xml"
    both = f"<oceanState> <u:current> {function}\n{field} </u:current>"
    text = TEXT.replace("<oceanState>", both)
    path.write_text(text)
    (diagnostic,) = [
        diagnostic for diagnostic in check_file(path) if diagnostic.severity == "error"
    ]
    assert "expected u and v" in diagnostic.message
    assert "u:field" in text.splitlines()[(diagnostic.line or 0) - 1]
    path.write_text(text.replace(name, "nowhere"))
    diagnostic, _ = [
        diagnostic for diagnostic in check_file(path) if diagnostic.severity == "error"
    ]
    assert "there is no module 'nowhere' on Python's path" in diagnostic.message
    assert "u:pythonFunction" in text.splitlines()[(diagnostic.line or 0) - 1]


@pytest.mark.slow
def test_the_bundled_scenes_have_no_such_error() -> None:
    for path in sorted(SCENE.parent.glob("*scene.xml")):
        assert [
            diagnostic for diagnostic in check_file(path) if diagnostic.severity == "error"
        ] == []


def test_a_mesh_of_too_many_faces_is_reported_before_a_run_refuses_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("uwsim.model.collision.shapes.MAX_PLATES", 3)
    (tmp_path / "tent.obj").write_text(
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 1 3 4\nf 2 3 4\n"
    )
    rock = (
        "<object> <name>rock</name> <file>tent.obj</file> <position><x>50</x><y>0</y>"
        "<z>0</z></position>\n"
        "<physics> <mass>0</mass> <collisionShapeType>trimesh</collisionShapeType> </physics>"
        "</object></UWSimScene>"
    )
    scene = tmp_path / "scene.xml"
    scene.write_text(SCENE.read_text().replace("</UWSimScene>", rock))
    line = scene.read_text().partition("<physics> <mass>0</mass>")[0].count("\n") + 1
    [said] = [diagnostic for diagnostic in check_file(scene) if diagnostic.line == line]
    assert "'tent.obj' as a fixed trimesh has 4 plates; expected at most 3" in said.message
