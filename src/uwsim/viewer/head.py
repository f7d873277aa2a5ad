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
                  pieces, tangents: ref i2 / 32767, finish: ref, emissions: ref}]
                  normals are i2 / 32767, tints (colours 0..1) u2 / 65535; the last three are
                  absent without a material (`uwsim.rendering.merged.MATERIAL_VERTEX`);
                  pieces: [first index, count, centre 3, radius, lower corner 3, upper corner 3,
                  normal 3, density] (`uwsim.rendering.merged.Piece`)
    reflectance  in physical water with materials: ref f4, the table of rough surfaces, 32 x 32 x 4
                  (`uwsim.rendering.materials.reflectance`)
    textures    [{type: "image/webp" or "image/jpeg", bytes: ref, width, height, repeats}]
    bodies      [{name, vehicle: name or null, pose: [x y z w x y z],
                  visuals: [{part: index of the model in the scene, mesh, matrix: 16 (body from
                  mesh), texture or null, opacity, two_sided, material: absent, or {maps: {name
                  in the shaders: index of a texture}, cutoff: alpha of holes or null, emits},
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
                 follows_light, sun, shadows, media, clear, nodes}    clip: true if fog depends on
                 clip-space z, as in UWSim, not on the distance; follows_light: true if the light
                 rate scales the colours of water and fog. In physical water, media are the
                 numbers of each medium that occurs, and clear those of the purest water
                 (`uwsim.viewer.optics`); nodes are those of a mean over a Gaussian. Else these
                 three are null
    particles   null or the marine snow, bubbles and clouds of sediment in physical water
                 (`uwsim.viewer.particles`)
    surface     null or the moving surface of physical water (`uwsim.viewer.surface`)
    caustics    null or the caustics and light shafts of that surface (`uwsim.viewer.caustics`)
    suns        {name: {direction, colour}}
    ambient, specular    constants of the lighting (`uwsim.rendering.water`)
    localized   pose in W of the localized frame L, the frame of the scene file
    trials      replays only: [{title, motion: ref u1 or null, levels, curves, poses, visuals,
                  surface, caustics}]
                  poses, visuals: {body: pose} and {body: [visual]} of the bodies whose initial
                  pose and visuals are not those of ``bodies``, because the seed or the level
                  changes the scene; surface, caustics: absent, or {waves, ripples} and {phases,
                  waves} of another seed

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

If thrusters stirred up sediment, the version is 3, ``"sediment": {"n": 90, "steps": [...]}`` is in
the line, and a last table of n rows follows: a puff in each, in multiples of ``steps``
(`uwsim.results.motion.stirred_sediment`). A mass of smallest int32 removes all puffs.

If programs added markers, the version is 2 at least, and ``"markers"`` is in the line, in the
format of `uwsim.results.motion.marker_log`.

The name of a body is ``vehicle/link``; links that are connected by fixed joints are one body, named
after the link nearest to the root (`uwsim.simulation.tracked_bodies`). The body of an object has
the object's name. The second body of one name has the suffix ``#2``. Names of signals, all
optional::

    fog, light_rate            the present values [1/m], [1]
    beam_attenuation, exposure_level
                               of physical water: that of green [1/m], and the binary logarithm of
                               the exposure [1]
    particles/x|y|z, particle_velocity/x|y|z
                               displacement [m] and velocity [m/s] of the water that carries
                               particles, in W
    wave_scale                 factor on the amplitudes of waves that physical water shows [1]
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
    kind 5   a pack with {"optics": ...}, the numbers of a medium that is new in this run
    kind 6   float64: the time of the puffs of sediment [s], then eleven columns of each
             (`uwsim.particles.puffs`)

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
from collections.abc import Iterable
from typing import Any

import numpy as np

from ..base.geometry import Pose
from ..base.numerics.linear import dot, length
from ..optics import Medium
from ..simulation import Simulation
from ..simulation.scenery.sand import CELL_WIDTH, TOOL_REACH, Heap
from ..simulation.unique_names import make_unique
from ..simulation.views import FIELD_OF_VIEW, find_focus, orbit_view, viewer_view
from .bodies import Bodies, pose_row
from .caustics import describe_caustics
from .models import Models
from .mounts import (
    describe_cameras,
    describe_frames,
    describe_lamps,
    describe_projector,
    describe_sensors,
    describe_vehicles,
)
from .pack import Blob
from .particles import describe_particles
from .surface import describe_surface
from .water import describe_water

Json = dict[str, Any]
VERSION = 1
"""The version of the format of the head."""
SIZE = (960, 720)
"""The width and height of the initial view [px]; only the ratio matters."""


def scene_head(
    simulation: Simulation,
    title: str,
    blob: Blob,
    *,
    is_live: bool = False,
    media: Iterable[Medium] = (),
    models: Models | None = None,
) -> Json:
    """Describe an opened scene for the page.

    Args:
        simulation: the simulation, at step 0.
        title: the title of the page.
        blob: the binary part of the pack, to which arrays are appended.
        is_live: True if rows of motion arrive over a WebSocket.
        media: the media of physical water besides the present one.
        models: the meshes and textures, which may be used further (`models_of`); None: new ones.
    """
    world = simulation.world
    models = models or models_of(simulation, blob)
    bodies = _describe_bodies(simulation, models)
    names = make_unique(f"sand/{heap.name}" for heap in world.scenery.heaps)
    heaps = zip(names, world.scenery.heaps, strict=True)
    sand = [_sand(name, heap, bodies, models) for name, heap in heaps]
    return {
        "uwsim_head": VERSION,
        "title": title,
        "live": is_live,
        "localized": pose_row(world.model.scene.world_from_localized),
        "cameras": list(describe_cameras(world, bodies)),
        "lamps": list(describe_lamps(world, bodies)),
        "projector": describe_projector(world, bodies, models),
        "sensors": list(describe_sensors(world, bodies)),
        "frames": list(describe_frames(world, bodies)),
        "vehicles": list(describe_vehicles(world, bodies)),
        "sand": sand,
        "view": _orbit(simulation),
        "file_view": _file_view(simulation),
        **describe_water(world, blob, media),
        "particles": describe_particles(world),
        "surface": describe_surface(world, blob),
        "caustics": describe_caustics(world, blob),
        "bodies": bodies.rows,
        "meshes": models.meshes,
        "textures": models.textures,
        **models.reflectance(),
    }


def models_of(simulation: Simulation, blob: Blob) -> Models:
    """Return an empty list of meshes and textures for a scene, whose arrays go to a blob."""
    has_finish = simulation.world.scenery.state.water.physical_water is not None
    return Models(blob, has_finish=has_finish)


def changed_bodies(simulation: Simulation, head: Json, models: Models) -> Json:
    """Return the ``poses`` and ``visuals`` of a trial whose scene is not that of the head.

    Args:
        simulation: the trial's scene, at step 0.
        head: the head.
        models: the meshes and textures of the head, to which those of the trial are appended.
    """
    first_rows = {row["name"]: row for row in head["bodies"]}
    rows = [row for row in _describe_bodies(simulation, models).rows if row["name"] in first_rows]
    return {
        key: {
            row["name"]: row[field] for row in rows if row[field] != first_rows[row["name"]][field]
        }
        for key, field in (("poses", "pose"), ("visuals", "visuals"))
    }


def _describe_bodies(simulation: Simulation, models: Models) -> Bodies:
    bodies = Bodies(simulation.world)
    for part in simulation.world.scenery.parts:
        bodies.add(part, models)
    return bodies


def _sand(name: str, heap: Heap, bodies: Bodies, models: Models) -> Json:
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
    return {"pose": pose_row(world_from_camera), "fovy": fovy, "at": centre.tolist()}
