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
    "bag-fog": "over a recording fog is 1.44 times as thick, of one colour, none on grey images",
    "box-scale": "the bounding box of an object ignores its scaleFactor",
    "collision": "only the first body of a contact and its velocity count, and one touched object",
    "current-force": "publishAsForce acts with v^2 along each axis: the sign of v is lost",
    "current-target": "a current of a benchmark moves its target alone, not all floating bodies",
    "dvl-differences": "a DVL gives the mean velocity since its last sample, bottom or not",
    "fog-distance": "fog uses the clip-space z of the camera, not the distance along the ray",
    "fog-light": "water and fog keep their colours in any light: a night is bright in fog",
    "gps-metres": "a GPS is silent under water and gives metres of L, also with a nedOrigin",
    "imu-orientation": "an imu measures the attitude alone: rates and accelerations are 0",
    "last-norm": "an estimate of any age is scored; without a new one the last norm is kept",
    "multibeam-images": "multibeams are depth images: blind to 0.8 m, interpolated between pixels",
    "never-started": "a measure that never started is 0 (positionError 100, collision 1)",
    "no-markers": "SpawnMarker is not offered in a benchmark",
    "path-frame": "the position of its frame in W is added to the points of a path",
    "path-ise": "the ISE of a path is the integral of the error, not of its square",
    "path-point": "a path of one point is no path",
    "path-repeats": "a point that occurs twice in a path blocks all later points",
    "position-frame": "positionError is in W, and a position of its topic is taken to be in W",
    "position-start": "positionError is 100 until its first update, -1 until its first message",
    "pressure-z": "a pressure sensor gives z of L: the depth only where z of the scene points down",
    "reconstruction-box": "two corners of the box are turned into W: right for quarter turns only",
    "reconstruction-coverage": "coverage is divided by a slightly wrong number of cells",
    "reconstruction-empty": "without inliers the error is 0 and its variance 0/-1",
    "reconstruction-transform": "clouds are placed where their frame was when the level began",
    "restart": "a time or a collision that is started again begins at 0",
    "rows": "a row without an estimate or a path is left out of result.dat, unless errors cancel",
    "stop-once": "the benchmark's stopOn is never reset: after it, no further level begins",
    "thresholds": "trigger distances are compared squared: onMove 0.447 m, position 0.548 m",
    "time-log": "a time is 0 until it stops, in its log and its messages",
    "unseen": "points outside an image or behind the camera are projected, too",
    "visual-frames": "cameras and sonars are on the visual frame of their link (before July 2014)",
    "whole-rates": "a rate is a whole number: 33.3 is 33",
    "y0": "camera parameters x0, y0 count from the left and bottom edge, published as they are",
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
