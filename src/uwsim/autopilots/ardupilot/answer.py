r"""The answer of the physics to a servo packet: one line of JSON between two line ends.

ArduPilot does not parse JSON. It takes the text between the last two line ends, and searches it for
each key in turn, from its beginning. So no key may be part of another key before it, sections are
one level deep, and each number follows its key and a colon without a blank. It reads ``timestamp``
and ``position`` as double, all other numbers as float. The source is ArduPilot's documentation of
its JSON interface.

======================  ==================================================================
key                     meaning
======================  ==================================================================
``timestamp``           the time of the physics [s]
``imu``                 ``gyro`` [rad/s] and ``accel_body``, the specific force, in FRD [m/s2]
``position``            north, east, down from home [m]
``latitude`` ...        instead of ``position``, with ``longitude`` [deg] and ``altitude`` [m]
``quaternion``          the rotation from FRD to NED, w x y z
``velocity``            over ground, NED [m/s]
``velocity_wind``       the wind, NED [m/s]
``rng_1`` ... 6         the distances of rangefinders [m]
``battery``             ``voltage`` [V] and ``current`` [A]
======================  ==================================================================
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ...errors import UwsimError

MAX_FLOAT = 3.4e38
"""The greatest number that ArduPilot reads as float."""
N_RANGES = 6
"""The number of rangefinders of the protocol."""
Vector = Sequence[float]


@dataclass(frozen=True, slots=True)
class Answer:
    """The state of a vehicle for ArduPilot."""

    timestamp: float
    """The time of the physics [s]."""
    gyro: Vector
    """The angular velocity in FRD, (3,) [rad/s]."""
    specific_force: Vector
    """The acceleration without that of gravity, in FRD, (3,); (0, 0, -9.81) at rest [m/s2]."""
    position: Vector
    """The position: north, east, down from home [m]; or latitude, longitude [deg], altitude [m]."""
    quaternion: Vector
    """The rotation from FRD to NED, w x y z, (4,)."""
    velocity: Vector
    """The velocity over ground, NED, (3,) [m/s]."""
    is_geodetic: bool = False
    """True if the position is latitude, longitude and altitude."""
    ranges: Sequence[float | None] = ()
    """The distance of each rangefinder [m]; None: it has not measured."""
    battery: tuple[float, float] | None = None
    """The voltage [V] and the current [A] of the battery; None: not sent."""
    wind: Vector | None = None
    """The velocity of the wind, NED, (3,) [m/s]; None: not sent."""


def encode_answer(answer: Answer) -> bytes:
    """Return the bytes of an answer.

    Numbers have the digits that give the same double back. The function is called in every frame:
    it formats one text.

    Raises:
        UwsimError: a number is not finite, or too large for ArduPilot.
    """
    p, r, f = answer.gyro, answer.specific_force, answer.position
    q, v = answer.quaternion, answer.velocity
    total = sum(map(abs, (answer.timestamp, *p, *r, *f, *q, *v)))
    if not total < MAX_FLOAT:
        raise UwsimError(_describe_invalid(answer))
    position = (
        f'"latitude":{f[0]!r},"longitude":{f[1]!r},"altitude":{f[2]!r}'
        if answer.is_geodetic
        else f'"position":[{f[0]!r},{f[1]!r},{f[2]!r}]'
    )
    text = (
        f'\n{{"timestamp":{answer.timestamp!r},'
        f'"imu":{{"gyro":[{p[0]!r},{p[1]!r},{p[2]!r}],'
        f'"accel_body":[{r[0]!r},{r[1]!r},{r[2]!r}]}},{position},'
        f'"quaternion":[{q[0]!r},{q[1]!r},{q[2]!r},{q[3]!r}],'
        f'"velocity":[{v[0]!r},{v[1]!r},{v[2]!r}]{_encode_options(answer)}}}\n'
    )
    return text.encode("ascii")


def _encode_options(answer: Answer) -> str:
    """Return the text of the optional keys, which begins with a comma or is empty."""
    options: list[str] = []
    for i, distance in enumerate(answer.ranges[:N_RANGES], start=1):
        if distance is not None and abs(distance) < MAX_FLOAT:
            options.append(f',"rng_{i}":{distance!r}')
    if answer.battery is not None and sum(map(abs, answer.battery)) < MAX_FLOAT:
        voltage, current = answer.battery
        options.append(f',"battery":{{"voltage":{voltage!r},"current":{current!r}}}')
    if answer.wind is not None:
        north, east, down = answer.wind
        options.append(f',"velocity_wind":[{north!r},{east!r},{down!r}]')
    return "".join(options)


def _describe_invalid(answer: Answer) -> str:
    """Return the text of the error of an answer with a number that cannot be sent."""
    names = ("timestamp", "gyro", "specific_force", "position", "quaternion", "velocity")
    for name in names:
        value = getattr(answer, name)
        numbers = [value] if isinstance(value, float) else list(value)
        if not sum(map(abs, numbers)) < MAX_FLOAT:
            return f"The {name} {numbers} cannot be sent to ArduPilot: expected finite numbers."
    return "The numbers of an answer to ArduPilot are too large."
