r"""The spring of a contact that gives back a share of the speed with which it is hit.

Along its normal a contact is a damped spring that cannot pull, with the depth :math:`x` and

.. math:: \dot v = \max(0, -b v - k x), \qquad k = \omega^2, \quad b = 2 \zeta \omega .

The engine takes it in steps of length h, with the depth and the speed of the step's beginning.
Such a spring gains speed once :math:`\omega h` nears 2, and where in a step the contact begins then
counts for as much as its damping. :math:`1/\omega` is therefore at least two steps:
whatever the phase, no bounce is then faster than what came in. The damping is solved from the
discrete contact itself, so that the mean over all phases is the coefficient of restitution.
"""

from __future__ import annotations

from functools import cache

BOUNCE_TIME = 0.01
"""Inverse of the frequency of the spring, where the step is short [s]."""
STEPS = 2.0
"""What the inverse of the frequency is at least [steps]."""
MIN_RATE = 0.02
"""Frequency by step [1] below which shorter steps no longer change the damping."""
MIN_STIFFNESS = 1.0 / 36.0
"""Of a contact that is to give nothing back, by the step squared [1]: it pushes out by a 36th of
the depth in a step, and gives back at most that share of the speed."""
PHASES = 16


@cache
def contact_spring(restitution: float, timestep: float) -> tuple[float, float]:
    """Return the stiffness [1/s2] and the damping [1/s] of a contact, per mass.

    Args:
        restitution: speed after a bounce by the speed before [1], 0 to 0.95.
        timestep: length of a step [s].
    """
    rate = timestep / max(BOUNCE_TIME, STEPS * timestep)
    stiffness = max(rate, MIN_RATE) ** 2
    if _mean_bounce(stiffness, 1.0) > restitution:  # as much damping as a step bears
        softest = max(2.0 * restitution, MIN_STIFFNESS)
        return min(rate * rate, softest) / timestep**2, 1.0 / timestep
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
        stiffness: of the spring, by the square of the step [1].
        damping: of the spring, by the step [1]; at most 1.
        phase: depth at the end of the step in which the bodies met, by the way of a step [1].
    """
    depth, speed = phase, 1.0  # into the surface
    while depth > 0.0:
        push = stiffness * depth + damping * speed
        if push <= 0.0:
            break
        speed -= push
        depth += speed
    return -speed
