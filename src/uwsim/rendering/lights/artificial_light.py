"""The light of the lamps and of the projector in an image, with their shadow maps."""

from __future__ import annotations

from collections.abc import Sequence

import moderngl

from ...base.geometry import Pose
from ..instance import Indices, Instances
from .caster_programs import CasterPrograms
from .lamp import Lamp
from .lamps import Lamps
from .projector import Projector
from .projector_light import ProjectorLight

Switches = tuple[tuple[str, int], ...]


class ArtificialLight:
    """The lamps and the projector of a renderer.

    Args:
        context: the context of the renderer.
        instances: all instances.
        samplers: the texture unit of every sampler.
        programs: the programs that draw shadow maps.
    """

    def __init__(
        self,
        context: moderngl.Context,
        instances: Instances,
        samplers: dict[str, int],
        programs: CasterPrograms,
    ) -> None:
        self._context, self._instances, self._samplers = context, instances, samplers
        self._programs = programs
        self._lamps: Lamps | None = None
        self._projector: ProjectorLight | None = None

    def prepare(
        self,
        lamps: Sequence[Lamp],
        projector: Projector | None,
        casters: Indices,
        world_from_camera: Pose,
        hidden_ids: frozenset[int],
    ) -> Switches:
        """Update the shadow maps and the uniform blocks, and bind the textures.

        Args:
            lamps: the lamps.
            projector: the projector of a pattern, if there is one.
            casters: the instances that may cast shadows.
            world_from_camera: the pose of the camera; OpenGL axes.
            hidden_ids: the ids of instances that are not drawn.

        Returns:
            The switches of the shaders of surfaces.
        """
        switches: Switches = ()
        if lamps:
            switches += (("LAMPS", len(lamps)),)
            self._update_lamps(lamps, casters, world_from_camera, hidden_ids)
        if projector is not None:
            switches += (("PROJECTOR", 1),)
            self._update_projector(projector, casters, world_from_camera, hidden_ids)
        return switches

    def _update_lamps(
        self,
        lamps: Sequence[Lamp],
        casters: Indices,
        world_from_camera: Pose,
        hidden_ids: frozenset[int],
    ) -> None:
        if self._lamps is None:
            self._lamps = Lamps(self._context, self._programs)
        self._lamps.update(lamps, self._instances, casters, (self._instances.version, hidden_ids))
        self._lamps.fill(lamps, world_from_camera)
        self._lamps.texture.use(self._samplers["lamp_maps"])

    def _update_projector(
        self,
        projector: Projector,
        casters: Indices,
        world_from_camera: Pose,
        hidden_ids: frozenset[int],
    ) -> None:
        if self._projector is None:
            self._projector = ProjectorLight(self._context, self._programs)
        version = self._instances.version, hidden_ids
        self._projector.update(projector, self._instances, casters, version)
        self._projector.fill(projector, world_from_camera)
        self._projector.use(
            shadow_map=self._samplers["projector_map"],
            pattern=self._samplers["projector_pattern"],
        )
