r"""Collision: how hard a body has hit others.

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

WORST = 0.5
"""An approach at this speed costs the whole score [m/s]."""


@dataclass(frozen=True, kw_only=True)
class CollisionSpec(MeasureSpec):
    """A ``<collision>`` element of a benchmark file."""

    target: str = element(refers_to="contacts")
    """Name of the vehicle or object."""
    stop_on_contact: bool = element(default=False, attribute=True, namespaced=True)
    """Whether the first contact ends the level, in status ``collision`` (``u:stopOnContact``)."""

    @property
    def start_value(self) -> float:
        """The original's start value."""
        return 1.0

    def bind(self, world: World) -> Collision:
        """Watch the target; raises UnknownName if it is not there."""
        world.contacts(self.target)
        return Collision(self, world)


class Collision(Measure):
    r"""A score from 1, never hit anything, down to 0.

    .. math:: \max\left(0,\ 1 - \frac{\bar s}{0.5} - \frac{s_{max}}{0.5}\right)

    where s is the speed at a step at which parts of the body and of another approach each other
    along the normal of their contact, the mean over its contacts [m/s], and 0 at any other step;
    :math:`\bar s` is its mean over *all* steps at which the measure is on. Details: the highest s,
    the mean of s over the steps in contact, and the share of steps in contact. A body that lies on
    another is in contact and approaches nothing.

    Compatibility ``collision``: only contacts that list the body first, and only its own velocity
    count, as in the original, and of what it touches only the first with which a contact closes.
    ``restart``: when it goes on again it begins anew.
    """

    unit = "1"
    detail_units: ClassVar[dict[str, str]] = {"max_speed": "m/s", "mean_speed": "m/s"}

    def __init__(self, spec: CollisionSpec, world: World) -> None:
        self._world, self._target = world, spec.target
        self._is_original = "collision" in world.compatibility
        self._begins_anew = "restart" in world.compatibility
        self._stops = spec.stop_on_contact
        self._stopped_for: str | None = None
        self._n_steps = 0
        self._n_in_contact = 0
        self._sum = 0.0  # of s [m/s]
        self._highest = 0.0  # s [m/s]

    def start(self) -> None:
        """Take the first step."""
        if self._begins_anew:
            self._n_steps = self._n_in_contact = 0
            self._sum = self._highest = 0.0
        self.update()

    def update(self) -> None:
        """Take one more step."""
        contacts = self._world.contacts(self._target)
        if self._is_original:
            contacts = [contact for contact in contacts if contact.is_first]
        self._n_steps += 1
        if contacts:
            speed = self._speed(contacts)
            self._n_in_contact += 1
            self._sum += speed
            self._highest = max(self._highest, speed)
            if self._stops and self._stopped_for is None:
                what = f" {contacts[0].other!r}" if contacts[0].other else ""
                self._stopped_for = f"{self._target!r} touched{what} at {self._world.time:g} s"

    def _speed(self, contacts: Sequence[Contact]) -> float:
        """Mean over the contacts that close [m/s]."""
        if self._is_original:
            first = next((each.other for each in contacts if each.own_speed > 0.0), None)
            speeds = [each.own_speed for each in contacts if each.other == first]
        else:
            speeds = [each.approach_speed for each in contacts]
        closing = [speed for speed in speeds if speed > 0.0]
        return sum(closing) / len(closing) if closing else 0.0

    @property
    def value(self) -> float | None:
        """The score so far [1]."""
        if self._n_steps == 0:
            return None
        return max(0.0, 1.0 - self._sum / (WORST * self._n_steps) - self._highest / WORST)

    @property
    def details(self) -> dict[str, float | None]:
        """Highest and mean speed of approach [m/s], and the share of time in contact [1]."""
        if self._n_steps == 0:
            return dict.fromkeys(("max_speed", "mean_speed", "contact_share"))
        n = self._n_in_contact
        return {
            "max_speed": self._highest,
            "mean_speed": self._sum / n if n else 0.0,
            "contact_share": n / self._n_steps,
        }

    @property
    def ends_level(self) -> str | None:
        """Status of the first contact, if ``u:stopOnContact`` is set."""
        return self._stopped_for

    @property
    def log_header(self) -> tuple[str, ...]:
        """The score and its parts."""
        return ("value", "max_speed", "mean_speed", "contact_share")

    @property
    def log_values(self) -> tuple[float | None, ...]:
        """As of now."""
        return (self.value, *self.details.values())
