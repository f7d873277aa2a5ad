"""The curve from the pulse width of a servo output to the command of an actuator."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

from ...errors import UwsimError

NEUTRAL_PWM = 1500
"""The pulse width that stops a thruster [us]."""
DEFAULT_CURVE = (1100.0, -1.0, 1500.0, 0.0, 1900.0, 1.0)
"""The curve of Blue Robotics' speed controllers: pulse width [us] and command of each point."""
MAX_PWM = 65535
"""The greatest pulse width that a packet can contain [us]."""


@dataclass(frozen=True, slots=True)
class PwmCurve:
    """A curve of straight pieces; it is constant below its first and above its last point."""

    points: tuple[tuple[float, float], ...]
    """The pulse width [us] and the command [-1..1] of each point; the pulse widths rise."""

    def command(self, pwm: float) -> float:
        """Return the command at a pulse width [us]; 0 at 0, which means no signal."""
        if pwm == 0.0:
            return 0.0
        last_x, last_y = self.points[0]
        if pwm <= last_x:
            return last_y
        for x, y in self.points[1:]:
            if pwm < x:
                return last_y + (y - last_y) * (pwm - last_x) / (x - last_x)
            last_x, last_y = x, y
        return last_y

    def negate(self) -> PwmCurve:
        """Return the curve with commands of the opposite sign."""
        return PwmCurve(tuple((x, -y) for x, y in self.points))


def read_pwm_curve(numbers: tuple[float, ...]) -> PwmCurve:
    """Return the curve of numbers: pulse width and command of each point, one after the other.

    Raises:
        UwsimError: they are not pairs, at least two; a pulse width does not rise; or a command is
            not from -1 to 1.
    """
    xs, ys = numbers[0::2], numbers[1::2]
    if len(xs) != len(ys) or len(xs) < 2:
        raise UwsimError(
            f"A curve of {len(numbers)} numbers: expected pairs of pulse width [us] and command, "
            "such as 1100 -1 1500 0 1900 1."
        )
    if any(b <= a for a, b in pairwise(xs)) or xs[0] <= 0 or xs[-1] > MAX_PWM:
        raise UwsimError(
            f"The pulse widths {' '.join(f'{x:g}' for x in xs)} of a curve: expected numbers that "
            f"rise, from 1 to {MAX_PWM} us."
        )
    if any(abs(y) > 1.0 for y in ys):
        raise UwsimError(
            f"The commands {' '.join(f'{y:g}' for y in ys)} of a curve: expected numbers from -1 "
            "to 1."
        )
    return PwmCurve(tuple(zip(xs, ys, strict=True)))
