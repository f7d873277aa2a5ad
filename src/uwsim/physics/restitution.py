r"""The spring and damper of a contact with a coefficient of restitution.

Along its normal a contact is a damped spring that cannot pull. With the penetration depth x, its
rate v, the frequency :math:`\omega` and the damping ratio :math:`\zeta`,

.. math:: \dot v = \max(0, -b v - k x), \qquad k = \omega^2, \quad b = 2 \zeta \omega .

The engine integrates this equation in steps of length h, with the depth and the speed at the
beginning of the step. As :math:`\omega h` approaches 2, such a spring gains speed, and the phase of
the step at which the contact begins matters as much as the damping. :math:`1/\omega` is therefore
at least two steps: at any phase, the speed after a bounce is not greater than before. The damping
is computed from the discrete equation, so that the ratio of these speeds, averaged over all phases,
is the coefficient of restitution.
"""

from __future__ import annotations

from functools import cache

BOUNCE_TIME = 0.01
"""The inverse frequency of the spring for short steps [s]."""
MIN_STEPS = 2.0
"""The minimum inverse frequency of the spring, in steps [1]."""
MIN_RATE = 0.02
"""The product of frequency and step below which shorter steps no longer change the damping [1]."""
MIN_STIFFNESS = 1.0 / 36.0
"""The minimum stiffness of a contact times the square of the step [1]. It moves a body out by a
36th of the depth in a step, and returns at most this fraction of the speed."""
PHASES = 16
"""The number of phases over which a bounce is averaged."""


@cache
def contact_spring(restitution: float, timestep: float) -> tuple[float, float]:
    """Return the stiffness [1/s2] and the damping [1/s] of a contact, per mass.

    Args:
        restitution: the speed after a bounce divided by the speed before it [1], 0 to 0.95.
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
    """Return the speed after a bounce divided by the speed before it, integrated step by step.

    Args:
        stiffness: the stiffness of the spring times the square of the step [1].
        damping: the damping of the spring times the step [1]; at most 1.
        phase: the depth after the step of the impact, divided by the travel in a step [1].
    """
    depth, speed = phase, 1.0  # into the surface
    while depth > 0.0:
        push = stiffness * depth + damping * speed
        if push <= 0.0:
            break
        speed -= push
        depth += speed
    return -speed
