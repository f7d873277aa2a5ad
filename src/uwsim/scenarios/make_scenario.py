"""Making of a scenario from the log of a mission."""

from __future__ import annotations

import math
import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from ..assets.bundled import scene_file
from ..base.files.input_files import compute_hash
from ..devices.motion.scripted_motion import write_poses
from ..errors import BadSetting, UnknownName, name_file_in_errors
from ..logs import VehicleLog, read_log
from ..physics.compile_scene import compile_scene
from ..scene.reader import read_scene
from ..scene.spec import SceneSpec
from ..scene.writer import write_scene
from ..version import __version__
from ..virtual_sensors import choose_vehicle
from .benchmark_text import BenchmarkText
from .mission import Mission, cut_mission
from .recorded_images import RecordedImages, find_images, write_recording
from .request import ScenarioRequest
from .scenario_files import check_benchmark_file, copy_inputs, find_inputs, write_provenance
from .scenario_scene import (
    TRAJECTORY_FILE,
    choose_camera,
    find_noise,
    make_scenes,
    replace_water,
)

BENCHMARK_FILE, RENDERED_BENCHMARK_FILE = "benchmark.xml", "benchmark-rendered.xml"
SCENE_FILE, RENDERED_SCENE_FILE = "scene.xml", "scene-rendered.xml"
CHECKED_ALGORITHM = "frozen"
"""The algorithm with which the benchmarks are opened to check them."""
TIMESTEP = 0.002
"""The step of simulations, of which the interval of a level is a multiple [s]."""


@dataclass(frozen=True, kw_only=True)
class Scenario:
    """A scenario that has been written."""

    folder: Path
    """The folder."""
    duration: float
    """The duration of the mission [s]."""
    n_poses: int
    """The number of poses in the trajectory."""
    n_images: int
    """The number of recorded images; 0: views are rendered."""
    benchmarks: tuple[Path, ...]
    """The benchmark files."""
    remarks: tuple[str, ...]
    """The defects of the log, one sentence each."""


def make_scenario(request: ScenarioRequest) -> Scenario:
    """Make the folder of a scenario: scene, benchmark, trajectory, recording and provenance.

    Raises:
        BadSetting: the folder exists, or the request does not fit the log or the scene.
        UwsimError: an input is invalid.
    """
    if request.out.exists():
        raise BadSetting(f"{request.out} exists; a scenario is written into a new folder.")
    log = read_log(request.log, mapping=request.mapping)
    images = find_images(request) if request.images else None
    mission = cut_mission(log, request, *_find_times(log, request, images))
    base = _read_base(request)
    vehicle = choose_vehicle(base, log, request.vehicle)
    camera = None
    if images is not None or request.target is not None or request.camera is not None:
        camera = choose_camera(base, vehicle, request.camera)
    names = [spec.name for spec in base.objects]
    if request.target is not None and request.target not in names:
        raise UnknownName("object", request.target, names)
    with _new_folder(request.out) as folder:
        benchmarks = _write_files(folder, request, base, mission, images, vehicle, camera)
        bundled_files: dict[str, str] = {}
        for name in benchmarks:
            bundled_files |= check_benchmark_file(folder / name, CHECKED_ALGORITHM)
        write_provenance(folder, _describe_sources(request, log, mission), bundled_files)
    return Scenario(
        folder=request.out,
        duration=mission.duration,
        n_poses=len(mission.times),
        n_images=0 if images is None else len(images.times),
        benchmarks=tuple(request.out / name for name in benchmarks),
        remarks=log.remarks,
    )


def _find_times(
    log: VehicleLog, request: ScenarioRequest, images: RecordedImages | None
) -> tuple[float, float]:
    """Return the times in the log at which the mission begins and ends [s].

    With images it begins with the first one, and ends an interval after the last.
    """
    if images is not None:
        gap = (images.times[-1] - images.times[0]) / (len(images.times) - 1)
        return images.times[0], images.times[-1] + gap
    motion = log.motion
    if motion is None:
        raise BadSetting(f"{log.path}: the log has no poses.")
    start = max(request.start, float(motion.times[0]))
    return start, float(motion.times[-1]) if request.end is None else request.end


def _read_base(request: ScenarioRequest) -> SceneSpec:
    """Return the base scene with its water, and the drawn values of its variations."""
    scene = read_scene(scene_file(request.scene, request.folders), data_path=request.folders)
    if scene.vary:
        model = compile_scene(scene, seed=request.seed, data_path=request.folders)
        scene = replace(model.scene, vary=())
    return scene


def _write_files(
    folder: Path,
    request: ScenarioRequest,
    base: SceneSpec,
    mission: Mission,
    images: RecordedImages | None,
    vehicle: str,
    camera: str | None,
) -> list[str]:
    """Write all files but the provenance; return the names of the benchmarks."""
    copy_inputs(find_inputs(base, request), base, folder)
    scene = base
    if request.water is not None:
        scene = replace_water(base, request.water)
        if request.water.suffix.lower() == ".json":
            shutil.copyfile(request.water, folder / request.water.name)
    poses = write_poses(mission.times, mission.positions, mission.quaternions)
    (folder / TRAJECTORY_FILE).write_text(poses, encoding="utf-8")
    scenes = make_scenes(scene, vehicle, camera, request)
    interval = max(math.floor(mission.duration / TIMESTEP + 1e-6), 1) * TIMESTEP
    text = BenchmarkText(
        scene=SCENE_FILE,
        vehicle=vehicle,
        camera=camera,
        target=request.target,
        interval=float(np.round(interval, 6)),
        levels=request.levels,
        has_physical_water=scene.ocean_state.water is not None,
    )
    if images is None:
        _write_text(folder / SCENE_FILE, write_scene(scenes.rendered_scene))
        _write_text(folder / BENCHMARK_FILE, text.write())
        return [BENCHMARK_FILE]
    assert camera is not None
    image_depth = write_recording(
        folder, request, base, images, mission, vehicle=vehicle, camera=camera
    )
    _write_text(folder / SCENE_FILE, write_scene(scenes.recorded_scene))
    _write_text(folder / RENDERED_SCENE_FILE, write_scene(scenes.rendered_scene))
    noise = find_noise(base, vehicle, camera)
    recorded_text = replace(text, has_recording=True, image_depth=image_depth, noise=noise)
    _write_text(folder / BENCHMARK_FILE, recorded_text.write())
    rendered_levels = None if text.has_physical_water else request.levels
    rendered_text = replace(text, scene=RENDERED_SCENE_FILE, levels=rendered_levels)
    _write_text(folder / RENDERED_BENCHMARK_FILE, rendered_text.write())
    return [BENCHMARK_FILE, RENDERED_BENCHMARK_FILE]


def _write_text(path: Path, text: str) -> None:
    path.write_text(text, encoding="utf-8")


def _describe_sources(
    request: ScenarioRequest, log: VehicleLog, mission: Mission
) -> dict[str, Any]:
    scene_path = scene_file(request.scene, request.folders)
    water = request.water
    return {
        "uwsim": __version__,
        "log": {
            "name": request.log.name,
            "sha256": log.sha256,
            "format": log.format,
            "start": log.start,
            "from": mission.start,
            "to": mission.start + mission.duration,
            "remarks": list(log.remarks),
        },
        "scene": {"name": scene_path.name, "sha256": compute_hash(scene_path)},
        "water": None if water is None else {"name": water.name, "sha256": compute_hash(water)},
        "images": request.images or None,
        "seed": request.seed,
    }


@contextmanager
def _new_folder(path: Path) -> Iterator[Path]:
    """Yield a draft of a folder, which gets its name if the block ends without error."""
    path.parent.mkdir(parents=True, exist_ok=True)
    draft = path.with_name(f".{path.name}.{os.getpid()}.part")
    shutil.rmtree(draft, ignore_errors=True)
    try:
        with name_file_in_errors(path, draft):
            draft.mkdir()
            yield draft
            draft.rename(path)
    finally:
        shutil.rmtree(draft, ignore_errors=True)
