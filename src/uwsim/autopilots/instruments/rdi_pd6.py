r"""PD6 of Teledyne RDI: the measurement of a DVL as lines of text.

.. code-block:: text

    :SA,+PP.PP,+RR.RR,HHH.HH                    pitch, roll, heading [deg]
    :TS,YYMMDDhhmmsshh,SS.S,+TT.T,DDDD.D,CCCC.C,BBB  time, salinity, temperature, depth, sound speed
    :WI,+XXXXX,+YYYYY,+ZZZZZ,+EEEEE,S           through the water, instrument axes [mm/s], status
    :WS,+TTTTT,+LLLLL,+NNNNN,S                  ship axes: transverse, longitudinal, normal [mm/s]
    :WE,+EEEEE,+NNNNN,+UUUUU,S                  Earth axes: east, north, up [mm/s]
    :WD,+EEEEEEEE.EE,+NNNNNNNN.NN,+UUUUUUUU.UU,DDDD.DD,TTT.TT
    :BI, :BS, :BE, :BD                          the same over the bottom

``WD`` and ``BD`` have the distance made good [m], the distance to the layer or to the bottom [m],
and the time since the last good velocity [s]. The status of a velocity is A (good) or V (bad); bad
velocities are -32768. Lines end with CR and LF; there is no checksum.

Source: Teledyne RD Instruments, WorkHorse Commands and Output Data Format, "PD6 output data
format". Instrument axes are those of ship axes here: the instrument's beam 3 points forward.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from ...errors import BadMessage
from .dvl import DvlPing, Vector, is_known, to_ship_axes
from .sentence import MAX_LENGTH, format_number, parse_number
from .utc import to_datetime

BAD_VELOCITY = -32768
"""The value of a velocity that is not known [mm/s]."""
MAX_SPEED = 32767
"""The greatest component of a velocity [mm/s]."""
VELOCITY_LINES = {"I": 4, "S": 3, "E": 3}
"""The number of components in lines of instrument, ship and Earth axes."""


def _line(name: str, *fields: str) -> bytes:
    return ",".join((f":{name}", *fields)).encode("ascii") + b"\r\n"


def _velocity_line(name: str, components: tuple[float, ...], *, is_good: bool) -> bytes:
    numbers = [
        min(max(round(1000.0 * value), -MAX_SPEED), MAX_SPEED)
        if is_good and math.isfinite(value)
        else BAD_VELOCITY
        for value in components
    ]
    return _line(name, *(f"{number:+06d}" for number in numbers), "A" if is_good else "V")


def _distance_line(name: str, made_good: Vector, distance: float, age: float) -> bytes:
    distances = [format_number(value, 2, width=12, is_signed=True) for value in made_good]
    length = format_number(distance if math.isfinite(distance) else 0.0, 2, width=7)
    return _line(name, *distances, length, format_number(min(age, 999.99), 2, width=6))


def _track(
    letter: str, velocity: Vector, error: float, earth: Vector, made_good: Vector
) -> list[bytes]:
    """Return the lines of the velocities of a track."""
    is_good, ship = is_known(velocity), to_ship_axes(velocity)
    return [
        _velocity_line(f"{letter}I", (*ship, error), is_good=is_good),
        _velocity_line(f"{letter}S", ship, is_good=is_good),
        _velocity_line(f"{letter}E", earth, is_good=is_known(earth)),
    ]


def write_pd6(ping: DvlPing) -> bytes:
    """Return the lines of a ping."""
    moment = to_datetime(ping.time_us)
    hundredths = moment.microsecond // 10000
    water = _track(
        "W",
        ping.water_velocity,
        ping.water_error_velocity,
        ping.water_earth_velocity,
        ping.water_distance_made_good,
    )
    bottom = _track(
        "B", ping.velocity, ping.error_velocity, ping.earth_velocity, ping.distance_made_good
    )
    return b"".join(
        [
            _line(
                "SA",
                format_number(ping.pitch, 2, width=6, is_signed=True),
                format_number(ping.roll, 2, width=6, is_signed=True),
                format_number(round(ping.heading, 2) % 360.0, 2, width=6),
            ),
            _line(
                "TS",
                f"{moment:%y%m%d%H%M%S}{hundredths:02d}",
                format_number(ping.salinity, 1, width=4),
                format_number(ping.temperature, 1, width=5, is_signed=True),
                format_number(ping.depth, 1, width=6),
                format_number(ping.sound_speed, 1, width=6),
                "000",
            ),
            *water,
            _distance_line("WD", ping.water_distance_made_good, ping.water_layer, ping.water_age),
            *bottom,
            _distance_line("BD", ping.distance_made_good, ping.altitude, ping.age),
        ]
    )


@dataclass(frozen=True, kw_only=True)
class Pd6Line:
    """The fields of a line."""

    name: str
    """The name of the line, such as ``BI``."""
    values: tuple[float, ...]
    """The numbers: velocities in [m/s], others as in the line; NaN: bad."""
    is_good: bool = True
    """True if the line has no status V."""


def read_pd6_line(data: bytes) -> Pd6Line:
    """Return the fields of a line; raise BadMessage."""
    text = data.strip(b"\r\n").decode("ascii", "replace")
    name, *fields = (field.strip() for field in text[1:].split(","))
    if not text.startswith(":") or len(data) > MAX_LENGTH:
        raise BadMessage(f"{text[:40]!r} is no line of PD6; expected :NAME,FIELDS.")
    if name in ("SA", "TS", "WD", "BD"):
        n_fields = {"SA": 3, "TS": 6}.get(name, 5)
        _check_count(name, fields, n_fields)
        return Pd6Line(name=name, values=tuple(parse_number(field, name) for field in fields))
    if len(name) != 2 or name[0] not in "WB" or name[1] not in VELOCITY_LINES:
        raise BadMessage(
            f":{name[:10]} is no line of PD6; expected SA, TS, or W or B with I, S, E, D."
        )
    n_components = VELOCITY_LINES[name[1]]
    _check_count(name, fields, n_components + 1)
    if fields[-1] not in ("A", "V"):
        raise BadMessage(f":{name} has the status {fields[-1][:10]!r}; expected A or V.")
    numbers = [parse_number(field, name) for field in fields[:-1]]
    values = tuple(math.nan if n == BAD_VELOCITY else n / 1000.0 for n in numbers)
    return Pd6Line(name=name, values=values, is_good=fields[-1] == "A")


def _check_count(name: str, fields: list[str], n_expected: int) -> None:
    if len(fields) != n_expected:
        raise BadMessage(f":{name} has {len(fields)} fields; expected {n_expected}.")
