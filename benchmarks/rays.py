"""The project's own ray caster (`uwsim.rays`) beside MuJoCo's `mj_multiRay`: time and hits.

The same rays in bundled scenes, from a Girona 500: the one of a range sensor, the 1216 of 64 beams
of 1 degree of a multibeam, the 4240 of an imaging sonar of 512 beams and 16 rows, all from under
the bow; and those of the multibeam from where `survey-scene` mounts it, in the hull. They are cast
three times: by `uwsim.rays`; by MuJoCo in the engine's model (``engine``), which holds collision
shapes; and by MuJoCo in a model that is made here of the triangles of `uwsim.rays`, one mesh a
body, without contacts (``meshes``). Only `uwsim.rays` turns the rays into W and places bodies.

``ratio`` is MuJoCo's time over that of `uwsim.rays`: below 1 MuJoCo is faster. ``differ`` is the
share of rays whose distance is not that of `uwsim.rays` within 1 mm, the sum of three: MuJoCo meets
nothing (``missed``), only MuJoCo meets something (``extra``), both do (``moved``; ``moved_by_m`` is
the median). ``same_within_um`` is by how much the others differ at most. One JSON on stdout.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from functools import partial
from statistics import median

import mujoco
import numpy as np
from measure import main

import uwsim
from uwsim.base.geometry import Array, Pose
from uwsim.rays import RayScene, Surface
from uwsim.sensors.pencil import pencil_rays
from uwsim.sensors.sonar.imaging_sonar import ImagingSonarSpec
from uwsim.sensors.sonar.ray_grid import RayGrid
from uwsim.simulation import Simulation

SCENES = ("shipwreck-scene", "shapes-scene", "survey-scene", "cirs", "dredging-scene")
"""The scenes: a sea floor with a wreck, solids, a sea floor with objects, a tank, and sand."""
BOW, HULL = (0.75, 0.0, 0.4), (0.4, 0.0, 0.7)
"""The positions of the sensors in the frame of the vehicle, whose z axis points down [m]."""
MAX_RANGE = 50.0
"""The maximum range of all rays [m]."""
TILT = 0.3
"""The tilt of the sonar, downwards [rad]."""
TOLERANCE = 1e-3
"""The tolerance of equal distances [m]."""
BATCHES = 9
BATCH_S = 0.02
"""The approximate CPU time of a batch, which has at least one call [s]."""
Caster = tuple[mujoco.MjModel, mujoco.MjData]


def sensor_rays() -> Mapping[str, tuple[tuple[float, float, float], Array]]:
    """Return mount and directions of the rays of each sensor: x ahead, y to port, z up, (n, 3)."""
    angles = np.radians(np.linspace(-60.0, 60.0, 64))
    beams = np.stack([0.0 * angles, np.sin(angles), -np.cos(angles)], axis=1)
    forward_axes = np.tile([1.0, 0.0, 0.0], (len(beams), 1))
    pencils = np.ascontiguousarray(
        pencil_rays(beams, forward_axes, np.radians(1.0))[0].reshape(-1, 3)
    )
    spec = ImagingSonarSpec(
        name="sonar", relative_to="base_link", beams=512, bins=500, rows=16, range=MAX_RANGE
    )
    grid = RayGrid(spec, spec.azimuths, float(spec.azimuths[1] - spec.azimuths[0]))
    c, s = np.cos(TILT), np.sin(TILT)
    down = np.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]])
    return {
        "range sensor": (BOW, np.array([[0.0, 0.0, -1.0]])),
        "multibeam": (BOW, pencils),
        "sonar": (BOW, np.ascontiguousarray(grid.directions @ down.T)),
        "multibeam in the hull": (HULL, pencils),
    }


def sensor_pose(simulation: Simulation, mount: tuple[float, float, float]) -> Pose:
    """Return the pose of a sensor: level, with the heading of the vehicle."""
    frame = simulation.world.engine.poses.link_frame(0, "base_link")
    heading = np.arctan2(frame[1, 0], frame[0, 0])
    c, s = np.cos(heading), np.sin(heading)
    rotation = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    return Pose((frame @ [*mount, 1.0])[:3], rotation)


def triangles_by_body(scene: RayScene) -> list[Array]:
    """Return the triangles of each body of a ray scene in W, (n, 3, 3) each [m]."""
    trees, frames, triangles = scene._trees, scene.frames(), []
    for body, nodes in enumerate(np.split(trees.links, trees.roots[1:])):
        leaves = nodes.reshape(-1, 2)[nodes.reshape(-1, 2)[:, 1] > 0]
        order = [np.arange(start_row, start_row + n) for start_row, n in leaves]
        rows = trees.triangles[np.concatenate(order)] if order else np.zeros((0, 9))
        corners = rows.reshape(-1, 3, 3) + np.array([[0.0], [1.0], [1.0]]) * rows[:, None, :3]
        frame = frames[body]
        triangles.append(corners @ frame[:3, :3].T + frame[:3, 3])
    return triangles


def engine_caster(simulation: Simulation) -> Caster:
    """Return a model with all fixed shapes, which the running engine hides, and its state."""
    model = simulation.world.model.engine_model
    data = mujoco.MjData(model)
    data.qpos[:] = simulation.world.engine._data.qpos
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)
    return model, data


def mesh_caster(bodies: list[Array]) -> Caster:
    """Return a MuJoCo model of triangles in W, one mesh a body, without contacts."""
    spec = mujoco.MjSpec()
    for number, corners in enumerate(bodies):
        points, faces = np.unique(corners.reshape(-1, 3), axis=0, return_inverse=True)
        faces = faces.reshape(-1, 3)
        if not len(faces):
            continue
        mesh = spec.add_mesh(name=f"mesh{number}")
        mesh.inertia = mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL
        mesh.uservert, mesh.userface = points.reshape(-1), faces.reshape(-1)
        body = spec.worldbody.add_body(name=f"body{number}")
        body.add_geom(
            type=mujoco.mjtGeom.mjGEOM_MESH, meshname=f"mesh{number}", contype=0, conaffinity=0
        )
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)
    return model, data


def mujoco_cast(caster: Caster, origin: Array, directions: Array) -> Callable[[], Array]:
    """Return a function that casts rays (n, 3) in W with `mj_multiRay`: distances (n,) [m]."""
    model, data = caster
    n = len(directions)
    flat_directions, shapes = directions.reshape(-1), np.empty(n, dtype=np.int32)
    distance, normal = np.empty(n), np.empty(3 * n)

    def cast() -> Array:
        mujoco.mj_multiRay(
            model,
            data,
            origin,
            flat_directions,
            None,
            True,
            -1,
            shapes,
            distance,
            normal,
            n,
            MAX_RANGE,
        )
        return np.where((distance < 0.0) | (distance > MAX_RANGE), np.inf, distance)

    return cast


def measure_alternately(calls: Mapping[str, Callable[[], object]]) -> dict[str, float]:
    """Measure median CPU microseconds of each call, in alternating batches."""
    numbers = {}
    for name, call in calls.items():
        call()
        start_time = time.process_time()
        call()
        numbers[name] = max(1, int(BATCH_S / max(time.process_time() - start_time, 2e-6)))
    call_times: dict[str, list[float]] = {name: [] for name in calls}
    for _ in range(BATCHES):
        for name, call in calls.items():
            start_time = time.process_time()
            for _ in range(numbers[name]):
                call()
            call_times[name].append((time.process_time() - start_time) * 1e6 / numbers[name])
    return {name: median(times) for name, times in call_times.items()}


def compare_distances(distances: Array, other_distances: Array) -> dict[str, float]:
    """Compare distances (n,) [m] of another caster with those of `uwsim.rays`."""
    are_finite = np.isfinite(distances) & np.isfinite(other_distances)
    deviations = np.abs(distances[are_finite] - other_distances[are_finite])
    large_deviations, small_deviations = (
        deviations[deviations > TOLERANCE],
        deviations[deviations <= TOLERANCE],
    )
    counts = {
        "missed": int((np.isfinite(distances) & np.isinf(other_distances)).sum()),
        "extra": int((np.isinf(distances) & np.isfinite(other_distances)).sum()),
        "moved": len(large_deviations),
    }
    return {
        "differ": round(sum(counts.values()) / len(distances), 5),
        **{kind: round(count / len(distances), 5) for kind, count in counts.items()},
        "moved_by_m": round(float(np.median(large_deviations)), 4)
        if len(large_deviations)
        else 0.0,
        "same_within_um": round(1e6 * float(small_deviations.max()), 3)
        if len(small_deviations)
        else 0.0,
    }


def measure_scene(name: str) -> dict[str, object]:
    """Measure a scene."""
    with uwsim.load(name, is_blind=True) as simulation:
        cast = simulation.world.rays.cast
        cast(sensor_pose(simulation, BOW), np.array([[1.0, 0.0, 0.0]]), MAX_RANGE)  # places bodies
        scene = simulation.world.rays._scene
        bodies = triangles_by_body(scene)
        casters = {"engine": engine_caster(simulation), "meshes": mesh_caster(bodies)}
        surfaces = [[Surface(1, part)] for part in bodies]
        build_times = measure_alternately(
            {"uwsim": lambda: RayScene(surfaces), "meshes": lambda: mesh_caster(bodies)}
        )
        figures: dict[str, object] = {
            "triangles": sum(map(len, bodies)),
            "engine_shapes": int(casters["engine"][0].ngeom),
            "build_ms": {kind: round(us / 1e3, 2) for kind, us in build_times.items()},
            "memory_kb": {
                "uwsim": round(sum(part.nbytes for part in scene._trees) / 1e3),
                "meshes": round(mujoco.mj_sizeModel(casters["meshes"][0]) / 1e3),
            },
        }
        for sensor, (mount, directions) in sensor_rays().items():
            pose = sensor_pose(simulation, mount)
            world_directions = np.ascontiguousarray(directions @ pose.rotation.T)
            mujoco_casts = {
                kind: mujoco_cast(c, pose.position, world_directions) for kind, c in casters.items()
            }
            uwsim_cast = partial(cast, pose, directions, MAX_RANGE)
            cast_times = measure_alternately({"uwsim": uwsim_cast, **mujoco_casts})
            figures[f"{sensor}, rays: {len(directions)}"] = {
                "us": {kind: round(us, 2) for kind, us in cast_times.items()},
                "ratio": {
                    kind: round(cast_times[kind] / cast_times["uwsim"], 2) for kind in mujoco_casts
                },
                **{
                    kind: compare_distances(uwsim_cast().distance, other())
                    for kind, other in mujoco_casts.items()
                },
            }
    return figures


def measure() -> dict[str, object]:
    """Measure all scenes."""
    return {name: measure_scene(name) for name in SCENES}


if __name__ == "__main__":
    main(measure)
