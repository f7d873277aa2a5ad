"""The message of a DVL: velocities in three frames, and distances made good, as in RDI's PD6.

An unknown velocity is NaN and its status ``V``; a valid one has the status ``A``.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from ..acoustics import SeaWater
from ..base.geometry import Array
from ..messages import DVL, Header
from . import dvl_kernel as k

STATUS_VALID, STATUS_INVALID = "A", "V"
"""The statuses of a velocity in PD6: valid, invalid."""
_NUMBERS = (
    *("i_x_axis", "i_y_axis", "i_z_axis", "e_east", "e_north", "e_upwards", "i_error"),
    *("d_east", "d_north", "d_upwards", "s_longitudinal", "s_transverse", "s_normal"),
    *("d_range", "d_time"),
)
_STATUSES = ("i_status", "s_status", "e_status")
_FIELDS = {letter: tuple(f"{letter}{name}" for name in (*_NUMBERS, *_STATUSES)) for letter in "bw"}


def dvl_message(header: Header, values: Array, *, water: SeaWater, water_layer: float) -> DVL:
    """Return the message of a ping.

    Args:
        header: the header of the message.
        values: the values of a sample, see `dvl_kernel.N_VALUES`.
        water: the acoustic properties of the water.
        water_layer: the distance to the tracked layer of water along the z axis of the sensor [m].
    """
    numbers = values.tolist()
    depth = numbers[k.DEPTH]
    return DVL(
        header=header,
        header_dvl=header.frame_id,
        salinity=water.salinity,
        temperature=water.temperature,
        depth=depth,
        sound_speed=water.sound_speed(depth),
        raw_data=" ".join(map(repr, numbers[k.RANGES :])),
        **_track_fields("b", numbers[k.BOTTOM : k.WATER], numbers[k.HEIGHT]),
        **_track_fields("w", numbers[k.WATER : k.HEIGHT], water_layer),
    )


def _track_fields(letter: str, numbers: Sequence[float], distance: float) -> dict[str, Any]:
    """Return the message fields of a track.

    Args:
        letter: the first letter of the fields: b for the bottom track, w for the water track.
        numbers: the numbers of the track, and the velocity in the base frame.
        distance: the mean height above the seabed, or the distance to the layer of water [m].
    """
    status = STATUS_INVALID if math.isnan(numbers[k.INSTRUMENT]) else STATUS_VALID
    age = numbers[k.TIME] - numbers[k.LAST_VALID]
    values: tuple[float | str, ...] = (
        *numbers[: k.TIME],
        *numbers[k.BASE_VELOCITY :],
        distance,
        age,
        status,
        status,
        status,
    )
    return dict(zip(_FIELDS[letter], values, strict=True))
