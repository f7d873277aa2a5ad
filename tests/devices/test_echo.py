"""The echo device publishes its text."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.opened import open_scene
from uwsim.scene.reader import read_scene

SCENE = """<UWSimScene>
  <vehicle> <name>g500</name> <file>g500ARM5.urdf</file>
    <jointValues> <joint>0</joint> <joint>0</joint> <joint>0</joint> <joint>0</joint>
      <joint>0</joint> </jointValues>
    <simulatedDevices>
      <echo> <name>one</name> <info>I am here</info> </echo>
      <echo> <name>two</name> <info></info> </echo>
    </simulatedDevices>
  </vehicle>
  <rosInterfaces> {} </rosInterfaces>
</UWSimScene>
"""
ONE = "<echoROS> <name>one</name> <topic>/one</topic> <rate>2</rate> </echoROS>"
TWO = "<echoROS> <name>two</name> <topic>/two</topic> <rate>2</rate> </echoROS>"


@pytest.mark.parametrize(
    "interfaces", [ONE, f"<SimulatedDeviceROS>{ONE}</SimulatedDeviceROS>"], ids=["alone", "wrapped"]
)
def test_an_echo_publishes_its_text(tmp_path: Path, interfaces: str) -> None:
    path = tmp_path / "scene.xml"
    path.write_text(SCENE.format(interfaces))
    with open_scene(read_scene(path), is_blind=True) as simulation:
        simulation.latest_message("/one")
        simulation.advance(0.01)
        assert simulation.latest_message("/one").data == "I am here"


def test_one_without_text_is_left_out(tmp_path: Path) -> None:
    path = tmp_path / "scene.xml"
    path.write_text(SCENE.format(ONE + TWO))
    with open_scene(read_scene(path), is_blind=True) as simulation:
        assert "two" not in simulation.topics
