r"""Collision: a score of the speeds at which a body approaches others while they touch.

.. code-block:: xml

    <collision u:stopOnContact="true"> <name>hits</name> <target>girona500</target> </collision>
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar

from ...schema import element
from ...world import Contact, World
from .measure import Measure, MeasureSpec

ZERO_SCORE_SPEED = 0.5
"""The approach speed that reduces the score to 0 [m/s]."""


@dataclass(frozen=True, kw_only=True)
class CollisionSpec(MeasureSpec):
    """A ``<collision>`` element of a benchmark file."""

    target: str = element(refers_to="contacts")
    """The name of the vehicle or object."""
    stop_on_contact: bool = element(default=False, attribute=True, namespaced=True)
    """True if the first contact ends the level, in status ``collision`` (``u:stopOnContact``)."""

    @property
    def start_value(self) -> float:
        """The value that the original UWSim reports before its first sample [1]."""
        return 1.0

    def bind(self, world: World) -> Collision:
        """Resolve the target; raises UnknownName if there is none."""
        world.contacts(self.target)
        return Collision(self, world)


class Collision(Measure):
    r"""A score from 1 (no contact) down to 0.

    .. math:: \max\left(0,\ 1 - \frac{\bar s}{0.5} - \frac{s_{max}}{0.5}\right)

    The approach speed of a contact is the speed at which the two touching points approach each
    other along the normal of the contact. s is the mean approach speed of the body's contacts that
    close at a step [m/s], or 0 at a step without such a contact. :math:`\bar s` is the mean of s
    over *all* steps at which the measure is active, and :math:`s_{max}` the largest s. Details: the
    largest s, the mean of s over the steps in contact, and the fraction of steps in contact. A body
    that rests on another is in contact, with s = 0.

    Compatibility ``collision``: as in the original UWSim, the only contacts that count are those
    that list the body first, and of these only those with the first other body that the body
    approaches; the approach speed is computed from the velocity of the body alone. ``restart``: the
    measure begins anew when it becomes active again.
    """

    unit = "1"
    detail_units: ClassVar[dict[str, str]] = {"max_speed": "m/s", "mean_speed": "m/s"}

    def __init__(self, spec: CollisionSpec, world: World) -> None:
        self._world, self._target = world, spec.target
        self._counts_first_body_only = "collision" in world.compatibility
        self._is_reset = "restart" in world.compatibility
        self._ends_at_contact = spec.stop_on_contact
        self._end_reason: str | None = None
        self._n_steps = 0
        self._n_in_contact = 0  # steps in contact
        self._speed_sum = 0.0  # sum of s over all steps [m/s]
        self._max_speed = 0.0  # largest s [m/s]

    def start(self) -> None:
        """Evaluate the first step."""
        if self._is_reset:
            self._n_steps = self._n_in_contact = 0
            self._speed_sum = self._max_speed = 0.0
        self.update()

    def update(self) -> None:
        """Evaluate one more step."""
        contacts = self._world.contacts(self._target)
        if self._counts_first_body_only:
            contacts = [contact for contact in contacts if contact.is_first]
        self._n_steps += 1
        if contacts:
            speed = self._approach_speed(contacts)
            self._n_in_contact += 1
            self._speed_sum += speed
            self._max_speed = max(self._max_speed, speed)
            if self._ends_at_contact and self._end_reason is None:
                other_name = f" {contacts[0].other!r}" if contacts[0].other else ""
                self._end_reason = f"{self._target!r} touched{other_name} at {self._world.time:g} s"

    def _approach_speed(self, contacts: Sequence[Contact]) -> float:
        """Return s, the mean approach speed of the contacts that close [m/s]."""
        if self._counts_first_body_only:
            name = next((contact.other for contact in contacts if contact.own_speed > 0.0), None)
            speeds = [contact.own_speed for contact in contacts if contact.other == name]
        else:
            speeds = [contact.approach_speed for contact in contacts]
        closing_speeds = [speed for speed in speeds if speed > 0.0]
        return sum(closing_speeds) / len(closing_speeds) if closing_speeds else 0.0

    @property
    def value(self) -> float | None:
        """The score so far [1]."""
        if self._n_steps == 0:
            return None
        return max(
            0.0,
            1.0
            - self._speed_sum / (ZERO_SCORE_SPEED * self._n_steps)
            - self._max_speed / ZERO_SCORE_SPEED,
        )

    @property
    def details(self) -> dict[str, float | None]:
        """The largest and mean approach speed [m/s], and the fraction of steps in contact [1]."""
        if self._n_steps == 0:
            return dict.fromkeys(("max_speed", "mean_speed", "contact_share"))
        n = self._n_in_contact
        return {
            "max_speed": self._max_speed,
            "mean_speed": self._speed_sum / n if n else 0.0,
            "contact_share": n / self._n_steps,
        }

    @property
    def ends_level(self) -> str | None:
        """A sentence about the first contact, if ``u:stopOnContact`` is set."""
        return self._end_reason

    @property
    def log_header(self) -> tuple[str, ...]:
        """The names of the score and its parts."""
        return ("value", "max_speed", "mean_speed", "contact_share")

    @property
    def log_values(self) -> tuple[float | None, ...]:
        """The present score and its parts."""
        return (self.value, *self.details.values())
