"""A scene draw: the scene with the values of one seed, and its images."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..base.geometry import Pose
from ..base.rng import stream
from ..benchmark.spec import BenchmarkSpec
from ..benchmark.updater_settings import benchmark_of_seed, updater_draws
from ..benchmark.updaters import SceneUpdater, bind_updaters, levels, ramp_level
from ..model.scene_model import SceneModel
from ..physics.compile_scene import compile_scene
from ..scene.spec import SceneSpec
from ..scene.variation import draw
from ..simulation import Simulation
from ..simulation.scenery.renderer_pool import RendererPool
from .camera import DatasetCamera, make_camera
from .image_files import (
    SONAR_FOLDERS,
    encode_colour,
    encode_depth,
    encode_mask,
    file_paths,
    write_file,
)
from .instances import InstanceTable, find_instances
from .labels import label_image, round_values
from .request import DatasetRequest
from .sonar_images.dataset_sonar import (
    DatasetSonar,
    camera_pose_at,
    make_sonar,
    world_from_sonar_at,
)
from .sonar_images.ping_labels import label_ping
from .viewpoints import Viewpoint, ViewpointSampler

MAX_SCENE_SEED = 2**31
"""The bound of the seeds of scene draws."""


@dataclass(frozen=True, eq=False)
class DatasetSources:
    """The specs of a data set; a worker process receives them."""

    scene: SceneSpec
    """The scene, with the variations of the request."""
    benchmark: BenchmarkSpec | None
    """The benchmark, whose levels the images have; None for a scene."""
    folders: tuple[Path, ...]
    """The folders in which files are searched."""

    @property
    def varies(self) -> bool:
        """True if scene draws differ."""
        return bool(self.scene.vary) or bool(self.benchmark is not None and self.benchmark.vary)


class SceneDraw:
    """One scene draw of a data set, open for rendering.

    Args:
        request: the request.
        sources: the specs.
        number: the number of the scene draw, from 0.
        pool: the renderers of the process.
        model: the compiled scene if scene draws do not differ; None: it is compiled.
    """

    def __init__(
        self,
        request: DatasetRequest,
        sources: DatasetSources,
        number: int,
        pool: RendererPool,
        model: SceneModel | None = None,
    ) -> None:
        self._request, self._sources = request, sources
        self.scene_seed = find_scene_seed(request, sources, number)
        """The seed of the scene's variations."""
        self.model = model or compile_scene(
            sources.scene, seed=self.scene_seed, data_path=sources.folders
        )
        """The compiled scene."""
        self._simulation = simulation = Simulation(self.model, pool=pool, is_blind=True)
        self._sonar = None if request.sonar is None else make_sonar(simulation, request)
        self._camera: DatasetCamera = make_camera(simulation, request)
        self._updaters: tuple[SceneUpdater, ...] = ()
        self._levels: list[Any] = []
        benchmark = sources.benchmark
        if benchmark is not None:
            benchmark = benchmark_of_seed(benchmark, self.scene_seed)
            updater = benchmark.scene_updater
            self._updaters = bind_updaters(updater, simulation.world.stage_view)
            self._levels = levels(updater)
        self._observe_poses()
        self._drawn_values = {
            value.path: value.value
            for value in (
                *draw(sources.scene, self.scene_seed),
                *(
                    ()
                    if sources.benchmark is None
                    else updater_draws(sources.benchmark, self.scene_seed)
                ),
            )
        }

    def _observe_poses(self) -> None:
        """Find the instances at their present poses."""
        simulation = self._simulation
        self._pose_version = simulation.world.engine.poses.version
        self.table: InstanceTable = find_instances(
            simulation, self._request.classes
        ).with_keypoints(self._request.keypoints)
        """The instances of the scene."""
        sonar = self._sonar
        self._sampler = ViewpointSampler(
            simulation,
            self.table,
            self._request,
            self._camera.intrinsics if sonar is None else sonar.frame,
            None if sonar is None else sonar.reach,
        )

    def close(self) -> None:
        """Release the renderer and the files of updaters."""
        for updater in self._updaters:
            updater.close()
        self._simulation.close()

    def write_image(self, index: int) -> dict[str, Any]:
        """Render image ``index``, write its files, and return its record."""
        request, simulation = self._request, self._simulation
        level = self._set_surroundings(index)
        viewpoint = self._choose_viewpoint(index)
        if self._sonar is not None:
            return self._write_ping(index, level, viewpoint, self._sonar)
        pose = viewpoint.world_from_camera
        pixels, image = self._camera.take(simulation, pose, self._stream(index, "noise"))
        labels = label_image(simulation, self.table, pose, image)
        paths = file_paths(index, request.encoding)
        contents = {
            "images": encode_colour(pixels.astype(np.uint8, copy=False), request.encoding),
            "depth": encode_depth(labels.depth),
            "instances": encode_mask(labels.instance_mask),
            "classes": encode_mask(labels.class_mask),
        }
        for folder, content in contents.items():
            write_file(request.out / paths[folder], content)
        return {
            **self._describe_draw(index, paths, level),
            "water": self._describe_water(),
            "target": viewpoint.target,
            "camera": _round_numbers(self._camera.describe(pose)),
            "instances": labels.instances,
        }

    def _write_ping(
        self, index: int, level: dict[str, float], viewpoint: Viewpoint, sonar: DatasetSonar
    ) -> dict[str, Any]:
        """Ping, write the files of the image, and return its record."""
        pose = world_from_sonar_at(viewpoint.world_from_camera)
        paths = file_paths(index, self._request.encoding, SONAR_FOLDERS)
        pixels = sonar.take(pose, self._stream(index, "noise"))
        labels = label_ping(self._simulation, self.table, sonar, pose)
        contents = {
            "images": encode_colour(pixels, self._request.encoding),
            "instances": encode_mask(labels.instance_mask),
            "classes": encode_mask(labels.class_mask),
        }
        for folder, content in contents.items():
            write_file(self._request.out / paths[folder], content)
        return {
            **self._describe_draw(index, paths, level),
            "target": viewpoint.target,
            "sonar": _round_numbers(sonar.describe(pose)),
            "instances": labels.instances,
        }

    def _describe_draw(
        self, index: int, paths: dict[str, str], level: dict[str, float]
    ) -> dict[str, Any]:
        return {
            "index": index,
            "files": paths,
            "scene_seed": self.scene_seed,
            "variations": self._drawn_values,
            "level": level,
        }

    def _stream(self, index: int, name: str) -> np.random.Generator:
        return stream(self._request.seed, f"dataset/{index}/{name}")

    def _set_surroundings(self, index: int) -> dict[str, float]:
        """Set the level, the fog and the light of an image; return the values of the level."""
        rng = self._stream(index, "surroundings")
        shares = rng.uniform(size=2)
        values: dict[str, float] = {}
        if self._levels:
            level = self._levels[int(rng.integers(len(self._levels)))]
            ramp_level(self._updaters, level)
            values = {str(name): float(value) for name, value in level.values}
            if self._simulation.world.engine.poses.version != self._pose_version:
                self._observe_poses()
        if self._request.fog is not None:
            self._simulation.set_fog(self._request.fog.value(shares[0]))
        if self._request.light is not None:
            self._simulation.set_light(self._request.light.value(shares[1]))
        return values

    def _choose_viewpoint(self, index: int) -> Viewpoint:
        if self._request.is_mounted and self._sonar is not None:
            return Viewpoint(camera_pose_at(self._sonar.sonar.world_from_sonar), "", 0.0)
        if self._request.is_mounted:
            camera = self._simulation.world.sensors.camera(self._request.camera or "")
            pose = camera.world_from_camera
            return Viewpoint(Pose(pose.position.copy(), pose.rotation.copy()), "", 0.0)
        return self._sampler.sample(self._stream(index, "viewpoint"))

    def _describe_water(self) -> dict[str, Any]:
        state = self._simulation.world.scenery.state
        water = state.water
        description: dict[str, Any] = {
            "model": self._simulation.world.scenery.image_model,
            "light_rate": round_values(state.light.rate),
        }
        if water.physical_water is None:
            description["fog"] = round_values(water.fog)
            description["fog_colour"] = round_values(water.fog_colour)
            description["colour"] = round_values(water.colour)
            description["attenuation"] = round_values(water.attenuation)
        else:
            medium = water.physical_water.medium
            description["absorption"] = round_values(medium.absorption)
            description["scattering"] = round_values(medium.scattering)
        return description


def find_scene_seed(request: DatasetRequest, sources: DatasetSources, number: int) -> int:
    """Return the seed of a scene draw's variations; that of the request if nothing varies."""
    if not sources.varies:
        return request.seed
    return int(stream(request.seed, f"dataset/scene/{number}").integers(MAX_SCENE_SEED))


def record_line(record: dict[str, Any]) -> str:
    """Return a record as one line of JSON."""
    return json.dumps(record, ensure_ascii=True, allow_nan=False, separators=(",", ":"))


def _round_numbers(values: dict[str, Any]) -> dict[str, Any]:
    return {
        name: _round_numbers(value)
        if isinstance(value, dict)
        else (round_values(value) if isinstance(value, float | list) else value)
        for name, value in values.items()
    }


def render_draw(
    request: DatasetRequest,
    sources: DatasetSources,
    number: int,
    indices: range,
    pool: RendererPool,
    model: SceneModel | None,
) -> Iterator[dict[str, Any]]:
    """Write the images of a scene draw, and yield their records.

    Args:
        request: the request.
        sources: the specs.
        number: the number of the scene draw.
        indices: the indices of its images.
        pool: the renderers of the process.
        model: the compiled scene if scene draws do not differ.
    """
    scene_draw = SceneDraw(request, sources, number, pool, model)
    try:
        for index in indices:
            yield scene_draw.write_image(index)
    finally:
        scene_draw.close()
