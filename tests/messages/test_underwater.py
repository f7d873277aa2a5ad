"""Messages of underwater_sensor_msgs are those of its definitions, field by field."""

from __future__ import annotations

from pathlib import Path

import pytest
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from uwsim import messages
from uwsim.base.message_fields import find_invalid_field
from uwsim.messages import DVL, LedLight, Pressure

TEXTS = Path(messages.__file__).parent / "underwater_sensor_msgs" / "msg"
STORE = get_typestore(Stores.ROS2_JAZZY)
for kind in (DVL, LedLight, Pressure):
    text = (TEXTS / f"{kind.__name__}.msg").read_text()
    STORE.register(get_types_from_msg(text, kind.__msgtype__))


@pytest.mark.parametrize("kind", [DVL, LedLight, Pressure])
def test_fields_are_those_of_the_definition(kind: type) -> None:
    name = f"underwater_sensor_msgs/msg/{kind.__name__}"
    assert kind.__msgtype__ == name  # type: ignore[attr-defined]
    assert list(kind.__dataclass_fields__) == [  # type: ignore[attr-defined]
        *(entry for entry, _ in STORE.fielddefs[name][1]),
        "__msgtype__",
    ]
    assert find_invalid_field(kind()) is None


def test_a_dvl_message_is_what_ros_reads() -> None:
    message = DVL(header_dvl="dvl", bi_x_axis=0.25, bd_range=3.5, raw_data="four beams")
    back = STORE.deserialize_cdr(STORE.serialize_cdr(message, message.__msgtype__), DVL.__msgtype__)
    assert (back.bi_x_axis, back.bd_range, back.raw_data) == (0.25, 3.5, "four beams")
