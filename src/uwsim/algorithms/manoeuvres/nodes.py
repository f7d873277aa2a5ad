"""The manoeuvring algorithms, each with the parameters of its program."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import ClassVar

from ...errors import BadSetting
from .manoeuvre_node import ManoeuvreNode
from .parameters import STEERING, parse_numbers
from .programs import CrashStop, Program, PullOut, ReverseSpiral, Spiral, TurningCircle, ZigZag

SIDES = {"starboard": 1.0, "port": -1.0}
DEFAULT_ANGLES = "35 25 15 10 5 3 1 0 -1 -3 -5 -10 -15 -25 -35"


def read_rudder(parameters: Mapping[str, float | str]) -> float:
    """Return the rudder angle, limited, positive to starboard [rad].

    Raises:
        BadSetting: the side is neither ``starboard`` nor ``port``.
    """
    side = str(parameters["side"])
    if side not in SIDES:
        raise BadSetting(f"algorithm.side={side[:40]!r}: expected starboard or port.")
    angle = min(float(parameters["rudder"]), float(parameters["limit"]))
    return SIDES[side] * math.radians(angle)


class TurningCircleNode(ManoeuvreNode):
    """A turning circle: the rudder is put over and held for two circles."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        **STEERING,
        "rudder": 35.0,
        "side": "starboard",
    }
    """The parameters of steering, the ``rudder`` angle [deg] and the ``side`` to which it is put:
    ``starboard`` or ``port``."""

    def make_program(self, parameters: Mapping[str, float | str]) -> Program:
        """Make the program of the manoeuvre."""
        return TurningCircle(read_rudder(parameters))


class ZigZagNode(ManoeuvreNode):
    """A zig-zag: the rudder is reversed whenever the heading has changed by an angle."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        **STEERING,
        "rudder": 10.0,
        "side": "starboard",
        "heading": 10.0,
    }
    """The parameters of steering, the ``rudder`` angle [deg] and the ``side`` of the first
    execution, and the change of ``heading`` at which the rudder is reversed [deg]."""

    def make_program(self, parameters: Mapping[str, float | str]) -> Program:
        """Make the program of the manoeuvre."""
        return ZigZag(read_rudder(parameters), math.radians(float(parameters["heading"])))


class SpiralNode(ManoeuvreNode):
    """A direct spiral: rudder angles from one side to the other and back, each held for a time."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        **STEERING,
        "angles": DEFAULT_ANGLES,
        "hold": 40.0,
    }
    """The parameters of steering, the rudder ``angles`` of the way to port [deg], which are
    repeated on the way back, and the time for which each is held, ``hold`` [s]."""

    def make_program(self, parameters: Mapping[str, float | str]) -> Program:
        """Make the program of the manoeuvre."""
        angles = [math.radians(a) for a in parse_numbers("angles", parameters["angles"])]
        return Spiral([*angles, *angles[-2::-1]], float(parameters["hold"]))


class ReverseSpiralNode(ManoeuvreNode):
    """A reverse spiral: yaw rates one after the other, each held by a helmsman for a time."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        **STEERING,
        "rates": "6 4 2 0 -2 -4 -6",
        "hold": 40.0,
        "gain": 1.0,
        "integral_time": 5.0,
    }
    """The parameters of steering, the yaw ``rates`` [deg/s], the time for which each is held,
    ``hold`` [s], and the helmsman's ``gain`` [s] and ``integral_time`` [s]."""

    def make_program(self, parameters: Mapping[str, float | str]) -> Program:
        """Make the program of the manoeuvre."""
        rates = [math.radians(rate) for rate in parse_numbers("rates", parameters["rates"])]
        return ReverseSpiral(
            rates,
            float(parameters["hold"]),
            gain=float(parameters["gain"]),
            integral_time=float(parameters["integral_time"]),
            limit=math.radians(float(parameters["limit"])),
        )


class PullOutNode(ManoeuvreNode):
    """A pull-out: a steady turn, then the rudder is put to its neutral angle."""

    PARAMETERS: ClassVar[Mapping[str, float | str]] = {
        **STEERING,
        "rudder": 20.0,
        "side": "starboard",
        "neutral": "0",
        "hold": 60.0,
    }
    """The parameters of steering, the ``rudder`` angle [deg] and the ``side`` of the turn, the
    ``neutral`` angle, positive to starboard [deg], and the time of both, ``hold`` [s]."""

    def make_program(self, parameters: Mapping[str, float | str]) -> Program:
        """Make the program of the manoeuvre."""
        return PullOut(
            read_rudder(parameters),
            math.radians(parse_numbers("neutral", parameters["neutral"])[0]),
            float(parameters["hold"]),
        )


class CrashStopNode(ManoeuvreNode):
    """A crash stop: full thrust astern with the rudder amidships, until the vehicle goes astern."""

    def make_program(self, parameters: Mapping[str, float | str]) -> Program:
        """Make the program of the manoeuvre."""
        return CrashStop()
