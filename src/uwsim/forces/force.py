r"""The interface of forces: wrenches on bodies, computed at the beginning of each step.

.. code-block:: text

    apply_commands -> step_devices -> advect_kinematic -> forces -> step_physics -> animate -> ...
"""

from __future__ import annotations

import abc
from collections.abc import Iterable
from dataclasses import dataclass

from ..base.geometry import Array
from ..base.record import NoState, Record
from ..schema import Spec
from ..world import Attachment, ForceWorld


@dataclass(frozen=True, kw_only=True)
class ForceSpec(Spec, abc.ABC):
    """The spec of a force.

    Fields that name a body are declared with ``element(refers_to="body")``: ``uwsim check`` checks
    them.
    """

    name: str
    """The name of the force, which messages about it contain."""

    @abc.abstractmethod
    def bind(self, world: ForceWorld) -> Force:
        """Find the bodies that it acts on; raises UnknownName if one is missing."""


class Force(abc.ABC):
    """A bound force.

    It is computed at the beginning of each step and acts in that step: poses, velocities and the
    water are those of the beginning, and the wrenches are constant in W until its end. Its error is
    of first order in the step, and a damping c on a mass m needs a step below 2 m/c.
    """

    state: Record = NoState()
    """All numbers of the force that change during a run; `Simulation.save` stores them."""

    @abc.abstractmethod
    def wrenches(self, time: float) -> Iterable[tuple[Attachment, Array]]:
        """Return the bodies and the wrenches on them in the step that begins at ``time`` [s].

        Each wrench is (6,): the force [N], then the torque [N m] about the origin of the
        attachment, both in the axes of W. Several wrenches on one body are added. The reaction on
        another body is one more entry; on a body that forces do not move a wrench has no effect.
        """
