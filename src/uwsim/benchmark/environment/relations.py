"""The observed relations of two bodies: ``<relativePose>`` and ``<contact>``.

.. code-block:: xml

    <relativePose>
      <name>handle</name> <from>girona500/end_effector</from> <to>blackbox</to>
      <toPoint> <x>0</x> <y>0</y> <z>0.128</z> </toPoint>
    </relativePose>
    <contact> <name>touched</name> <target>blackbox</target> <other>girona500</other> </contact>

Both are the truth. In the reward, the name of a relative pose is the distance of its points [m],
and the name of a contact is 1 or 0.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from ...base.geometry import Array
from ...schema import Spec, element
from ...world import World
from ..metrics.relative_pose import RelativePose


@dataclass(frozen=True, kw_only=True)
class RelativePoseSpec(Spec):
    """A ``<relativePose>`` element: the pose of a point of a body in the frame of another body."""

    name: str
    """The name of the part of the observation, an identifier."""
    from_: str = element("from", refers_to="body")
    """The route of the body in whose axes the pose is expressed."""
    to: str = element(refers_to="body")
    """The route of the body whose pose is expressed."""
    from_point: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """The point of the first body from which the position is measured, in its frame [m]."""
    to_point: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """The point of the second body whose position is measured, in its frame [m]."""

    def bind(self, world: World) -> ObservedPose:
        """Resolve both bodies; raises UnknownName if one is unknown."""
        first, second = world.body(self.from_), world.body(self.to)
        return ObservedPose(RelativePose(first, second, self.from_point, self.to_point))


@dataclass(frozen=True, kw_only=True)
class ContactSpec(Spec):
    """A ``<contact>`` element: whether two bodies are in contact."""

    name: str
    """The name of the part of the observation, an identifier."""
    target: str = element(refers_to="contacts")
    """The name of a vehicle or object."""
    other: str = element(refers_to="contacts")
    """The name of the other vehicle or object."""

    def bind(self, world: World) -> ObservedContact:
        """Resolve both bodies; raises UnknownName if one is unknown."""
        world.contacts(self.other)
        return ObservedContact(self, world)


class Relation(Protocol):
    """An observed relation."""

    @property
    def size(self) -> int:
        """The number of observed numbers."""

    def read(self) -> Array:
        """Return the present numbers, (size,)."""

    def number(self) -> float:
        """Return the present number for the reward."""


class ObservedPose:
    """The position (3) [m] and the x and y axes (6) [1] of a body in the axes of another."""

    size = 9

    def __init__(self, pose: RelativePose) -> None:
        self._pose = pose

    def read(self) -> Array:
        """Return the position and the axes, (9,)."""
        return np.concatenate([self._pose.position(), self._pose.axes()])

    def number(self) -> float:
        """Return the distance [m]."""
        return self._pose.distance()


class ObservedContact:
    """1 if two bodies were in contact in the last step, else 0."""

    size = 1

    def __init__(self, spec: ContactSpec, world: World) -> None:
        self._spec, self._world = spec, world
        world.contacts(spec.target)

    def read(self) -> Array:
        """Return 1 or 0, (1,)."""
        return np.array([self.number()])

    def number(self) -> float:
        """Return 1 or 0."""
        return float(self._spec.other in self._world.contact_forces(self._spec.target))


def bind_relations(
    specs: Sequence[RelativePoseSpec | ContactSpec], world: World
) -> dict[str, Relation]:
    """Return the relations by name; raises UnknownName if a body is unknown."""
    return {spec.name: spec.bind(world) for spec in specs}
