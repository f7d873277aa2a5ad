"""The caveats of a report: the error floor, a static scene, the optics."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from ...results.result import ERROR_FLOOR_PREFIX, Result
from ..plots import is_fog_swept
from .outcomes import Ending

PAPER_FOG, PAPER_DISTANCE, PAPER_VISIBILITY = 1.1, 1.36, 0.86
"""The fog density [1/m], distance [m] and visibility [1] in the paper on UWSim's benchmarks (Perez
et al.)."""
MAX_STATIC_SHIFT = 0.05
"""The motion in the image below which the target counts as static [px]."""


def error_floor_text(result: Result) -> str | None:
    """Return the errors of a perfect tracker, ``corners 2.88 px, centroid 1.63 px``.

    The run has measured them (facts ``floor_...``). None if a perfect tracker has no error; an
    empty text if the result does not record the errors.
    """
    names = {column.name for column in result.columns}
    in_pixels = [column.name for column in result.columns_of_kind("measure") if column.unit == "px"]
    if all(f"{name}.visible" in names for name in in_pixels):  # measures of a body, not an estimate
        return None
    messages = []
    for name in result.facts:
        fact = result.fact(name) if name.startswith(ERROR_FLOOR_PREFIX) else None
        if fact is not None:
            messages.append(f"{name.removeprefix(ERROR_FLOOR_PREFIX)} {fact[0]:.3g} {fact[1]}")
    return ", ".join(messages)


def is_static(result: Result) -> bool:
    """Return True if the target was static in the image, within levels and between them.

    Without the recorded motion (fact ``shift``), images at the ends of independent levels are not
    used: a swaying vehicle has the same phase in all of them.
    """
    shift = result.fact("shift")
    if shift is not None and shift[0] >= MAX_STATIC_SHIFT:
        return False
    quads: dict[str, list[tuple[float, ...]]] = {}
    for image in result.images:
        if image.truth is not None:
            quads.setdefault(image.camera, []).append(image.truth)
    motions = [float(np.ptp(np.array(corners), axis=0).max()) for corners in quads.values()]
    if any(motion >= MAX_STATIC_SHIFT for motion in motions):
        return False
    if shift is not None:
        return True
    is_known = result.run.mode != "independent"
    return is_known and any(len(corners) > 1 for corners in quads.values())


def optics_texts(result: Result, endings: Sequence[Ending]) -> dict[str, str] | None:
    """Return texts that compare the paper's fog 1.1 with f*, as density and as transmission.

    None if no fog is swept, or f* is unknown.
    """
    star, distance = result.fact("f_star"), result.fact("d")
    if star is None or distance is None or not is_fog_swept(result):
        return None
    f, d = star[0], distance[0]
    z = result.fact("z")
    losses = [ending.first_levels for ending in endings if ending.status == "lost" and ending.n]
    return {
        "f_star": f"{f:.3f}",
        "d": f"{d:.3f}",
        "z": f"{z[0]:g}" if z else "0.5",
        "difference": f"{abs(PAPER_FOG - f):.3f}",
        "side": "below" if f > PAPER_FOG else "above",
        "paper_fog": f"{PAPER_FOG:g}",
        "paper_transmission": f"{100 * math.exp(-((PAPER_FOG * d) ** 2)):.1f} %",
        "star_transmission": f"{100 * math.exp(-((f * d) ** 2)):.1f} %",
        "paper_distance": f"{PAPER_DISTANCE:g}",
        "paper_visibility": f"{PAPER_VISIBILITY:g}",
        "paper_formula": f"{1 - math.exp(-((PAPER_FOG * PAPER_DISTANCE) ** 2)):.3f}",
        "paper_needs_fog": f"{math.sqrt(-math.log(1 - PAPER_VISIBILITY)) / PAPER_DISTANCE:.3f}",
        "paper_needs_distance": f"{math.sqrt(-math.log(1 - PAPER_VISIBILITY)) / PAPER_FOG:.2f}",
        "lost": losses[0] if losses else "",
    }
