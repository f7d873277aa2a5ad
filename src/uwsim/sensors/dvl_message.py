"""The message of a DVL: velocities in three frames, and distances made good, as RDI's PD6.

A velocity that is not known is NaN and its status ``V``; a good one has ``A``.
"""

from __future__ import annotations

import math

from ..acoustics import SeaWater
from ..base.geometry import Array
from ..base.numerics.linear import product
from ..messages import DVL, Header
from . import dvl_kernel as k

GOOD, BAD = "A", "V"
"""Status of a velocity in PD6."""


def dvl_message(header: Header, values: Array, *, water: SeaWater, water_layer: float) -> DVL:
    """Return the message of a ping.

    Args:
        header: its header.
        values: of the sample, `dvl_kernel.N_VALUES` numbers.
        water: where the sensor is.
        water_layer: distance to the layer of water along the axis of the sensor [m].
    """
    depth = float(values[k.DEPTH])
    message = DVL(
        header=header,
        header_dvl=header.frame_id,
        salinity=water.salinity,
        temperature=water.temperature,
        depth=depth,
        sound_speed=water.sound_speed(depth),
        raw_data=" ".join(repr(number) for number in values[k.RANGES : k.SHIP].tolist()),
    )
    ship_from_world = values[k.SHIP :].reshape(3, 3).T
    heights = float(values[k.HEIGHT]), water_layer
    for letter, first, height in zip("bw", (k.BOTTOM, k.WATER), heights, strict=True):
        track = values[first : first + k.N_TRACK]
        instrument, world = track[k.INSTRUMENT : k.WORLD], track[k.WORLD : k.ERROR]
        ship = product(ship_from_world, world)
        numbers = {
            **dict(zip(("i_x_axis", "i_y_axis", "i_z_axis"), instrument, strict=True)),
            **dict(zip(("s_longitudinal", "s_transverse", "s_normal"), ship, strict=True)),
            **dict(zip(("e_east", "e_north", "e_upwards"), world, strict=True)),
            **dict(
                zip(("d_east", "d_north", "d_upwards"), track[k.MADE_GOOD : k.TIME], strict=True)
            ),
            **{"i_error": track[k.ERROR], "d_range": height},
            **{"d_time": track[k.TIME] - track[k.LAST]},
        }
        for name, value in numbers.items():
            setattr(message, letter + name, float(value))
        for axes in "ise":
            status = BAD if math.isnan(instrument[0]) else GOOD
            setattr(message, f"{letter}{axes}_status", status)
    return message
