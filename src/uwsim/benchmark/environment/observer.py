"""The observation of an environment: a vector of the state's quantities and of topics' numbers."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...base.geometry import Array
from ...world import ImageView, World
from ..measures import MeasureSpec
from ..metrics.reference import Reference
from .channels import CHANNELS, VehicleState
from .path_view import PathView
from .relations import bind_relations
from .spec import EnvironmentSpec
from .topic_fields import TopicField

MAX_OBSERVATION = 1e6
"""The bound to which the numbers of an observation are limited."""


def bind_images(spec: EnvironmentSpec, world: World) -> dict[str, ImageView]:
    """Return the observed images by name.

    Raises:
        UnknownName: the scene lacks a camera or sonar.
        BadSetting: a sensor has no such images.
    """
    return {
        image.name: world.image_view(image.sensor, image.content, image.size)
        for image in spec.image
    }


def limit_numbers(parts: Sequence[Array]) -> Array:
    """Return the parts of an observation as one vector, limited to `MAX_OBSERVATION`."""
    vector = np.concatenate(parts, axis=-1) if parts else np.zeros(0)
    numbers: Array = np.clip(vector, -MAX_OBSERVATION, MAX_OBSERVATION)
    return numbers


class Observer:
    """The reader of an environment's observation.

    Args:
        spec: the environment.
        measures: the measures of the benchmark, one of which may have the desired position or
            the path.
        world: the scene.
        n_actions: the number of numbers of an action.

    Raises:
        UnknownName: the scene lacks the vehicle, a topic, or a topic the field.
    """

    def __init__(
        self,
        spec: EnvironmentSpec,
        measures: Sequence[MeasureSpec],
        world: World,
        n_actions: int,
    ) -> None:
        self._world, self._vehicle = world, spec.vehicle
        trajectory = spec.trajectory(measures)
        self._reference = (
            None
            if trajectory is None
            else Reference(trajectory, world, relative_to=spec.reference_vehicle(measures))
        )
        path = spec.path_measure(measures)
        self._path = None if path is None else PathView(path, world)
        self._channels = [CHANNELS[name] for name in spec.channels]
        self._relations = bind_relations(spec.relations, world)
        self._fields = [TopicField(field, world) for field in spec.topic_field]
        sizes = [n_actions if size is None else size for size, _ in self._channels]
        names = [
            *spec.channels,
            *self._relations,
            *(f"{f.topic}:{f.field}" for f in spec.topic_field),
        ]
        sizes += [relation.size for relation in self._relations.values()]
        sizes += [field.size for field in self._fields]
        self.layout: tuple[tuple[str, int], ...] = tuple(zip(names, sizes, strict=True))
        """The name and the size of each part of the vector, in order."""
        self.size = sum(sizes)
        """The size of the vector."""

    def state(self, last_action: Array) -> VehicleState:
        """Return the present state of the vehicle."""
        return VehicleState.read(
            self._world, self._vehicle, self._reference, last_action, self._path
        )

    def read(self, last_action: Array) -> Array:
        """Return the present observation, limited to `MAX_OBSERVATION`, (size,)."""
        state = self.state(last_action)
        relations = (relation.read() for relation in self._relations.values())
        fields = (field.read() for field in self._fields)
        return limit_numbers([*self.read_channels(state), *relations, *fields])

    def read_relations(self) -> dict[str, float]:
        """Return the present numbers of the relations for the reward, by name."""
        return {name: relation.number() for name, relation in self._relations.items()}

    def read_channels(self, state: VehicleState) -> list[Array]:
        """Return the numbers of the observed quantities of a state."""
        return [read(state) for _, read in self._channels]

    def close(self) -> None:
        """End the subscriptions."""
        for field in self._fields:
            field.close()
