"""Segmentation on a topic: the body of each pixel, a legend of all numbers, recordings."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory

from tests.support.opened import open_scene
from uwsim.checks import check_file
from uwsim.messages import Image
from uwsim.middleware.recording.recorder import ImageStorage, Recorder
from uwsim.scene.reader import read_scene

CUBE = (
    "".join(f"v {x} {y} {z}\n" for x in (-0.2, 0.2) for y in (-0.2, 0.2) for z in (-0.2, 0.2))
    + "f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n"
)
SCENE = """<UWSimScene xmlns:u="urn:uwsim:1">
  <oceanState> <fog> <density>3</density> </fog> </oceanState>
  <vehicle>
    <name>rov</name> <file>bluerov2_heavy.urdf</file>
    <position> <x>0</x> <y>0</y> <z>-2</z> </position>
    <{kind}> <name>eye</name> <relativeTo>base_link</relativeTo> <resw>40</resw> <resh>30</resh>
      <position> <x>0.5</x> <y>0</y> <z>0</z> </position> <u:lookAt>forward</u:lookAt> </{kind}>
  </vehicle>
  <object> <name>left</name> <file>cube.obj</file>
    <position> <x>2.5</x> <y>0.4</y> <z>-2</z> </position> </object>
  <object> <name>right</name> <file>cube.obj</file>
    <position> <x>3</x> <y>-0.5</y> <z>-2</z> </position> </object>
  <object> <name>behind</name> <file>cube.obj</file>
    <position> <x>-3</x> <y>0</y> <z>-2</z> </position> </object>
  <rosInterfaces>
    <u:segmentationToROS> <cameraName>eye</cameraName> <imageTopic>/seg</imageTopic>
      <legendTopic>/legend</legendTopic> <rate>20</rate> </u:segmentationToROS>
  </rosInterfaces>
</UWSimScene>"""


def scene_file(folder: Path, kind: str = "virtualCamera") -> Path:
    (folder / "cube.obj").write_text(CUBE)
    path = folder / "scene.xml"
    path.write_text(SCENE.format(kind=kind))
    return path


def labels(message: Image) -> np.ndarray:
    assert (message.encoding, message.step) == ("16UC1", 2 * message.width)
    found: np.ndarray = message.data.view("<u2").reshape(message.height, message.width)
    return found


@pytest.mark.parametrize("kind", ["virtualCamera", "virtualRangeImage"])
@pytest.mark.parametrize("is_blind", [False, True])
def test_each_pixel_has_the_number_of_its_body_and_the_legend_names_all(
    tmp_path: Path, kind: str, is_blind: bool
) -> None:
    """Also in fog through which nothing is seen, and of what is out of view."""
    path = scene_file(tmp_path, kind)
    assert [each for each in check_file(path) if each.severity == "error"] == []
    with open_scene(read_scene(path), is_blind=is_blind) as simulation:
        simulation.latest_message("/seg")
        simulation.latest_message("/legend")
        simulation.advance(0.1)
        numbers = labels(simulation.latest_message("/seg"))
        legend = json.loads(simulation.latest_message("/legend").data)
    names = {name: int(number) for number, name in legend.items()}
    assert {"", "left", "right", "behind", "rov/base_link"} <= set(names)
    assert names[""] == 0
    assert numbers.shape == (30, 40)
    assert {legend[str(number)] for number in np.unique(numbers)} == {"", "left", "right"}
    columns = {name: np.argwhere(numbers == names[name])[:, 1].mean() for name in ("left", "right")}
    assert columns["left"] < 15.0
    assert columns["right"] > 25.0


@pytest.mark.parametrize(("images", "n_images"), [("raw", 4), ("png", 4), ("none", 0)])
def test_a_recording_holds_the_numbers_and_the_legend(
    tmp_path: Path, images: ImageStorage, n_images: int
) -> None:
    with (
        open_scene(read_scene(scene_file(tmp_path)), is_blind=True) as simulation,
        Recorder(simulation.bus, tmp_path / "a.mcap", images=images) as recorder,
    ):
        recorder.start(lambda: simulation.time)
        simulation.advance(0.15)
    with (tmp_path / "a.mcap").open("rb") as file:
        messages = [
            (channel.topic, message)
            for _, channel, _, message in make_reader(
                file, decoder_factories=[DecoderFactory()]
            ).iter_decoded_messages()
        ]
    drawn = [message for topic, message in messages if topic == "/seg"]
    legends = [json.loads(message.data) for topic, message in messages if topic == "/legend"]
    assert (len(drawn), len(legends)) == (n_images, 4)
    assert "left" in legends[0].values()
    for message in drawn:
        numbers = np.frombuffer(bytes(message.data), "<u2")
        assert {legends[0][str(number)] for number in np.unique(numbers)} == {"", "left", "right"}
