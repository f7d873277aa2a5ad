"""The ping of a Doppler velocity log in compiled code."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ..base.geometry import Array
from ..base.numerics.calls import FUNCTION
from ..base.numerics.draws import STREAM, normal, uniform
from ..base.numerics.jit import njit
from ..base.numerics.linear import eliminate, multiply_matrices, rotate, rotate_back, rotate_rows
from ..base.numerics.memory import carray, pointer, view_doubles
from ..rays import Hits
from ..rays.scene_record import RAYS, cast_from
from ..world.mounts import MOUNT, read_frame, read_motion, read_water
from .janus import MIN_BEAMS, SIGNS, Flags

DVL = np.dtype(
    [
        ("mount", MOUNT),
        ("base", MOUNT),  # the base of the vehicle
        ("rays", RAYS),
        ("stream", STREAM),
        ("is_own", np.int64),  # the address of a byte for each surface: 1 if of this vehicle
        ("directions", np.float64, (4, 3)),  # of the beams, unit vectors in the sensor's frame
        ("cosine", np.float64),  # of the angle of the beams to the z axis
        ("error_scale", np.float64),  # see `Janus.error_scale`
        ("scale", np.int64),  # the address of the scale factor of each beam, (4,) [1]
        ("std", np.float64),  # noise of each component of a velocity [m/s]
        ("beam_std", np.float64),  # noise along each beam over the seabed [m/s]
        ("water_std", np.float64),  # noise along each beam through the water [m/s]
        ("range_std", np.float64),  # noise of each range [m]
        ("dropout", np.float64),  # the probability that a beam has no echo
        ("min_altitude", np.float64),  # [m]
        ("max_altitude", np.float64),  # [m]
        ("water_layer", np.float64),  # distance along the z axis [m]
        ("surface", np.float64),  # height of the water's surface in W [m]
        ("water_function", FUNCTION),  # of the water's velocity; 0: use ``flow`` instead
        ("flow", np.int64),  # the address of the water's velocity on the beams, in W, (4, 3) [m/s]
        ("bottom_track", np.int64),  # addresses of `TrackState.numbers`
        ("water_track", np.int64),
        ("last_sample", np.int64),  # the address of `DvlState.last_sample`
        ("measures_differences", np.int64),  # 1: as the original UWSim (``dvl-differences``)
    ]
)
"""The parameters of a Doppler velocity log, for compiled code."""
INSTRUMENT, WORLD, ERROR, MADE_GOOD, TIME, LAST_VALID = 0, 3, 6, 7, 10, 11
"""The indices of a track's numbers; see `TrackState`."""
N_TRACK = 12
BASE_VELOCITY = 12
"""The index of the velocity in the base frame, after a track's numbers [m/s]."""
BOTTOM, WATER, HEIGHT, DEPTH, RANGES, BEAM_VELOCITIES = 0, 15, 30, 31, 32, 36
"""The indices of a sample's values: bottom track, water track, mean height above the seabed [m],
depth [m], beam ranges [m] and beam velocities over the seabed [m/s]."""
N_VALUES = 40
"""The number of values of a sample."""
OWN_SURFACE_GAP = 1e-6
"""The distance behind a surface of the sensor's own vehicle at which a beam continues [m]."""
MAX_OWN_SURFACES = 32
"""The largest number of surfaces of the sensor's own vehicle that a beam passes through."""

Record = Any


def sample_dvl(parameters: int, values: int, time: float) -> None:
    """Take a sample of a Doppler velocity log; see `uwsim.base.numerics.calls`."""
    dvl = carray(pointer(parameters), (1,), DVL)[0]
    frame, noise, chances = np.empty(12), np.empty((4, 4)), np.empty(4)
    read_frame(dvl.mount, frame)
    for i in range(4):
        for k in range(4):
            noise[i, k] = normal(dvl.stream)
    for i in range(4):
        chances[i] = uniform(dvl.stream)
    output = view_doubles(values, N_VALUES)
    if dvl.measures_differences != 0:
        measure_difference(dvl, time, frame, noise[3], output)
    else:
        ping(dvl, time, frame, noise, chances, output)


@njit
def measure_difference(dvl: Record, time: float, frame: Array, noise: Array, output: Array) -> None:
    """Write the mean velocity since the last sample, sensor's frame, as the original UWSim does."""
    last_sample, velocity = view_doubles(dvl.last_sample, 4), np.zeros(3)
    if time > last_sample[0]:  # false in the first sample: the last time is NaN
        world_velocity = (frame[:3] - last_sample[1:]) / (time - last_sample[0])
        velocity = rotate_back(frame[3:].reshape((3, 3)), world_velocity)
    last_sample[0], last_sample[1:] = time, frame[:3]
    for k in range(3):
        output[k] = velocity[k] + dvl.std * noise[k]


@njit
def ping(
    dvl: Record, time: float, frame: Array, normals: Array, chances: Array, output: Array
) -> None:
    """Write the values of a ping.

    Args:
        dvl: a record of `DVL`.
        time: the time of the ping [s].
        frame: the sensor's position and axes in W, (12,).
        normals: standard normal numbers, a row each for the bottom velocities, water velocities
            and ranges of the beams, and for the components of the velocity, (4, 4).
        chances: uniform numbers that decide which beams have no echo, (4,).
        output: the values, (N_VALUES,).
    """
    axes, motion, base = frame[3:].reshape((3, 3)), np.empty(12), np.empty(12)
    directions = dvl.directions
    beams = rotate_rows(axes, directions)
    ranges = find_ranges(dvl, frame, beams)
    motion[:3] = frame[:3]
    read_motion(dvl.mount, motion)
    velocity = rotate_back(axes, motion[3:6])
    scale, reach = view_doubles(dvl.scale, 4), dvl.water_layer / dvl.cosine
    flow = read_flow(dvl, frame, reach, beams, time)
    bottom, water, beam_velocities = (
        np.empty(4),
        np.empty(4),
        output[BEAM_VELOCITIES : BEAM_VELOCITIES + 4],
    )
    is_good, is_in_water = np.empty(4, np.bool_), np.empty(4, np.bool_)
    height, n_good = 0.0, 0
    for i in range(4):
        beam, d = beams[i], directions[i]
        over_ground = 0.0 + d[0] * velocity[0] + d[1] * velocity[1] + d[2] * velocity[2]
        bottom[i] = scale[i] * over_ground + dvl.beam_std * normals[0, i]
        water_part = beam[0] * flow[i, 0] + beam[1] * flow[i, 1] + beam[2] * flow[i, 2]
        water[i] = scale[i] * (over_ground - water_part) + dvl.water_std * normals[1, i]
        has_echo, axial_distance = chances[i] >= dvl.dropout, ranges[i] * dvl.cosine
        is_good[i] = has_echo and dvl.min_altitude <= axial_distance <= dvl.max_altitude
        is_under_surface = frame[2] + reach * beam[2] < dvl.surface
        is_in_water[i] = has_echo and ranges[i] > reach and is_under_surface
        output[RANGES + i] = beam_velocities[i] = math.nan
        if is_good[i]:
            output[RANGES + i] = ranges[i] + dvl.range_std * normals[2, i]
            beam_velocities[i] = bottom[i]
            height_per_range = -(0.0 + d[0] * axes[2, 0] + d[1] * axes[2, 1] + d[2] * axes[2, 2])
            height, n_good = height + output[RANGES + i] * height_per_range, n_good + 1
    noise = dvl.std * normals[3, :3]
    update_track(view_doubles(dvl.bottom_track, N_TRACK), time, axes, dvl, (bottom, is_good), noise)
    update_track(
        view_doubles(dvl.water_track, N_TRACK), time, axes, dvl, (water, is_in_water), noise
    )
    read_frame(dvl.base, base)
    write_track(view_doubles(dvl.bottom_track, N_TRACK), base[3:], output[BOTTOM:WATER])
    write_track(view_doubles(dvl.water_track, N_TRACK), base[3:], output[WATER:HEIGHT])
    output[HEIGHT] = height / n_good if n_good else math.nan
    output[DEPTH] = max(0.0, dvl.surface - frame[2])


@njit
def write_track(track: Array, base: Array, output: Array) -> None:
    """Write the numbers of a track, and the velocity in the base frame.

    Args:
        track: the numbers of the track, see `TrackState`, (N_TRACK,).
        base: the axes of the base in W, by rows, (9,).
        output: the array into which the numbers are written, (15,).
    """
    output[:BASE_VELOCITY] = track
    for i in range(3):
        total = 0.0
        for j in range(3):
            total += base[3 * j + i] * track[WORLD + j]
        output[BASE_VELOCITY + i] = total


@njit
def read_flow(dvl: Record, frame: Array, reach: float, beams: Array, time: float) -> Array:
    """Return the water's velocity at a distance ``reach`` [m] on each beam, in W, (4, 3) [m/s]."""
    if dvl.water_function.function == 0:
        return view_doubles(dvl.flow, 12).reshape((4, 3))
    water = np.empty((2, 4, 3))
    for i in range(4):
        for k in range(3):
            water[0, i, k] = frame[k] + reach * beams[i, k]
    read_water(dvl.water_function, water, time)
    velocities: Array = water[1]
    return velocities


@njit
def find_ranges(dvl: Record, frame: Array, beams: Array) -> Array:
    """Return the distances along the beams to surfaces of other bodies, (4,) [m]; inf for none."""
    reach = dvl.max_altitude / dvl.cosine + 1.0
    ranges, starts, open_beams, n = np.full(4, np.inf), np.zeros(4), np.arange(4), 4
    directions, hits = beams, Hits(np.empty(4), np.empty((4, 3)), np.empty(4, np.int32))
    for _ in range(MAX_OWN_SURFACES):
        part = Hits(hits.distance[:n], hits.normal[:n], hits.surface[:n])
        cast_from(dvl.rays, frame[:3], directions, starts[:n], reach, part)
        n_open = 0
        for i in range(n):
            surface = part.surface[i]
            if surface >= 0 and carray(pointer(dvl.is_own + surface), (1,), np.uint8)[0] != 0:
                starts[n_open] = part.distance[i] + OWN_SURFACE_GAP
                open_beams[n_open] = open_beams[i]
                n_open += 1
            else:
                ranges[open_beams[i]] = part.distance[i]
        if n_open == 0:
            break
        n, directions = n_open, beams[open_beams[:n_open]]
    return ranges


@njit
def update_track(
    track: Array,
    time: float,
    axes: Array,
    dvl: Record,
    measurements: tuple[Array, Flags],
    noise: Array,
) -> None:
    """Update a track by a ping.

    Args:
        track: the numbers of the track, see `TrackState`, (N_TRACK,).
        time: the time of the ping [s].
        axes: the axes of the sensor in W, (3, 3).
        dvl: a record of `DVL`.
        measurements: the velocity along each beam, (4,) [m/s], and whether it is valid, (4,).
        noise: the noise of each component of the velocity, (3,) [m/s].
    """
    beam_velocities, is_good = measurements
    interval = 0.0 if math.isnan(track[TIME]) else time - track[TIME]
    track[TIME] = time
    if is_good.sum() < MIN_BEAMS:
        track[: ERROR + 1] = math.nan
        return
    beams = dvl.directions[is_good]
    transposed_beams = np.ascontiguousarray(beams.T)
    columns = multiply_matrices(transposed_beams, beam_velocities[is_good].reshape((-1, 1)))
    velocity = eliminate(multiply_matrices(transposed_beams, beams), columns)[0][:, 0]
    for k in range(3):
        track[INSTRUMENT + k] = velocity[k] + noise[k]
    track[WORLD:ERROR] = rotate(axes, track[INSTRUMENT:WORLD])
    track[ERROR] = math.nan
    if is_good.all():
        total = SIGNS[0] * beam_velocities[0]
        for i in range(1, 4):
            total += SIGNS[i] * beam_velocities[i]
        track[ERROR] = dvl.error_scale * total
    for k in range(3):
        track[MADE_GOOD + k] += track[WORLD + k] * interval
    track[LAST_VALID] = time
