"""What a scene looks like: its models, where they stand, and the renderer that draws them."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
import numpy.typing as npt

from ..devices.lamp import LampSpec
from ..errors import UwsimError
from ..geometry import Intrinsics, Pose
from ..linear import product
from ..physics.state import State
from ..rendering.lamp import Lamp
from ..rendering.lamps import MOST_LAMPS
from ..rendering.renderer import Picture, Renderer
from ..rendering.water import Light, Water
from ..scene.spec import SceneSpec
from ..scene.urdf import RobotSpec
from ..sensors.sensor import Carrier
from ..world import Body
from .parts import Part, parts_of
from .studio import Studio


class Scenery:
    """The models of a scene; borrows a renderer when the first picture is asked for."""

    def __init__(
        self,
        scene: SceneSpec,
        robots: Mapping[int, RobotSpec],
        state: State,
        carriers: Sequence[Carrier],
        data_path: tuple[Path, ...],
        studio: Studio | None,
    ) -> None:
        self._state = state
        self._own_studio = Studio()
        self._studio = studio or self._own_studio
        self._renderer: Renderer | None = None
        self._handles: list[int] = []  # of each part
        self._drawn_version = -1
        self.parts = tuple(parts_of(scene, robots, data_path))
        self._hidden = frozenset(part.id for part in self.parts if part.is_hidden)
        self._mounted_lamps = _mounted_lamps(scene, carriers)
        self._lamps: tuple[Lamp, ...] = ()

    def world_from_mesh(self, part: Part) -> npt.NDArray[np.float64]:
        """Where a part stands now, with its scale, (4, 4) [m]."""
        if part.vehicle is None:
            assert part.object is not None
            frame = self._state.object_pose(part.object).matrix
        else:
            frame = self._state.link_frame(part.vehicle, part.link)
        return product(frame, part.frame_from_mesh)

    def draw(
        self,
        world_from_camera: Pose,
        intrinsics: Intrinsics,
        water: Water,
        light: Light,
        *,
        targets: frozenset[str],
        colour: str,
        hidden: frozenset[int] | None = None,
    ) -> Picture:
        """Draw what a camera sees, without the parts ``hidden``; None: without ghosts."""
        renderer = self._open()
        if not self._handles:
            self._handles = [renderer.add(part.model, part.id) for part in self.parts]
        if self._drawn_version != self._state.version:
            for part, handle in zip(self.parts, self._handles, strict=True):
                renderer.place(handle, self.world_from_mesh(part))
            self._lamps = tuple(self._lamp(*mounted) for mounted in self._mounted_lamps)
            self._drawn_version = self._state.version
        return renderer.draw(
            world_from_camera,
            intrinsics,
            water,
            light,
            targets=targets,
            colour=colour,
            hidden=self._hidden if hidden is None else hidden,
            lamps=self._lamps,
        )

    @property
    def renderer_name(self) -> str:
        """What draws the pictures."""
        return self._open().description

    def _lamp(self, mounted: Body, spec: LampSpec) -> Lamp:
        """The lamp as it shines now."""
        return Lamp(
            world_from_lamp=mounted.world_from_body,
            half_angle=math.radians(spec.fov / 2.0),
            softness=spec.softness,
            colour=spec.color,
            intensity=spec.intensity,
            casts_shadow=spec.shadow,
        )

    def _open(self) -> Renderer:
        if self._renderer is None:
            self._renderer = self._studio.borrow()
        return self._renderer

    def close(self) -> None:
        """Give the renderer back."""
        if self._renderer is not None:
            self._studio.give_back(self._renderer)
            self._renderer = None
            self._handles = []
            self._drawn_version = -1
        self._own_studio.close()


def _mounted_lamps(
    scene: SceneSpec, carriers: Sequence[Carrier]
) -> tuple[tuple[Body, LampSpec], ...]:
    """Every lamp that shines, and the frame that it hangs on."""
    mounted = [
        (carrier.mount(lamp), lamp)
        for vehicle, carrier in zip(scene.vehicles, carriers, strict=True)
        if not vehicle.vr
        for lamp in vehicle.lamps
    ]
    if len(mounted) > MOST_LAMPS:
        raise UwsimError(f"{len(mounted)} lamps shine in the scene; at most {MOST_LAMPS} may.")
    return tuple(mounted)
