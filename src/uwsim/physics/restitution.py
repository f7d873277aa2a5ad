r"""The spring of a contact that returns a share of the impact speed.

Along its normal a contact is a damped spring that cannot pull, with the depth :math:`x` and

.. math:: \dot v = \max(0, -b v - k x), \qquad k = \omega^2, \quad b = 2 \zeta \omega .

The engine integrates it in steps of length h, with the depth and the speed at the beginning of the
step. Such a spring gains speed when :math:`\omega h` approaches 2, and the phase of the contact in
the step then matters as much as the damping. :math:`1/\omega` is therefore at least two steps: at
any phase, the speed after a bounce is not greater than before. The damping is computed from the
discrete contact itself, so that the mean over all phases is the coefficient of restitution.
"""

from __future__ import annotations

from functools import cache

BOUNCE_TIME = 0.01
"""The inverse of the spring's frequency, where the step is short [s]."""
MIN_STEPS = 2.0
"""The least inverse of the frequency [steps]."""
MIN_RATE = 0.02
"""The frequency by step [1] below which shorter steps no longer change the damping."""
MIN_STIFFNESS = 1.0 / 36.0
"""The least stiffness of a contact, by the step squared [1]: it moves a body out by a 36th of the
depth in a step, and returns at most that share of the speed."""
PHASES = 16


@cache
def contact_spring(restitution: float, timestep: float) -> tuple[float, float]:
    """Return the stiffness [1/s2] and the damping [1/s] of a contact, per mass.

    Args:
        restitution: the speed after a bounce by the speed before [1], 0 to 0.95.
        timestep: the length of a step [s].
    """
    rate = timestep / max(BOUNCE_TIME, MIN_STEPS * timestep)
    stiffness = max(rate, MIN_RATE) ** 2
    if _mean_bounce(stiffness, 1.0) > restitution:  # the greatest stable damping
        max_stiffness = max(2.0 * restitution, MIN_STIFFNESS)
        return min(rate * rate, max_stiffness) / timestep**2, 1.0 / timestep
    low, high = 0.0, 1.0
    for _ in range(40):
        damping = 0.5 * (low + high)
        low, high = (
            (damping, high) if _mean_bounce(stiffness, damping) > restitution else (low, damping)
        )
    return (rate / timestep) ** 2, damping * rate / stiffness**0.5 / timestep


def _mean_bounce(stiffness: float, damping: float) -> float:
    return sum(bounce(stiffness, damping, (i + 0.5) / PHASES) for i in range(PHASES)) / PHASES


def bounce(stiffness: float, damping: float, phase: float) -> float:
    """Return the speed after a bounce by the speed before, step by step.

    Args:
        stiffness: the stiffness of the spring times the square of the step [1].
        damping: the damping of the spring times the step [1]; at most 1.
        phase: the depth after the step of the impact, by the distance travelled in a step [1].
    """
    depth, speed = phase, 1.0  # into the surface
    while depth > 0.0:
        push = stiffness * depth + damping * speed
        if push <= 0.0:
            break
        speed -= push
        depth += speed
    return -speed
