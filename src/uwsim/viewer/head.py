"""What the page knows of a scene before anything moves: the *head*, and how motion reaches it.

One format, two sources. A *replay* is one HTML file with packs in it as base64; a *live* view gets
the same packs over a WebSocket. All numbers are little-endian, lengths in metres, angles in
radians, quaternions w x y z, matrices row by row, positions in W (z up). Cameras, lamps and
projectors have OpenGL axes: x right, y up, they look along -z.

**A pack** is gzip (mtime 0) of a uint32 n, n bytes of JSON padded with blanks to a multiple of
8 bytes (with the 4 before it), and the bytes that the JSON refers to: ``[offset, count, kind]``,
offset in bytes from the end of the JSON and a multiple of 4, count of numbers, kind one of
``f4 u4 u2 i2 i1 u1``.

**The head** (JSON of a pack)::

    uwsim_head  1
    title       "currents, PI, seed 7"
    live        whether rows come over a WebSocket
    meshes      [{positions: ref, box: [low, high], normals: ref, uvs: ref or null,
                  triangles: ref}]    positions u2 over the box, normals i1 / 127, uvs f4
    textures    [{type: "image/webp", bytes: ref, width, height, repeats}]
    bodies      [{name, kind: "link" | "object", vehicle: name or null, pose: [x y z w x y z],
                  trail: bool, visuals: [{mesh, matrix: 16, colour: 3, texture or null,
                  opacity, two_sided, hidden}]}]
    cameras     [{name, body, pose: 7 (body from camera), width, height, fx, fy, cx, cy, skew,
                  near, far, grey}]
    lamps       [{name, body, pose, half_angle, softness, colour, intensity, shadow, on}]
    sensors     [{name, kind, body, pose, reach, width, height, beams}]  x ahead; angles of the fan
    frames      [{name, body, pose}]
    water       {fog, fog_colour, colour, attenuation, surface_height, fog_distance, light_rate,
                 sun, shadows}
    law         {sun_directions, sun_colours, ambient, specular, ...}  constants of the renderer
    localized   pose of the frame L in W
    estimates   [{camera, truth: signals, estimate: signals}] quadrangles in images [px]
    trials      replays only: [{title, motion: ref u1 or null, levels, curves}]

    levels      [{label, status, why, start, end, values: {fog: ...}}]  [s of simulation time]
    curves      [{name, unit, times: ref f4, values: ref f4}]  NaN: nothing was measured

``pose`` of a body is where it is at step 0; a body that is not in a track stays there.

**Motion of a trial** (``units/NNNNN.motion``, `tracks`): gzip (mtime 0) of a line of JSON that ends
with a line feed, then bytes::

    {"uwsim_motion": 1, "rate": 30.0, "n": 3600, "start": 0.0,
     "bodies": ["girona500/base_link", "blackbox"], "length": 1e-4, "quaternion": 1e-4,
     "signals": [{"name": "fog", "unit": "1/m", "step": 1e-4}, ...]}

Row i is at ``start + i / rate`` [s]. Columns: for each body x y z w x y z, then a column for each
signal, as int32 multiples of ``length``, ``quaternion`` and ``step``; each column as differences
from the row before (the first from 0), columns one after the other: m columns of n int32. Their
bytes are shuffled: all lowest bytes first, all highest last, 4 m n bytes. Quaternions keep their
sign from row to row. int32 minimum is "nothing" (NaN) in a signal, taken as a difference, too
(sums wrap round).

Names of bodies: ``vehicle/link`` for every link with visuals, sensors, cameras or lamps, and the
base link; the object's name for objects that may move. Names of signals, all optional::

    fog, light_rate            as they are [1/m], [1]
    lamp/NAME                  0 off, 1 on
    thrust/VEHICLE/NAME        command of a thruster, -1..1 of its largest [1], or [N] with unit
    water/VEHICLE/x|y|z        velocity of the water at the vehicle, in W [m/s]
    contacts/k/x|y|z           points of contact, in W; NaN: fewer
    truth/CAMERA/k/u|v         corners in a camera's image, from the centre of the first pixel [px]
    estimate/CAMERA/k/u|v      the same of the algorithm
    range/NAME                 reading of a range sensor [m]

**Live**, server to page: binary messages begin with 16 bytes: uint8 kind, uint8 index, uint16 0,
uint32 step, float64 time [s]::

    kind 0   the head as a pack; its field ``motion`` is the JSON line of a motion file
    kind 1   a row: float32 of every column (7 a body, then the signals, NaN: nothing)
    kind 2   a JPEG image of the camera number ``index``
    kind 3   a JPEG of the free view, for pages without WebGL

and text messages, JSON::

    {"type": "state", "paused": false, "speed": 1.0, "pilot": false, "real_time_factor": 1.0,
     "mapping": {"w": "+surge", ...}}
    {"type": "levels", "levels": [...]}                        as above, all so far
    {"type": "samples", "samples": [[name, unit, time, value or null], ...]}    for the curves
    {"type": "end", "why": "..."}

Page to server, JSON text of at most 4 kB::

    {"type": "control", "action": "pause" | "play" | "step" | "speed", "speed": 2.0}
    {"type": "images", "cameras": ["bowtech1"], "rate": 10}    which JPEGs it wants
    {"type": "view", "camera": "bowtech1" or null, "pose": [7], "width": 640, "height": 480}
                                                               without WebGL: draw kind 3 so
    {"type": "input", "keys": ["w"], "axes": [0.0, ...], "buttons": [0.0, ...],
     "sticks": [x, y, x, y]}       whenever it changes, and 10 times a second while not at rest

Keys are `KeyboardEvent.key` of letters in lower case; axes and buttons those of the first gamepad;
sticks those on the screen, -1..1, up and right positive. The page is served at ``/?token=T``; it
opens ``ws[s]://HOST/socket?token=T``. The head is the first message.
"""
