r"""The interface of forces: wrenches on bodies, computed at the beginning of each step.

The order of the computations in a step:

.. code-block:: text

    apply_commands -> step_devices -> drift_kinematic_vehicles -> forces -> step_physics -> ...
"""

from __future__ import annotations

import abc
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from ..base.geometry import Array, Triple
from ..base.record import NoState, Record
from ..schema import Spec
from ..world import Attachment, ForceWorld


@dataclass(frozen=True)
class DrawnSegments:
    """The cylinders that show the body of a force, such as the segments of a tether."""

    n: int
    """The number of cylinders."""
    length: float
    """The length of each cylinder [m]."""
    radius: float
    """The radius of each cylinder [m]."""
    colour: Triple
    """The colour, red, green and blue [0..1]."""


@dataclass(frozen=True, kw_only=True)
class ForceSpec(Spec, abc.ABC):
    """The spec of a force.

    Declare a field that names a body with ``element(refers_to="body")``: ``uwsim check`` then
    reports unknown names.
    """

    name: str
    """The name of the force, for messages."""

    @property
    def drawn_segments(self) -> DrawnSegments | None:
        """The cylinders that show the force, which it places itself; None if it is invisible."""
        return None

    def errors(self) -> Iterator[str]:
        """Yield errors of elements that contradict each other."""
        return iter(())

    @abc.abstractmethod
    def bind(self, world: ForceWorld) -> Force:
        """Resolve the names of the bodies it acts on; raise UnknownName if one is missing."""


class Force(abc.ABC):
    """A force of a running simulation.

    The wrenches are computed at the beginning of each step from the poses, velocities and water
    motion at that time, and are constant in the world frame W until the end of the step. The error
    is of first order in the step; a damping coefficient c on a mass m is stable in steps below
    2 m/c.
    """

    state: Record = NoState()
    """All numbers of the force that change during a run; `Simulation.save` stores them."""

    @abc.abstractmethod
    def wrenches(self, time: float) -> Iterable[tuple[Attachment, Array]]:
        """Return the wrenches of the step that begins at ``time`` [s], each with its attachment.

        Each wrench is (6,): the force [N], then the torque [N m] about the origin of the
        attachment, both in the axes of W. Several wrenches on one body are added. Return the
        reaction on another body as a separate entry. A wrench on a body without dynamics has no
        effect.
        """
