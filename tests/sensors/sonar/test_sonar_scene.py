"""The scene of docs/sonar.md: its topics, the same bytes twice, and noise of its own."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from tests.support.opened import open_scene
from uwsim.checks import check_file
from uwsim.messages import ProjectedSonarImage, pixels_of
from uwsim.scene.reader import read_scene
from uwsim.sensors.sonar.message import amplitudes

PAGE = Path(__file__).parents[3] / "docs" / "sonar.md"
(TEXT,) = re.findall(r"^`wreck-sonar.xml`:\n\n```xml\n(.*?)^```", PAGE.read_text(), re.M | re.S)
SMALLER = TEXT.replace("<beams>512<", "<beams>64<").replace("<rows>64<", "<rows>24<")


def heard(text: str, folder: Path) -> tuple[ProjectedSonarImage, np.ndarray]:
    """The second ping of the imaging sonar, and its picture."""
    file = folder / "scene.xml"
    file.write_text(text)
    with open_scene(read_scene(file), seed=3, is_blind=True) as simulation:
        assert simulation.topics["rov/fls"] == "marine_acoustic_msgs/msg/ProjectedSonarImage"
        simulation.latest_message("/rov/fls_image")
        simulation.latest_message("/rov/fls")
        simulation.advance(0.2)
        return simulation.latest_message("/rov/fls"), pixels_of(
            simulation.latest_message("/rov/fls_image")
        )


@pytest.mark.slow
def test_the_scene_of_the_page_is_heard_the_same_twice_whatever_else_is_aboard(
    tmp_path: Path,
) -> None:
    message, pixels = heard(SMALLER, tmp_path)
    assert amplitudes(message).shape == (500, 64)
    assert message.header.stamp.nanosec == 200_000_000
    assert pixels.max() > 200
    again, _ = heard(SMALLER, tmp_path)
    assert bytes(again.image.data) == bytes(message.image.data)
    alone = re.sub(r"<u:sideScanSonar>.*?</u:sideScanSonar>", "", SMALLER, flags=re.S)
    less, _ = heard(alone, tmp_path)
    assert bytes(less.image.data) == bytes(message.image.data)


def test_the_scene_of_the_page_has_no_errors(tmp_path: Path) -> None:
    file = tmp_path / "wreck-sonar.xml"
    file.write_text(TEXT)
    assert [each for each in check_file(file) if each.severity == "error"] == []
