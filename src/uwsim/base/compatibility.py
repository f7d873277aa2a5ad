"""Quirks of UWSim that can be restored by name, in files and by ``--compat``.

UWSim is the C++ simulator whose scene and benchmark files uwsim reads: *the original*. By default
all of its quirks are corrected. ``u:compatibility="thresholds rows"`` on ``<benchmark>`` or
``--compat thresholds,rows`` restores the named quirks. The name ``uwsim`` restores all but
`OLDER_QUIRKS`, which the last version of the original no longer has.
"""

from __future__ import annotations

from collections.abc import Iterable

from ..errors import UnknownName

COMPATIBILITY: dict[str, str] = {
    "bag-fog": "fog over a recording: 1.44 times the exponent, a fixed colour; none on grey images",
    "box-scale": "the bounding box of an object ignores the object's scaleFactor",
    "collision": "only the first body of a contact, its velocity, and one contact per frame count",
    "current-force": "publishAsForce pushes with v^2 along each axis: the sign of v is lost",
    "current-target": "a benchmark's current moves only its target, not all floating bodies",
    "dvl-differences": "a DVL gives the mean velocity since its last sample, also without a bottom",
    "fog-distance": "the distance in fog is clip-space z, not the distance along the ray",
    "fog-light": "the light rate does not scale the colours of water and fog",
    "gps-metres": "a GPS is silent under water and gives metres of L, also with a nedOrigin",
    "imu-orientation": "an IMU measures the attitude alone: its rates and accelerations are 0",
    "last-norm": "an estimate of any age is scored; without a new one the last norm is kept",
    "multibeam-images": "multibeams are made of depth images: blind to 0.8 m, interpolated",
    "never-started": "a measure that never started is 0 (positionError 100, collision 1)",
    "no-markers": "the service SpawnMarker is not offered in a benchmark",
    "path-frame": "the position of the path's frame in W is added to its points, without rotation",
    "path-ise": "the ISE of a path is the integral of the error, not of its square",
    "path-point": "a path of one point is treated as no path",
    "path-repeats": "a repeated point in a path blocks all following segments",
    "position-frame": "positionError is in W, and its topic's position is interpreted in W",
    "position-start": "positionError is 100 until its first update, -1 until its first message",
    "pressure-z": "a pressure sensor gives z of L: the depth only if z of the scene points down",
    "reconstruction-box": "only two corners of the box are transformed to W, and sorted",
    "reconstruction-coverage": "coverage is divided by a slightly wrong number of nodes",
    "reconstruction-empty": "without inliers the error is 0 and its variance 0/-1",
    "reconstruction-transform": "clouds are placed with the poses at the beginning of the level",
    "restart": "a time or a collision that is switched on again starts from 0",
    "rows": "result.dat omits a row without an estimate or a path, unless both are missing",
    "stop-once": "the benchmark's stopOn is never reset: after it, no further level begins",
    "thresholds": "trigger distances are compared squared: onMove 0.447 m, position 0.548 m",
    "time-log": "a time is 0 until it stops, in its log and its messages",
    "unseen": "points outside an image or behind the camera are projected, too",
    "visual-frames": "cameras and sonars are on the visual frame of their link (before July 2014)",
    "whole-rates": "a rate is a whole number: 33.3 is 33",
    "y0": "camera parameters x0, y0 count from the left and bottom edge, published unchanged",
}
"""The behaviour of the original, by the name of the quirk, in alphabetical order."""

OLDER_QUIRKS = frozenset({"visual-frames"})
"""The quirks of older versions of the original, which ``uwsim`` does not restore."""


def compatibility(names: Iterable[str]) -> frozenset[str]:
    """Return the set of quirks with these names; ``uwsim`` means all but `OLDER_QUIRKS`.

    Raises:
        UnknownName: a name is not in the table.
    """
    quirks: set[str] = set()
    for name in names:
        if name == "uwsim":
            quirks.update(COMPATIBILITY.keys() - OLDER_QUIRKS)
        elif name in COMPATIBILITY:
            quirks.add(name)
        else:
            raise UnknownName("compatibility", name, [*COMPATIBILITY, "uwsim"])
    return frozenset(quirks)
