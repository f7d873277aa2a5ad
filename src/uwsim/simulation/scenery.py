"""What a scene looks like: its models, where they stand, and the renderer that draws them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt

from ..assets import load_model, primitive, unknown_model
from ..assets.mesh import Model
from ..devices.lamp import LampSpec
from ..errors import AssetNotFound, UnknownName, UwsimError
from ..geometry import Intrinsics, Pose
from ..physics.state import State
from ..rendering.lamp import Lamp
from ..rendering.lamps import MOST_LAMPS
from ..rendering.renderer import Picture, Renderer
from ..rendering.water import Light, Water
from ..scene.spec import SceneSpec
from ..scene.urdf import RobotSpec, VisualSpec
from .studio import Studio


@dataclass(frozen=True, eq=False)
class Part:
    """One model of the scene and whose it is."""

    id: int
    """Number in segmentation pictures, from 1."""
    name: str
    """``vehicle/link`` or the object's name."""
    model: Model
    vehicle: int | None
    """Number of the vehicle; None for an object."""
    link: str
    """Link of the vehicle; empty for an object."""
    object: int | None
    """Number of the object; None for a link."""
    frame_from_mesh: npt.NDArray[np.float64]
    """Mesh frame in the link's or object's frame, (4, 4) [m]; an object's scale is in it."""
    scale: tuple[float, float, float]
    """Scale of the vehicle as a whole, in its base frame."""
    is_hidden: bool
    """Ghosts (``vr``) are seen in the viewer, not by virtual cameras."""


class Scenery:
    """The models of a scene; borrows a renderer when the first picture is asked for."""

    def __init__(
        self,
        scene: SceneSpec,
        robots: Mapping[int, RobotSpec],
        state: State,
        data_path: tuple[Path, ...],
        studio: Studio | None,
    ) -> None:
        self._state = state
        self._own_studio = Studio()
        self._studio = studio or self._own_studio
        self._renderer: Renderer | None = None
        self._handles: dict[int, int] = {}
        self._drawn_version = -1
        self.parts = tuple(_parts(scene, robots, data_path))
        self._hidden = frozenset(part.id for part in self.parts if part.is_hidden)
        self._mounted_lamps = _mounted_lamps(scene, robots)
        self._lamps: tuple[Lamp, ...] = ()

    def world_from_mesh(self, part: Part) -> npt.NDArray[np.float64]:
        """Where a part stands now, with its scale, (4, 4) [m]."""
        if part.vehicle is None:
            assert part.object is not None
            frame = self._state.object_pose(part.object).matrix
        elif part.scale == (1.0, 1.0, 1.0):
            frame = self._state.link_pose(part.vehicle, part.link).matrix
        else:
            world_from_base = self._state.vehicle_pose(part.vehicle)
            base_from_link = world_from_base.inverse() @ self._state.link_pose(
                part.vehicle, part.link
            )
            frame = world_from_base.matrix @ np.diag([*part.scale, 1.0]) @ base_from_link.matrix
        placed: npt.NDArray[np.float64] = frame @ part.frame_from_mesh
        return placed

    def draw(
        self,
        world_from_camera: Pose,
        intrinsics: Intrinsics,
        water: Water,
        light: Light,
        *,
        targets: frozenset[str],
        colour: str,
    ) -> Picture:
        """Draw what a camera sees."""
        renderer = self._open()
        if not self._handles:
            self._handles = {part.id: renderer.add(part.model, part.id) for part in self.parts}
        if self._drawn_version != self._state.version:
            for part in self.parts:
                renderer.place(self._handles[part.id], self.world_from_mesh(part))
            self._lamps = tuple(self._lamp(*mounted) for mounted in self._mounted_lamps)
            self._drawn_version = self._state.version
        return renderer.draw(
            world_from_camera,
            intrinsics,
            water,
            light,
            targets=targets,
            colour=colour,
            hidden=self._hidden,
            lamps=self._lamps,
        )

    @property
    def renderer_name(self) -> str:
        """What draws the pictures."""
        return self._open().description

    def _lamp(self, vehicle: int, spec: LampSpec) -> Lamp:
        """The lamp as it shines now."""
        link_from_lamp = Pose.from_rpy(spec.position, spec.orientation)
        return Lamp(
            world_from_lamp=self._state.link_pose(vehicle, spec.relative_to) @ link_from_lamp,
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
            self._handles = {}
            self._drawn_version = -1
        self._own_studio.close()


def _mounted_lamps(
    scene: SceneSpec, robots: Mapping[int, RobotSpec]
) -> tuple[tuple[int, LampSpec], ...]:
    """Number of the vehicle and spec of every lamp that shines."""
    mounted = [
        (index, lamp)
        for index, vehicle in enumerate(scene.vehicles)
        if not vehicle.vr
        for lamp in vehicle.lamps
    ]
    for index, lamp in mounted:
        links = [link.name for link in robots[index].links]
        if lamp.relative_to not in links:
            raise UnknownName("link", lamp.relative_to, links)
    if len(mounted) > MOST_LAMPS:
        raise UwsimError(f"{len(mounted)} lamps shine in the scene; at most {MOST_LAMPS} may.")
    return tuple(mounted)


def _parts(
    scene: SceneSpec, robots: Mapping[int, RobotSpec], data_path: tuple[Path, ...]
) -> list[Part]:
    parts: list[Part] = []
    beside = Path(scene.path).parent if scene.path else None
    for index, vehicle in enumerate(scene.vehicles):
        robot = robots[index]
        for link in robot.links:
            if link.visual is None:
                continue
            parts.append(
                Part(
                    len(parts) + 1,
                    f"{vehicle.name}/{link.name}",
                    visual_model(link.visual, Path(robot.path).parent, data_path),
                    index,
                    link.name,
                    None,
                    Pose.from_rpy(link.visual.position, link.visual.rpy).matrix
                    @ np.diag([*link.visual.scale, 1.0]),
                    vehicle.scale_factor,
                    bool(vehicle.vr),
                )
            )
    for index, thing in enumerate(scene.objects):
        parts.append(
            Part(
                len(parts) + 1,
                thing.name,
                object_model(thing.file, scene, beside, data_path),
                None,
                "",
                index,
                np.diag([*thing.scale_factor, 1.0]) @ thing.object_from_mesh.matrix,
                (1.0, 1.0, 1.0),
                False,
            )
        )
    return parts


def visual_model(visual: VisualSpec, beside: Path, data_path: tuple[Path, ...]) -> Model:
    """Load or make what a link looks like; a labelled box when its mesh is nowhere."""
    if visual.kind == "mesh":
        try:
            return load_model(visual.file, beside=beside, data_path=data_path)
        except AssetNotFound:  # `uwsim check` says so
            return unknown_model(visual.file)
    wide, _, tall = visual.size
    size = {"cylinder": (0.5 * wide, tall), "sphere": (0.5 * wide,)}.get(visual.kind, visual.size)
    if visual.colour is None:
        return primitive(visual.kind, size)
    return primitive(visual.kind, size, visual.colour)


def object_model(
    name: str, scene: SceneSpec, beside: Path | None, data_path: tuple[Path, ...]
) -> Model:
    """Load what an object looks like; in a scene of the original a labelled box if need be."""
    try:
        return load_model(name, beside=beside, data_path=data_path)
    except AssetNotFound:
        if not scene.is_original:
            raise
        return unknown_model(name)
