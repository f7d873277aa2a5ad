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
"""Relief with a wreck, solids, relief with objects, a tank, and sand without collision shapes."""
BOW, HULL = (0.75, 0.0, 0.4), (0.4, 0.0, 0.7)
"""Where sensors are in the frame of the vehicle, whose z axis points down [m]."""
REACH = 50.0
"""How far all rays go [m]."""
TILT = 0.3
"""Of the sonar, downwards [rad]."""
TOLERANCE = 1e-3
"""Distances that differ by more are not the same [m]."""
BATCHES = 9
BATCH_S = 0.02
"""CPU time of a batch, about; a batch is at least one call."""
Caster = tuple[mujoco.MjModel, mujoco.MjData]


def rays() -> Mapping[str, tuple[tuple[float, float, float], Array]]:
    """Mount and directions of the rays of each sensor: x ahead, y to port, z up, (n, 3)."""
    across = np.radians(np.linspace(-60.0, 60.0, 64))
    beams = np.stack([0.0 * across, np.sin(across), -np.cos(across)], axis=1)
    ahead = np.tile([1.0, 0.0, 0.0], (len(beams), 1))
    pencils = np.ascontiguousarray(pencil_rays(beams, ahead, np.radians(1.0))[0].reshape(-1, 3))
    spec = ImagingSonarSpec(
        name="sonar", relative_to="base_link", beams=512, bins=500, rows=16, range=REACH
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
    """Where the rays of a sensor begin: level, with the heading of the vehicle."""
    frame = simulation.world.engine.poses.link_frame(0, "base_link")
    heading = np.arctan2(frame[1, 0], frame[0, 0])
    c, s = np.cos(heading), np.sin(heading)
    turn = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    return Pose((frame @ [*mount, 1.0])[:3], turn)


def triangles_by_body(scene: RayScene) -> list[Array]:
    """The triangles of each body of a ray scene in W, (n, 3, 3) each [m]."""
    trees, frames, found = scene._trees, scene.frames(), []
    for body, nodes in enumerate(np.split(trees.links, trees.roots[1:])):
        leaves = nodes.reshape(-1, 2)[nodes.reshape(-1, 2)[:, 1] > 0]
        order = [np.arange(first, first + n) for first, n in leaves]
        rows = trees.triangles[np.concatenate(order)] if order else np.zeros((0, 9))
        corners = rows.reshape(-1, 3, 3) + np.array([[0.0], [1.0], [1.0]]) * rows[:, None, :3]
        frame = frames[body]
        found.append(corners @ frame[:3, :3].T + frame[:3, 3])
    return found


def engine_caster(simulation: Simulation) -> Caster:
    """The engine's model and state; of its own model, the running engine hides fixed shapes."""
    model = simulation.world.model.engine_model
    data = mujoco.MjData(model)
    data.qpos[:] = simulation.world.engine._data.qpos
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)
    return model, data


def mesh_caster(bodies: list[Array]) -> Caster:
    """A MuJoCo model of triangles in W, one mesh a body, that nothing can touch."""
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
    """A function that casts rays (n, 3) in W with `mj_multiRay`; distances (n,) [m]."""
    model, data = caster
    n = len(directions)
    flat, shapes = directions.reshape(-1), np.empty(n, dtype=np.int32)
    distance, normal = np.empty(n), np.empty(3 * n)

    def cast() -> Array:
        mujoco.mj_multiRay(
            model, data, origin, flat, None, True, -1, shapes, distance, normal, n, REACH
        )
        return np.where((distance < 0.0) | (distance > REACH), np.inf, distance)

    return cast


def alternating(calls: Mapping[str, Callable[[], object]]) -> dict[str, float]:
    """CPU microseconds of a call of each, a batch of one after a batch of the other; medians."""
    numbers = {}
    for name, call in calls.items():
        call()
        began = time.process_time()
        call()
        numbers[name] = max(1, int(BATCH_S / max(time.process_time() - began, 2e-6)))
    spent: dict[str, list[float]] = {name: [] for name in calls}
    for _ in range(BATCHES):
        for name, call in calls.items():
            began = time.process_time()
            for _ in range(numbers[name]):
                call()
            spent[name].append((time.process_time() - began) * 1e6 / numbers[name])
    return {name: median(each) for name, each in spent.items()}


def differences(own: Array, other: Array) -> dict[str, float]:
    """How far distances (n,) [m] are those of `uwsim.rays`."""
    both = np.isfinite(own) & np.isfinite(other)
    apart = np.abs(own[both] - other[both])
    moved, same = apart[apart > TOLERANCE], apart[apart <= TOLERANCE]
    counts = {
        "missed": int((np.isfinite(own) & np.isinf(other)).sum()),
        "extra": int((np.isinf(own) & np.isfinite(other)).sum()),
        "moved": len(moved),
    }
    return {
        "differ": round(sum(counts.values()) / len(own), 5),
        **{kind: round(count / len(own), 5) for kind, count in counts.items()},
        "moved_by_m": round(float(np.median(moved)), 4) if len(moved) else 0.0,
        "same_within_um": round(1e6 * float(same.max()), 3) if len(same) else 0.0,
    }


def row(name: str) -> dict[str, object]:
    """Measure a scene."""
    with uwsim.load(name, is_blind=True) as simulation:
        cast = simulation.world.rays.cast
        cast(sensor_pose(simulation, BOW), np.array([[1.0, 0.0, 0.0]]), REACH)  # places bodies
        scene = simulation.world.rays._scene
        bodies = triangles_by_body(scene)
        casters = {"engine": engine_caster(simulation), "meshes": mesh_caster(bodies)}
        surfaces = [[Surface(1, each)] for each in bodies]
        built = alternating(
            {"uwsim": lambda: RayScene(surfaces), "meshes": lambda: mesh_caster(bodies)}
        )
        figures: dict[str, object] = {
            "triangles": sum(map(len, bodies)),
            "engine_shapes": int(casters["engine"][0].ngeom),
            "build_ms": {kind: round(us / 1e3, 2) for kind, us in built.items()},
            "memory_kb": {
                "uwsim": round(sum(each.nbytes for each in scene._trees) / 1e3),
                "meshes": round(mujoco.mj_sizeModel(casters["meshes"][0]) / 1e3),
            },
        }
        for sensor, (mount, directions) in rays().items():
            pose = sensor_pose(simulation, mount)
            along = np.ascontiguousarray(directions @ pose.rotation.T)
            others = {kind: mujoco_cast(c, pose.position, along) for kind, c in casters.items()}
            own = partial(cast, pose, directions, REACH)
            spent = alternating({"uwsim": own, **others})
            figures[f"{sensor}, rays: {len(directions)}"] = {
                "us": {kind: round(us, 2) for kind, us in spent.items()},
                "ratio": {kind: round(spent[kind] / spent["uwsim"], 2) for kind in others},
                **{kind: differences(own().distance, other()) for kind, other in others.items()},
            }
    return figures


def measure() -> dict[str, object]:
    """Measure all scenes."""
    return {name: row(name) for name in SCENES}


if __name__ == "__main__":
    main(measure)
