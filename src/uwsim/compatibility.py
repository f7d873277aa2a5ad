"""The original's slips that can be had back by name: one table for files and ``--compat``.

By default every one of these is repaired. ``u:compatibility="thresholds rows"`` on ``<benchmark>``
or ``--compat thresholds,rows`` brings the named ones back; ``uwsim`` brings back all.
"""

from __future__ import annotations

from collections.abc import Iterable

from .errors import UnknownName

COMPATIBILITY: dict[str, str] = {
    "collision": "only the first body of a contact is looked at, and only its velocity counts",
    "current-force": "publishAsForce pushes with v^2 along each axis: the sign of v is lost",
    "fog-distance": "fog uses the clip-space z of the camera, not the distance along the ray",
    "last-norm": "an estimate of any age is scored; without a new one the last norm stands",
    "rows": "a row with a measure in error is left out of result.dat",
    "stop-once": "the benchmark's stopOn is never reset: after it, no further level begins",
    "thresholds": "trigger distances are compared squared: onMove 0.447 m, position 0.548 m",
    "visual-frames": "sensors hang on the visual frame of their link (scenes before July 2014)",
    "y0": "the camera parameter y0 counts from the bottom edge, but is published as it is",
}
"""Name -> what the original does. In alphabetical order."""


def compatibility(names: Iterable[str]) -> frozenset[str]:
    """Return the set of names asked for, ``uwsim`` standing for all.

    Raises:
        UnknownName: a name is not in the table.
    """
    asked: set[str] = set()
    for name in names:
        if name == "uwsim":
            asked.update(COMPATIBILITY)
        elif name in COMPATIBILITY:
            asked.add(name)
        else:
            raise UnknownName("compatibility", name, [*COMPATIBILITY, "uwsim"])
    return frozenset(asked)
