"""Sonar messages are those of marine_acoustic_msgs, field by field."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np
import pytest
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from uwsim import messages
from uwsim.base.message_fields import find_invalid_field
from uwsim.messages import PingInfo, ProjectedSonarImage, SonarImageData, Vector3

TEXTS = Path(messages.__file__).parent / "marine_acoustic_msgs" / "msg"
STORE = get_typestore(Stores.ROS2_JAZZY)
for text in sorted(TEXTS.glob("*.msg")):
    STORE.register(get_types_from_msg(text.read_text(), f"marine_acoustic_msgs/msg/{text.stem}"))


@pytest.mark.parametrize("kind", [PingInfo, SonarImageData, ProjectedSonarImage])
def test_fields_are_those_of_the_definition(kind: type) -> None:
    name = f"marine_acoustic_msgs/msg/{kind.__name__}"
    assert kind.__msgtype__ == name  # type: ignore[attr-defined]
    fields = [entry for entry, _ in STORE.fielddefs[name][1]]
    assert [entry.name for entry in dataclasses.fields(kind)] == fields
    assert find_invalid_field(kind()) is None


def test_a_sonar_image_is_what_ros_reads() -> None:
    message = ProjectedSonarImage(
        ping_info=PingInfo(frequency=9e5),
        beam_directions=[Vector3(0.0, 0.5, 1.0)],
        ranges=np.array([1.0, 2.0], dtype=np.float32),
        image=SonarImageData(dtype=8, beam_count=1, data=np.arange(8, dtype=np.uint8)),
    )
    assert find_invalid_field(message) is None
    name = "marine_acoustic_msgs/msg/ProjectedSonarImage"
    back = STORE.deserialize_cdr(STORE.serialize_cdr(message, name), name)
    assert back.ping_info.frequency == 9e5
    assert back.beam_directions[0].y == 0.5
    assert back.ranges.tolist() == [1.0, 2.0]
    assert bytes(back.image.data) == bytes(range(8))
