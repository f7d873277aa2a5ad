"""The texts of underwater_sensor_msgs are an ordinary package of ROS."""

from __future__ import annotations

import json
import re
import subprocess
import xml.etree.ElementTree as ElementTree
from pathlib import Path

from tests.support.ros1_peers import PYTHON, needs_ros1
from uwsim import messages
from uwsim.messages.services import GTpublish, SpawnMarker
from uwsim.middleware.types import service_of, wire_service, wire_type

PACKAGE = Path(messages.__file__).parent / "underwater_sensor_msgs"
CMAKE = (PACKAGE / "CMakeLists.txt").read_text()
TEXTS = sorted([*PACKAGE.glob("msg/*.msg"), *PACKAGE.glob("srv/*.srv")])
FIELD_OF_ROS2 = re.compile(r"(?!.*__)(?!.*_$)[a-z][a-z0-9_]*")
GENMSG = """
import json, sys
from pathlib import Path
from genmsg import MsgContext, gentools, msg_loader
from std_msgs.msg import Header
from visualization_msgs.msg import Marker

folder, others, found = Path(sys.argv[1]), Path(sys.argv[2]), {}
search = {"underwater_sensor_msgs": [str(folder / "msg")]}
for kind in (Marker, Header):  # Debian has their texts in the classes only
    first, *inner = kind._full_text.split("=" * 80)
    parts = {kind._type: first}
    for part in inner:
        name, _, text = part.strip().partition("\\n")
        parts[name.removeprefix("MSG: ")] = text
    for name, text in parts.items():
        package, _, base = name.partition("/")
        path = others / package / "msg" / f"{base}.msg"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        search[package] = [str(path.parent)]
for path in [*folder.glob("msg/*.msg"), *folder.glob("srv/*.srv")]:
    context = MsgContext.create_default()
    load = {".msg": msg_loader.load_msg_from_file, ".srv": msg_loader.load_srv_from_file}
    spec = load[path.suffix](context, str(path), f"underwater_sensor_msgs/{path.stem}")
    msg_loader.load_depends(context, spec, search)
    found[path.stem] = gentools.compute_md5(context, spec)
print(json.dumps(found))
"""


def listed_files(name: str) -> list[str]:
    """The files that a variable of the CMake file lists."""
    actual = re.search(rf"set\({name} ([^)]*)\)", CMAKE)
    assert actual is not None
    return actual[1].split()


def test_every_text_is_listed_for_the_build() -> None:
    assert listed_files("MESSAGES") == sorted(path.name for path in PACKAGE.glob("msg/*"))
    assert listed_files("SERVICES") == sorted(path.name for path in PACKAGE.glob("srv/*"))


def test_ros_2_gets_all_but_those_whose_names_it_refuses() -> None:
    left_out = re.findall(r"list\(REMOVE_ITEM \w+ (\S+)\)", CMAKE)
    refusals = []
    for path in TEXTS:
        lines = [line.partition("#")[0].split() for line in path.read_text().splitlines()]
        fields = [words[1] for words in lines if len(words) == 2]
        if not all(FIELD_OF_ROS2.fullmatch(field) for field in fields):
            refusals.append(path.name)
    assert left_out == refusals


def test_the_manifest_names_the_package_and_all_that_its_texts_need() -> None:
    root = ElementTree.parse(PACKAGE / "package.xml").getroot()
    assert (root.tag, root.get("format")) == ("package", "3")
    assert root.findtext("name") == PACKAGE.name
    assert f"project({PACKAGE.name})" in CMAKE
    packages = {
        match[1] for path in TEXTS for match in re.finditer(r"^(\w+)/\w+", path.read_text(), re.M)
    }
    assert packages <= {entry.text for entry in root.findall("depend")}
    tools = {(entry.text, entry.get("condition")) for entry in root.findall("buildtool_depend")}
    assert ("catkin", "$ROS_VERSION == 1") in tools
    assert ("ament_cmake", "$ROS_VERSION == 2") in tools
    for package in packages:
        assert CMAKE.count(package) >= 3


@needs_ros1
def test_the_generator_of_ros_1_reads_the_texts_and_has_our_sums(tmp_path: Path) -> None:
    command = [PYTHON, "-c", GENMSG, str(PACKAGE), str(tmp_path)]
    completed_process = subprocess.run(command, capture_output=True, text=True, timeout=200, env={})
    assert completed_process.returncode == 0, completed_process.stderr
    sums = json.loads(completed_process.stdout)
    for kind in (messages.DVL, messages.LedLight, messages.Pressure):
        actual = wire_type(kind)
        assert actual is not None
        assert sums.pop(kind.__name__) == actual.md5
    for request in (GTpublish, SpawnMarker):
        service = service_of(request)
        assert service is not None
        assert sums.pop(request.__name__) == wire_service(service).md5
    assert not sums
