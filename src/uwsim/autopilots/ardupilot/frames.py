"""The motor matrices of ArduSub's frames, and the skid steering of ArduRover.

The factors are those of ArduPilot 4.7 (``libraries/AP_Motors/AP_Motors6DOF.cpp``). A motor's output
is the sum of the commands times its factors, so a positive output pushes the vehicle along the axes
whose factor is positive, and against those whose factor is negative. Axes: roll (starboard down),
pitch (bow up), yaw (bow to starboard), throttle (up), forward, lateral (to starboard). ArduSub
mixes frames 1 and 2 by rules of their own for saturation, which do not change the signs.
"""

from __future__ import annotations

from dataclasses import dataclass

from ...errors import BadSetting, did_you_mean

AXES = ("roll", "pitch", "yaw", "throttle", "forward", "lateral")
"""The axes of a motor's factors, in their order."""
FIRST_MOTOR_FUNCTION = 33
"""The ``SERVOn_FUNCTION`` of motor 1; that of motor m is 32 + m."""
THROTTLE_LEFT, THROTTLE_RIGHT = 73, 74
"""The ``SERVOn_FUNCTION`` of the port and the starboard motor of ArduRover's skid steering."""

Factors = tuple[float, float, float, float, float, float]
"""The factors of a motor along `AXES`."""


@dataclass(frozen=True)
class Frame:
    """A frame of ArduSub, or the skid steering of ArduRover."""

    name: str
    """The name."""
    number: int | None
    """The value of ``FRAME_CONFIG``; None for ArduRover."""
    motors: tuple[Factors, ...]
    """The factors of each motor, motor 1 first."""

    @property
    def title(self) -> str:
        """The parameter that sets the frame, and the name."""
        if self.number is None:
            return f"ArduRover's {self.name}"
        return f"FRAME_CONFIG {self.number} ({self.name})"

    def function(self, motor: int) -> int:
        """Return the ``SERVOn_FUNCTION`` of a motor, given by its index from 0."""
        if self.number is None:
            return (THROTTLE_LEFT, THROTTLE_RIGHT)[motor]
        return FIRST_MOTOR_FUNCTION + motor


_HORIZONTAL_MOTORS: tuple[Factors, ...] = (
    (0, 0, 1, 0, -1, 1),
    (0, 0, -1, 0, -1, -1),
    (0, 0, -1, 0, 1, 1),
    (0, 0, 1, 0, 1, -1),
)
_SIMPLE_MOTORS: tuple[Factors, ...] = (
    (0, 0, -1, 0, 1, 0),
    (0, 0, 1, 0, 1, 0),
    (1, 0, 0, -1, 0, 0),
    (-1, 0, 0, -1, 0, 0),
    (0, 0, 0, 0, 0, 1),
)
FRAMES = (
    Frame(
        "bluerov1",
        0,
        (
            (0, 0, -1, 0, 1, 0),
            (0, 0, 1, 0, 1, 0),
            (-0.5, 0.5, 0, 0.45, 0, 0),
            (0.5, 0.5, 0, 0.45, 0, 0),
            (0, -1, 0, 1, 0, 0),
            (-0.25, 0, 0, 0, 0, 1),
        ),
    ),
    Frame("vectored", 1, (*_HORIZONTAL_MOTORS, (1, 0, 0, -1, 0, 0), (-1, 0, 0, -1, 0, 0))),
    Frame(
        "vectored_6dof",
        2,
        (
            *_HORIZONTAL_MOTORS,
            (1, -1, 0, -1, 0, 0),
            (-1, -1, 0, -1, 0, 0),
            (1, 1, 0, -1, 0, 0),
            (-1, 1, 0, -1, 0, 0),
        ),
    ),
    Frame(
        "vectored_6dof_90",
        3,
        (
            (1, 1, 0, 1, 0, 0),
            (0, 0, 1, 0, 1, 0),
            (1, -1, 0, 1, 0, 0),
            (0, 0, 0, 0, 0, 1),
            (0, 0, 0, 0, 0, 1),
            (-1, 1, 0, 1, 0, 0),
            (0, 0, -1, 0, 1, 0),
            (-1, -1, 0, 1, 0, 0),
        ),
    ),
    Frame("simplerov-3", 4, (*_SIMPLE_MOTORS[:2], (0, 0, 0, -1, 0, 0))),
    Frame("simplerov-4", 5, _SIMPLE_MOTORS),
    Frame("simplerov-5", 6, _SIMPLE_MOTORS),
    Frame("custom", 7, (*_SIMPLE_MOTORS[:2], (0, 0, 0, -1, 0, 0))),
    Frame("skid_steering", None, ((0, 0, 1, 0, 1, 0), (0, 0, -1, 0, 1, 0))),
)
"""The frames. In ArduPilot's source, simplerov-4 has the motors of simplerov-5. The frame custom is
for changes there; until it is changed, it has the motors of simplerov-3."""


def find_frame(text: str) -> Frame:
    """Return the frame of a name or of a value of ``FRAME_CONFIG``.

    Raises:
        BadSetting: there is none; the error lists the names.
    """
    key = text.strip().lower()
    for frame in FRAMES:
        if key in (frame.name, str(frame.number)):
            return frame
    names = [frame.name for frame in FRAMES]
    raise BadSetting(
        f"{text[:40]!r} is not a frame.{did_you_mean(key, names)} Frames: {', '.join(names)}, or "
        "the number of FRAME_CONFIG."
    )
