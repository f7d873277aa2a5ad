"""The *head*: the JSON description of a scene at step 0 for the page of replays and live views.

All formats that the page reads are defined below. A *replay* is one HTML file that contains a pack
as text; a *live* view receives packs over a WebSocket. All numbers are little-endian; lengths are
in metres, angles in radians, quaternions w x y z, matrices in row-major order, and positions in the
world frame W (z up). Cameras, lamps and projectors have OpenGL axes: x right, y up, the view
along -z.

**Text** of a pack: each four bytes, read as a big-endian number, are five digits to the base 85,
the highest first; n < 4 bytes at the end are n + 1 digits. The digits are
``0-9A-Za-z!#$%/()*+-;,=.?@^_`{|}~``.

**A pack** is compressed by gzip (mtime 0). It contains a uint32 n, n bytes of JSON, and the arrays
that the JSON refers to. Blanks pad the JSON so that the arrays begin at a multiple of 8 bytes. A
reference (``ref``) is ``[offset, count, type]``: the offset in bytes from the end of the JSON, a
multiple of 4; the number of elements; and their type, one of ``f4 u4 u2 i2 i1 u1``.

**The head** (JSON of a pack)::

    uwsim_head  1
    title       "currents, PI, seed 7"
    live        true if rows of motion arrive over a WebSocket
    meshes      [{positions: ref, normals: ref, uvs: ref or null, tints: ref, triangles: ref,
                  pieces}]    normals are i2 / 32767, tints (colours 0..1) u2 / 65535;
                  pieces: [first index, count, centre 3, radius, lower corner 3, upper corner 3,
                  normal 3, density] (`uwsim.rendering.merged.Piece`)
    textures    [{type: "image/webp", bytes: ref, width, height, repeats}]
    bodies      [{name, vehicle: name or null, pose: [x y z w x y z],
                  visuals: [{part: index of the model in the scene, mesh, matrix: 16 (body from
                  mesh), texture or null, opacity, two_sided,
                  hidden: true if cameras do not draw it}]}]
    cameras     [{name, body, pose: 7 (body from camera), width, height, fx, fy, cx, cy, skew,
                  near, far, grey}]
    lamps       [{name, body, pose, half_angle, softness, colour, intensity, shadow, on}]
    projector   null or {body, pose, fovy, laser, pattern: index of a texture}
    sensors     [{name, kind: "range" | "fan" | "sonar", body, pose, reach, from, to}]
                  reach: maximum range [m]; from, to: angles of the first and last beam. A range
                  sensor has one beam along x; the beams of a fan are in its y z plane, angles
                  from -z towards y; those of a sonar in its x y plane, angles from x towards y
    frames      [{name, body or null (W), pose}]
    vehicles    [{name, body (its base), thrusters: [names], joints: [names]}]
    sand        [{body, mesh, columns: [n along x, n along y], corner: 3, cell, reach, bite}]
                  heaps of sand: vertex i * (n along y) + j of the mesh is the top of column i, j;
                  cell: distance between columns; reach, bite: radius of the dredge, and height
                  that it removes at a time (below)
    view        {pose, fovy, at: 3}   the initial view: pose of its camera, and the point around
                  which it turns; as ``uwsim render --view orbit``
    file_view   null, or the view of the ``<camera>`` of the scene file in the same format
    water       {fog, fog_colour, colour, attenuation, surface_height, clip, light_rate,
                 follows_light, sun, shadows}    clip: true if fog depends on clip-space z, as in
                 UWSim, not on the distance; follows_light: true if the light rate scales the
                 colours of water and fog
    suns        {name: {direction, colour}}
    ambient, specular    constants of the lighting (`uwsim.rendering.water`)
    localized   pose in W of the localized frame L, the frame of the scene file
    trials      replays only: [{title, motion: ref u1 or null, levels, curves, poses}]
                  poses: {body: pose} of the bodies whose initial pose is not that of ``bodies``,
                  because the seed varies the scene

    levels      [{label, status, why, start, end, values: {fog: ...}}]
                  start, end: simulation times [s]; why: the reason of a status other than ok, or
                  null; values: the swept parameters
    curves      [{name, unit, times: ref u4 [0.1 ms], values: ref f4,
                  names: names of the values 1, 2, ... (phases), or none,
                  is_share: true if its range is 0..1}]    NaN: nothing was measured

``pose`` of a body is its pose in W at step 0; a body that is not in a motion track does not move.

**Motion of a trial** (``units/NNNNN.motion``, `uwsim.results.motion`): gzip (mtime 0) of a line of
JSON that ends with a line feed, then bytes::

    {"uwsim_motion": 1, "rate": 30.0, "n": 3600, "start": 0.0,
     "bodies": ["girona500/base_link", "blackbox"], "length": 1e-4, "quaternion": 1e-4,
     "signals": [{"name": "fog", "unit": "1/m", "step": 1e-4}, ...]}

The table has n rows and m columns. Row i is at ``start + i / rate`` [s]. The columns are x y z
w x y z of each body, then one column for each signal, as int32 multiples of ``length``,
``quaternion`` and ``step``. Each column is stored as differences from the row before (the first
from 0), one column after the other. The 4 m n bytes are sorted: first the lowest byte of every
number, last the highest. Quaternions keep their sign from row to row. The smallest int32 means no
value (NaN) in a signal; the differences include it like any number (sums wrap around).

If sand was removed, the version is 2, ``"sand": {"n": 412, "grain": 1e-6}`` is in the line, and a
second table of n rows follows in the same encoding. Its columns are the frame, the index of the
heap, and the position x y z of the dredge from the heap's corner in multiples of ``grain`` [m].
From that frame on, each column of the heap whose top is nearer than ``reach`` to the position is
lower by ``bite``, but not below the corner. A position of smallest int32 restores the whole heap.

If programs added markers, the version is 2, too, and ``"markers"`` is in the line, in the format
of `uwsim.results.motion.marker_log`.

The name of a body is ``vehicle/link``; links that are connected by fixed joints are one body, named
after the link nearest to the root (`uwsim.simulation.tracked_bodies`). The body of an object has
the object's name. The second body of one name has the suffix ``#2``. Names of signals, all
optional::

    fog, light_rate            the present values [1/m], [1]
    lamp/NAME                  its brightness, 0..1 of the lamp's intensity in the head
    thrust/VEHICLE/NAME        command of a thruster, -1..1 of its largest [1], or [N] with unit
    water/VEHICLE/x|y|z        velocity of the water at the vehicle, in W [m/s]
    contacts/k/x|y|z           point of contact k, in W [m]; NaN: there are fewer contacts
    truth/CAMERA/k/u|v         true position of corner k in a camera's image, from the centre of the
                               first pixel [px]
    estimate/CAMERA/k/u|v      the algorithm's estimate of that position [px]
    range/NAME                 reading of a range sensor [m]

**Live**, server to page: binary messages begin with 16 bytes: uint8 kind, uint8 index, uint16 0,
uint32 step, float64 time [s]::

    kind 0   the head as a pack; its field ``motion`` is the JSON line of a motion file
    kind 1   a row: float32 of every column (7 a body, then the signals, NaN: no value)
    kind 2   a JPEG image of the camera with the index ``index``
    kind 3   a JPEG of the free view, for pages without WebGL
    kind 4   float32 heights [m] of the columns of the heap with that index, above its corner

and text messages, JSON::

    {"type": "state", "paused": false, "speed": 1.0, "pilot": false, "resets": false,
     "mapping": {"w": "+surge", ...}, "reserved": ["w", ...], "sticks": ["yaw", "heave", "", ""],
     "names": {"joint1": "Slew", ...}, "vehicle": 0, "why": ""}
                        speed: real-time factor, 0: no limit; vehicle: index of the piloted one;
                        mapping, sticks: keys, and on-screen sticks (left x, y, right x, y), that
                        have an effect, with their axes; reserved: all keys of the pilot; names of
                        the joints and thrusters; why: the reason why no vehicle can be steered
    {"type": "levels", "levels": [...]}                        all levels so far, as above
    {"type": "samples", "samples": [[name, unit, time, value or null], ...]}    for the curves
    {"type": "readings", "time": 1.2, "readings": [[name, unit, value or null], ...]}
                        the readings of the piloted vehicle: joint/NAME, contact force,
                        force/NAME, battery/NAME, real-time factor
    {"type": "topics", "topics": [[name, type], ...]}          all topics
    {"type": "topic", "name": "imu", "time": 1.2, "fields": [[path, number, text or null], ...],
     "is_cut": false}   numbers and texts of the newest message; true: only the first fields
    {"type": "markers", "markers": [{"name", "at": 3, "colour": "#rrggbb", "lines": [[3, ...]]}]}
                                       all markers, as lines in W
    {"type": "end", "why": "..."}

Page to server, JSON text of at most 4 kB::

    {"type": "control", "action": "pause" | "play" | "step" | "speed" | "reset", "speed": 2.0}
    {"type": "images", "cameras": ["bowtech1"], "rate": 10, "width": 200}
                                 the requested JPEGs and their width on the page (default: full)
    {"type": "topics", "names": ["imu"]}                     the requested topics, 16 at most
    {"type": "view", "camera": "bowtech1" or null, "pose": [7], "width": 640, "height": 480,
     "fovy": 0.87}                                     without WebGL: the view of kind 3
    {"type": "input", "keys": ["w"], "axes": [0.0, ...], "buttons": [0.0, ...],
     "sticks": [x, y, x, y]}       at each change, and 10 times a second while not at rest

Keys are `KeyboardEvent.key` of letters in lower case; axes and buttons those of the first gamepad;
sticks those on the screen, -1..1, up and right positive. The page is served at ``/?token=T``; it
opens ``ws[s]://HOST/socket?token=T``. The head is the first message.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import asdict
from typing import Any

import numpy as np

from ..base.geometry import Pose
from ..base.numerics.linear import dot, length, product
from ..model.parts import Part
from ..rendering.water import AMBIENT_SHARE, SPECULAR_BRIGHTNESS, SUN_COLOURS, SUN_DIRECTIONS
from ..sensors.range_sensor import RangeSensorSpec
from ..sensors.sensor import MountedSensor
from ..sensors.sonar.imaging_sonar import ImagingSonarSpec
from ..sensors.sonar.multibeam_sensor import FanSpec
from ..sensors.virtual_camera import VirtualCameraSpec
from ..simulation import Simulation
from ..simulation.live_scene import LiveScene
from ..simulation.scenery.sand import CELL_WIDTH, TOOL_REACH, Heap
from ..simulation.tracked_bodies import body_names, rigid_group_links, vehicle_labels
from ..simulation.unique_names import make_unique
from ..simulation.views import FIELD_OF_VIEW, find_focus, orbit_view, viewer_view
from .models import Models
from .pack import Blob

Json = dict[str, Any]
VERSION = 1
"""The version of the format of the head."""
SIZE = (960, 720)
"""The width and height of the initial view [px]; only the ratio matters."""


def scene_head(simulation: Simulation, title: str, blob: Blob, *, is_live: bool = False) -> Json:
    """Describe an opened scene for the page.

    Args:
        simulation: the simulation, at step 0.
        title: the title of the page.
        blob: the binary part of the pack, to which arrays are appended.
        is_live: True if rows of motion arrive over a WebSocket.
    """
    world = simulation.world
    models = Models(blob)
    bodies = _Bodies(world)
    for part in world.scenery.parts:
        bodies.add(part, models)
    names = make_unique(f"sand/{heap.name}" for heap in world.scenery.heaps)
    heaps = zip(names, world.scenery.heaps, strict=True)
    sand = [_sand(name, heap, bodies, models) for name, heap in heaps]
    water, light = world.scenery.state.water, world.scenery.state.light
    return {
        "uwsim_head": VERSION,
        "title": title,
        "live": is_live,
        "localized": _row_of(world.model.scene.world_from_localized),
        "cameras": list(_cameras(world, bodies)),
        "lamps": list(_lamps(world, bodies)),
        "projector": _projector(world, bodies, models),
        "sensors": list(_sensors(world, bodies)),
        "frames": list(_frames(world, bodies)),
        "vehicles": list(_vehicles(world, bodies)),
        "sand": sand,
        "view": _orbit(simulation),
        "file_view": _file_view(simulation),
        "water": {
            "fog": water.fog,
            "fog_colour": list(water.fog_colour),
            "colour": list(water.colour),
            "attenuation": list(water.attenuation),
            "surface_height": water.surface_height,
            "clip": water.fog_distance == "clip",
            "follows_light": water.follows_light,
            "light_rate": light.rate,
            "sun": light.sun,
            "shadows": light.shadows,
        },
        "suns": {
            name: {"direction": list(SUN_DIRECTIONS[name]), "colour": list(SUN_COLOURS[name])}
            for name in SUN_DIRECTIONS
        },
        "ambient": AMBIENT_SHARE,
        "specular": SPECULAR_BRIGHTNESS,
        "bodies": bodies.rows,
        "meshes": models.meshes,
        "textures": models.textures,
    }


def body_poses(simulation: Simulation) -> dict[str, list[float]]:
    """Return the present poses in W of all bodies of the head, x y z w x y z by name."""
    bodies = _Bodies(simulation.world)
    for part in simulation.world.scenery.parts:
        bodies.part_body(part)
    return {row["name"]: row["pose"] for row in bodies.rows}


class _Bodies:
    """The bodies that the page draws, or that carry a sensor, lamp or camera.

    Args:
        world: the scene.
    """

    def __init__(self, world: LiveScene) -> None:
        self._world = world
        self._leaders = {i: rigid_group_links(robot) for i, robot in world.model.robots.items()}
        self._link_names, self._object_names = body_names(world)
        self.labels = vehicle_labels(world)
        """The unique names of the vehicles."""
        self.rows: list[Json] = []
        """The entries of the bodies so far, as in the head."""
        self._poses: dict[str, Pose] = {}
        self._n_parts = 0

    def link(self, index: int, link: str) -> str:
        """Return the name of the body to which a link belongs; add the body if it is new."""
        leader = self._leaders[index][link]
        pose = self._world.engine.poses.link(index, leader)
        return self._body(self._link_names[index, leader], pose, self.labels[index])

    def named_link(self, vehicle: str, link: str) -> str:
        """Return the name of the body of a link, of the first vehicle with that name."""
        return self.link(self._world.vehicles.names.index(vehicle), link)

    def pose(self, name: str) -> Pose:
        """Return the pose of a body in W, by the name that `link` returned."""
        return self._poses[name]

    def part_body(self, part: Part) -> str:
        """Return the name of the body of a part of the scene; add the body if it is new."""
        if part.vehicle is not None:
            return self.link(part.vehicle, part.link)
        assert part.object is not None
        pose = self._world.engine.poses.object(part.object)
        return self._body(self._object_names[part.object], pose, None)

    def add(self, part: Part, models: Models) -> None:
        """Add the visuals of a part of the scene to its body."""
        name = self.part_body(part)
        body_from_mesh = product(
            self._poses[name].inverse().matrix, self._world.scenery.world_from_mesh(part)
        )
        matrix = [float(f"{value:.9g}") for value in body_from_mesh.ravel()]
        row = next(row for row in self.rows if row["name"] == name)
        self._n_parts += 1
        row["visuals"] += [
            {"part": self._n_parts, **visual, "matrix": matrix, "hidden": part.is_hidden}
            for visual in models.visuals(part.model)
        ]

    def add_fixed(self, name: str, visuals: list[Json]) -> None:
        """Add a body whose vertices are in W."""
        self._body(name, Pose.identity(), None)
        matrix = np.eye(4).ravel().tolist()
        self._n_parts += 1
        fields = {"part": self._n_parts, "matrix": matrix, "hidden": False}
        self.rows[-1]["visuals"] = [{**fields, **visual} for visual in visuals]

    def _body(self, name: str, pose: Pose, vehicle: str | None) -> str:
        if name not in self._poses:
            self._poses[name] = pose
            self.rows.append(
                {"name": name, "vehicle": vehicle, "pose": _row_of(pose), "visuals": []}
            )
        return name


def _sand(name: str, heap: Heap, bodies: _Bodies, models: Models) -> Json:
    """Add a heap to the bodies and meshes, and return its entry in the head."""
    visuals = models.visuals(heap.model())
    bodies.add_fixed(name, visuals)
    return {
        "body": name,
        "mesh": visuals[0]["mesh"],
        "columns": list(heap.heights.shape),
        "corner": heap.corner.tolist(),
        "cell": heap.cell,
        "reach": TOOL_REACH,
        "bite": CELL_WIDTH,
    }


def _cameras(world: LiveScene, bodies: _Bodies) -> Iterator[Json]:
    links = {  # of several cameras with one name, the last is used
        spec.name: f"{vehicle}/{spec.relative_to}"
        for vehicle, spec in _mounted_parts(world)
        if isinstance(spec, VirtualCameraSpec)
    }
    for name in world.sensors.cameras:
        camera = world.sensors.camera(name)
        yield {
            **_mount_fields(bodies, links[name], camera.world_from_camera),
            "name": name,
            "grey": camera.is_grey,
            **asdict(camera.intrinsics),
        }


def _lamps(world: LiveScene, bodies: _Bodies) -> Iterator[Json]:
    for lamp in world.scenery.mounted_lamps:
        spec = lamp.spec
        yield {
            **_mount_fields(bodies, lamp.link, lamp.world_from_lamp),
            "name": spec.name,
            "half_angle": math.radians(spec.fov / 2.0),
            "softness": spec.softness,
            "colour": list(spec.color),
            "intensity": spec.intensity,
            "shadow": spec.shadow,
            "on": lamp.is_on,
        }


def _projector(world: LiveScene, bodies: _Bodies, models: Models) -> Json | None:
    if world.scenery.mounted_projector is None:
        return None
    projector, pattern = world.scenery.mounted_projector
    return {
        **_mount_fields(bodies, projector.link, projector.world_from_projector),
        "fovy": math.radians(projector.spec.fov),
        "laser": projector.spec.laser,
        "pattern": models.pattern(pattern),
    }


def _sensors(world: LiveScene, bodies: _Bodies) -> Iterator[Json]:
    for name, spec in _mounted_parts(world):
        mount = world.vehicles.find(name).mount(spec)
        fields = {**_mount_fields(bodies, mount.name, mount.world_from_body), "name": spec.name}
        if isinstance(spec, RangeSensorSpec):
            yield {**fields, "kind": "range", "reach": spec.range, "from": 0.0, "to": 0.0}
        elif isinstance(spec, FanSpec):
            ends = math.radians(spec.init_angle), math.radians(spec.final_angle)
            yield {**fields, "kind": "fan", "reach": spec.range, "from": ends[0], "to": ends[1]}
        elif isinstance(spec, ImagingSonarSpec):
            half = math.radians(spec.horizontal_aperture) / 2.0
            yield {**fields, "kind": "sonar", "reach": spec.range, "from": -half, "to": half}


def _frames(world: LiveScene, bodies: _Bodies) -> Iterator[Json]:
    yield {"name": "L", "body": None, "pose": _row_of(world.model.scene.world_from_localized)}
    for index, vehicle in enumerate(world.model.scene.vehicles):
        for link in world.model.robots[index].links:
            name = f"{vehicle.name}/{link.name}"
            world_from_link = world.engine.poses.link(index, link.name)
            yield {**_mount_fields(bodies, name, world_from_link), "name": name}
        for part in (part for name, part in _mounted_parts(world) if name == vehicle.name):
            mount = world.vehicles.find(vehicle.name).mount(part)
            yield {**_mount_fields(bodies, mount.name, mount.world_from_body), "name": part.name}


def _mounted_parts(world: LiveScene) -> Iterator[tuple[str, MountedSensor]]:
    """Yield the vehicle's name and the spec of each sensor on a link that exists."""
    for index, vehicle in enumerate(world.model.scene.vehicles):
        for _, part in vehicle.all_parts():
            links = world.model.robots[index]
            if isinstance(part, MountedSensor) and links.link(part.relative_to) is not None:
                yield vehicle.name, part


def _vehicles(world: LiveScene, bodies: _Bodies) -> Iterator[Json]:
    for index, spec in enumerate(world.model.scene.vehicles):
        vehicle = world.vehicles.find(spec.name)
        yield {
            "name": bodies.labels[index],
            "body": bodies.link(index, world.model.robots[index].root),
            "thrusters": list(vehicle.thrusters),
            "joints": list(vehicle.joint_names),
        }


def _orbit(simulation: Simulation) -> Json:
    """Return the view of vehicles and nearby objects, the same as in `uwsim render`."""
    eye, middle = orbit_view(simulation, SIZE).world_from_camera, find_focus(simulation).centre
    return _view(eye, FIELD_OF_VIEW, dot(eye.position - middle, eye.rotation[:, 2]))


def _file_view(simulation: Simulation) -> Json | None:
    camera = simulation.world.model.scene.camera
    if camera is None or camera.position == camera.look_at:
        return None
    eye = viewer_view(simulation, camera, SIZE).world_from_camera
    distance = length(np.subtract(camera.position, camera.look_at))
    return _view(eye, math.radians(camera.fov), distance)


def _view(world_from_camera: Pose, fovy: float, distance: float) -> Json:
    """Return a view whose centre is ``distance`` [m] ahead of the camera."""
    centre = world_from_camera.position - distance * world_from_camera.rotation[:, 2]
    return {"pose": _row_of(world_from_camera), "fovy": fovy, "at": centre.tolist()}


def _mount_fields(bodies: _Bodies, name: str, world_from_part: Pose) -> Json:
    """Return the fields ``body`` and ``pose``: the body of a link, and a part's pose on it.

    Args:
        bodies: the bodies of the head.
        name: the link, ``vehicle/link``.
        world_from_part: the pose of the part.
    """
    vehicle, _, link = name.partition("/")
    body = bodies.named_link(vehicle, link)
    return {"body": body, "pose": _row_of(bodies.pose(body).inverse() @ world_from_part)}


def _row_of(pose: Pose) -> list[float]:
    return [float(f"{value:.9g}") for value in (*pose.position, *pose.quaternion)]
