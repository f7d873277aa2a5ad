"""docs/sensors.md says what is simulated and what is not, as the code has it."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from scripts.reference.sensor_tables import fill_tables
from uwsim import messages
from uwsim.checks import check_file
from uwsim.devices import DEVICES
from uwsim.scene.unsupported import UNSIMULATED_ELEMENTS, describe_limitation
from uwsim.schema.names import prefixed_name
from uwsim.sensors import SENSORS
from uwsim.topics import INTERFACES
from uwsim.topics.sensor_topic import SensorToROSSpec

PAGE = (Path(__file__).parents[2] / "docs" / "sensors.md").read_text()
SIMULATED, REST = PAGE.split("\n## Read, not simulated\n")
SCENE = """<UWSimScene xmlns:u="urn:uwsim:1">
  <vehicle> <name>girona500</name> <file>g500ARM5.urdf</file>
    <jointValues> {} </jointValues> {} </vehicle>
  <rosInterfaces> {} </rosInterfaces>
</UWSimScene>"""


def test_the_tables_are_what_the_code_says() -> None:
    assert fill_tables(PAGE) == PAGE, "run scripts/docs"


def test_a_table_without_rows_is_a_word(monkeypatch: pytest.MonkeyPatch) -> None:
    empty = "<!-- table: sensors-read-only -->\n<!-- end of table -->"
    assert fill_tables(empty) == empty.replace("\n", "\nNone.\n")
    monkeypatch.setitem(UNSIMULATED_ELEMENTS, ("vehicle", "dvlSensor"), "dvlSensor")
    assert "| [`<dvlSensor>`]" in fill_tables(empty)


@pytest.mark.parametrize("name", [*SENSORS, *DEVICES])
def test_every_sensor_and_device_is_in_the_half_that_is_true(name: str) -> None:
    part = REST if describe_limitation("vehicle", name) else SIMULATED
    other = SIMULATED if part is REST else REST
    assert f"| [`<{prefixed_name(name)}>`]" in part
    assert f"| [`<{prefixed_name(name)}>`]" not in other


def test_every_simulated_publisher_has_its_message_and_its_own_paragraph() -> None:
    prose = re.sub(r"<!-- table.*?<!-- end of table -->", "", SIMULATED, flags=re.DOTALL)
    for tag, spec in INTERFACES.items():
        summary = (spec.__doc__ or "").split("\n")[0]
        if summary.startswith("Publishes") and not describe_limitation("rosInterfaces", tag):
            assert f"<{prefixed_name(tag)}>" in prose, tag
            if spec is SensorToROSSpec:  # its message is that of the sensor that it names
                continue
            (package, message) = re.findall(r"as (\w+)/(\w+)", summary)[0]
            assert hasattr(messages, message), message
            assert f"`{package}/{message}`" in prose, message


def test_the_camera_of_the_page_is_one_that_a_scene_can_have(tmp_path: Path) -> None:
    camera, topic, *_ = re.findall(r"^```xml\n(.*?)^```", PAGE, re.MULTILINE | re.DOTALL)
    scene = tmp_path / "scene.xml"
    scene.write_text(SCENE.format(5 * "<joint>0</joint>", camera, topic))
    assert [
        str(diagnostic) for diagnostic in check_file(scene) if diagnostic.severity == "error"
    ] == []
