"""Caveats of a report: the error floor, a static scene, the optics."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from ...results.result import FLOOR, Result
from ..plots import is_fog_swept
from .outcomes import Ending

PAPER_FOG, PAPER_DISTANCE, PAPER_VISIBILITY = 1.1, 1.36, 0.86
"""What the UWSim benchmarking paper (Perez et al.) states: [1/m], [m], 1."""
STILL = 0.05
"""Below this the target counts as static in the image [px]."""


def floor(result: Result) -> str | None:
    """Return what a perfect tracker would score, ``corners 2.88 px, centroid 1.63 px``.

    As the run has measured it (facts ``floor_...``). None where no measure of pixels compares with
    what a tracker cannot know; an empty text where the result does not record it.
    """
    names = {column.name for column in result.columns}
    in_pixels = [column.name for column in result.columns_of_kind("measure") if column.unit == "px"]
    if all(f"{name}.visible" in names for name in in_pixels):  # of a body itself: no estimate
        return None
    messages = []
    for name in result.facts:
        fact = result.fact(name) if name.startswith(FLOOR) else None
        if fact is not None:
            messages.append(f"{name.removeprefix(FLOOR)} {fact[0]:.3g} {fact[1]}")
    return ", ".join(messages)


def is_static(result: Result) -> bool:
    """Whether the target was static in the image, within levels and from one to the next.

    Without the recorded motion (fact ``shift``), images at the ends of levels that were run alone
    are not used: a swaying vehicle is at the same phase in all of them.
    """
    shift = result.fact("shift")
    if shift is not None and shift[0] >= STILL:
        return False
    quads: dict[str, list[tuple[float, ...]]] = {}
    for image in result.images:
        if image.truth is not None:
            quads.setdefault(image.camera, []).append(image.truth)
    if any(float(np.ptp(np.array(found), axis=0).max()) >= STILL for found in quads.values()):
        return False
    if shift is not None:
        return True
    is_known = result.run.mode != "independent"
    return is_known and any(len(found) > 1 for found in quads.values())


def optics(result: Result, endings: Sequence[Ending]) -> dict[str, str] | None:
    """Compare the paper's fog 1.1 with f*, as density and as transmission.

    None where no fog is swept, or f* is not known.
    """
    star, distance = result.fact("f_star"), result.fact("d")
    if star is None or distance is None or not is_fog_swept(result):
        return None
    f, d = star[0], distance[0]
    z = result.fact("z")
    losses = [ending.first for ending in endings if ending.status == "lost" and ending.n]
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
