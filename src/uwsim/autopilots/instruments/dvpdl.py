"""``$DVPDL`` of Cerulean Sonar: the motion of a DVL since its last message.

.. code-block:: text

    $DVPDL,tu,dtu,adr,adp,ady,pdx,pdy,pdz,c*hh

Time since the start and since the last message [us], angle deltas about roll, pitch and yaw [rad]
(0 of instruments without a gyroscope), position deltas forward, to starboard and down [m], and the
confidence from 0 to 100.

Source: Cerulean Sonar, Tracker 650, "$DVPDL and $DVPDX: DVL Position and Angle Deltas Messages".
``$DVPDX`` has the fields mode, pitch, roll and stand-off in addition. The values of its mode are
not in that source, so it is not written here.
"""

from __future__ import annotations

from dataclasses import dataclass

from .dvl import Vector
from .sentence import Sentence, format_number, read_sentence


@dataclass(frozen=True, kw_only=True)
class PositionDelta:
    """The motion since the last message."""

    time_us: int
    """The time since the start [us]."""
    interval_us: int
    """The time since the last message [us]."""
    position_delta: Vector
    """The change of position, x forward, y to starboard, z down [m]."""
    angle_delta: Vector = (0.0, 0.0, 0.0)
    """The change of roll, pitch and yaw [rad]."""
    confidence: int = 100
    """The confidence, 0 to 100."""

    def dvpdl(self) -> Sentence:
        """Return the sentence."""
        return Sentence(
            "DVPDL",
            (
                str(self.time_us),
                str(self.interval_us),
                *(format_number(angle, 6) for angle in self.angle_delta),
                *(format_number(delta, 3) for delta in self.position_delta),
                str(self.confidence),
            ),
        )


def read_dvpdl(data: bytes) -> PositionDelta:
    """Return the motion of a DVPDL sentence; raise BadMessage."""
    sentence = read_sentence(data, "DVPDL")
    roll, pitch, yaw, x, y, z, confidence = (sentence.number(i) for i in range(2, 9))
    return PositionDelta(
        time_us=int(sentence.number(0)),
        interval_us=int(sentence.number(1)),
        angle_delta=(roll, pitch, yaw),
        position_delta=(x, y, z),
        confidence=int(confidence),
    )
