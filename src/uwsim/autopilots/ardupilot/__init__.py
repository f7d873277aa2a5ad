"""The protocol of ArduPilot's JSON physics backend: servo packets in, answers out."""

from __future__ import annotations

from .answer import Answer, encode_answer
from .pwm import NEUTRAL_PWM, PwmCurve, read_pwm_curve
from .servo_packet import ServoPacket, read_servo_packet

__all__ = [
    "NEUTRAL_PWM",
    "Answer",
    "PwmCurve",
    "ServoPacket",
    "encode_answer",
    "read_pwm_curve",
    "read_servo_packet",
]
