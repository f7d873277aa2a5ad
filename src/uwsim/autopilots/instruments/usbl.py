"""Sentences of acoustic positioning: PSONLLD of Sonardyne, PSIMSSB of Kongsberg.

.. code-block:: text

    $PSONLLD,time,beacon,status,latitude,longitude,depth,major,minor,direction,depth error,,,,*hh
    $PSIMSSB,time,beacon,status,error,C,H,filter,x,y,depth,accuracy,,,*hh

PSONLLD has the latitude and longitude [deg], the depth [m], the semi-axes of the error ellipse and
the direction of its major axis [m, m, deg], and the error of the depth [m]; errors are one standard
deviation. PSIMSSB with ``C,H`` has Cartesian coordinates relative to the transceiver of a ship: x
to starboard, y forward, and the depth [m]. The status is A (valid) or V.

Sources: Woods Hole Oceanographic Institution, ds_sensors, Sonardyne USBL (BSD licence), and MARUM,
parsers of navigation, for PSONLLD; Olex, integrator information, for PSIMSSB.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from .sentence import Sentence, format_number, read_sentence
from .utc import format_time_of_day


@dataclass(frozen=True, kw_only=True)
class BeaconPosition:
    """The position of an acoustic beacon."""

    time_us: int = 0
    """The time of validity [us since 1970]."""
    beacon: str = ""
    """The name of the beacon."""
    latitude: float = math.nan
    """The latitude [deg]; NaN: not known."""
    longitude: float = math.nan
    """The longitude [deg]; NaN: not known."""
    starboard: float = math.nan
    """The coordinate to starboard of the transceiver [m]; NaN: not known."""
    forward: float = math.nan
    """The coordinate forward of the transceiver [m]; NaN: not known."""
    depth: float = math.nan
    """The depth of the beacon [m]."""
    error: float = math.nan
    """The standard deviation of each horizontal coordinate [m]."""

    def psonlld(self) -> Sentence:
        """Return the geographic position."""
        is_valid = math.isfinite(self.latitude) and math.isfinite(self.longitude)
        error = format_number(self.error, 2)
        return Sentence(
            "PSONLLD",
            (
                format_time_of_day(self.time_us),
                self.beacon,
                "A" if is_valid else "V",
                format_number(self.latitude, 8),
                format_number(self.longitude, 8),
                format_number(self.depth, 3),
                error,
                error,
                "0.00" if error else "",
                error,
                "",
                "",
                "",
                "",
            ),
        )

    def psimssb(self) -> Sentence:
        """Return the position relative to the transceiver."""
        is_valid = math.isfinite(self.starboard) and math.isfinite(self.forward)
        return Sentence(
            "PSIMSSB",
            (
                format_time_of_day(self.time_us),
                self.beacon,
                "A" if is_valid else "V",
                "",
                *("C", "H", "M"),
                format_number(self.starboard, 3),
                format_number(self.forward, 3),
                format_number(self.depth, 3),
                format_number(self.error, 3),
                *("", "", ""),
            ),
        )


def read_beacon_position(data: bytes) -> BeaconPosition:
    """Return the position of a PSONLLD or PSIMSSB sentence; raise BadMessage."""
    sentence = read_sentence(data, "PSONLLD", "PSIMSSB")
    if sentence.address == "PSONLLD":
        return BeaconPosition(
            beacon=sentence.text(1),
            latitude=sentence.number(3),
            longitude=sentence.number(4),
            depth=sentence.number(5),
            error=sentence.number(6),
        )
    return BeaconPosition(
        beacon=sentence.text(1),
        starboard=sentence.number(7),
        forward=sentence.number(8),
        depth=sentence.number(9),
        error=sentence.number(10),
    )
