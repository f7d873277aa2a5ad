"""The hull of the wreck: plates with gaps and a torn opening, frames, decks and bulkheads.

Frame of the ship: x forward, y to port, z up from the keel; the origin is amidships.
"""

from __future__ import annotations

import math

import numpy as np

from uwsim.base import rng

from ..fields import noise3
from ..shapes import Shape, box, join, quad, surface

LENGTH, HALF_BEAM, DEPTH = 26.0, 3.2, 3.5
"""Length, half beam and depth amidships [m]."""
BILGE = 0.95
"""The height of the turn of the bilge [m]."""
N_STATIONS, N_STRAKES = 34, 7
"""The numbers of plates along the hull, and from keel to deck edge."""
N_BOTTOM_STRAKES = 3
"""The number of strakes that have the paint of the bottom."""
TILE = 3.0
"""The side of an image of steel [m]."""
HOLD = (0.40, 0.66)
"""The ends of the hold, as shares of the length from the stern."""
HATCH_HALF_WIDTH, COAMING = 1.75, 0.55
"""The half width of the hatch, and the height of its coaming [m]."""
TANK_TOP = 0.55
"""The height of the floor of the hold [m]."""
TEAR_STATIONS, TEAR_STRAKES = (0.47, 0.60), (0.34, 0.93)
"""The torn opening on the starboard side: its shares of the length and of the girth."""


def _clamp(value: float) -> float:
    return min(1.0, max(0.0, value))


def deck_height(s: float) -> float:
    """Return the height of the deck's edge at a share of the length from the stern [m]."""
    return DEPTH + 1.1 * _clamp((s - 0.55) / 0.45) ** 2 + 0.45 * _clamp((0.3 - s) / 0.3) ** 2


def half_breadth(s: float, share: float) -> float:
    """Return the half breadth [m] at a share of the height, 0 at the bilge, 1 at the deck."""
    run = 0.10 + 0.22 * (1.0 - share)
    bow = 0.50 + 0.12 * share
    aft = math.sqrt(max(0.0, 1.0 - (1.0 - _clamp(s / run)) ** 2))
    fore = 1.0 - _clamp((s - bow) / (1.0 - bow)) ** (2.1 + 0.7 * share)
    return HALF_BEAM * (0.93 + 0.07 * share) * max(0.015, aft * fore)


def hull_point(s: float, t: float, side: float) -> tuple[float, float, float]:
    """Return a point of the shell: ``t`` is 0 at the keel and 1 at the deck; starboard is -1."""
    keel = 1.7 * _clamp((0.13 - s) / 0.13) ** 2 + 1.5 * _clamp((s - 0.90) / 0.10) ** 2
    top = deck_height(s)
    turn = keel + min(BILGE, 0.5 * (top - keel))
    if t < 0.4:
        angle = t / 0.4 * math.pi / 2.0
        y, z = half_breadth(s, 0.0) * math.sin(angle), keel + (turn - keel) * (1 - math.cos(angle))
    else:
        share = (t - 0.4) / 0.6
        y, z = half_breadth(s, share), turn + (top - turn) * share
    rake = 1.5 * (z / top) * s**9 - 0.9 * (z / top) * (1.0 - s) ** 9
    return LENGTH * (s - 0.5) + rake, side * y, z


def is_torn(s: float, t: float, side: float) -> bool:
    """Return whether the torn opening is at a place of the shell."""
    a = (s - 0.5 * sum(TEAR_STATIONS)) / (0.5 * (TEAR_STATIONS[1] - TEAR_STATIONS[0]))
    b = (t - 0.5 * sum(TEAR_STRAKES)) / (0.5 * (TEAR_STRAKES[1] - TEAR_STRAKES[0]))
    return side < 0.0 and a * a + b * b < 1.0


def make_plates() -> tuple[list[Shape], list[Shape]]:
    """Return the plates of the sides and those of the bottom."""
    stream = rng.stream(0, "assets/wreck/plates")
    offsets = stream.random((2, N_STRAKES, 2))  # strakes show other parts of the image
    sides: list[Shape] = []
    bottom: list[Shape] = []
    for side in (-1.0, 1.0):
        for station, strake in np.ndindex(N_STATIONS, N_STRAKES):
            s = (station / N_STATIONS, (station + 1) / N_STATIONS)
            t = (strake / N_STRAKES, (strake + 1) / N_STRAKES)
            offset = offsets[int(side > 0.0), strake]
            is_lost = float(stream.random()) < (0.05 if strake >= N_BOTTOM_STRAKES else 0.0)
            middle = 0.5 * (s[0] + s[1]), 0.5 * (t[0] + t[1])
            if is_torn(*middle, side) or (is_lost and 0.1 < middle[0] < 0.85):
                continue
            plate = _plate(s, t, side, strake, offset)
            (bottom if strake < N_BOTTOM_STRAKES else sides).append(plate)
    return sides, bottom


def _plate(
    s: tuple[float, float], t: tuple[float, float], side: float, strake: int, offset: np.ndarray
) -> Shape:
    """Return a plate: every second strake overlaps its neighbours, edges of the tear are bent."""
    n, m = 4, 3
    shares = np.linspace(0.0, 1.0, n + 1)
    rows = np.linspace(-0.02, 1.02, m + 1)
    points = np.empty((m + 1, n + 1, 3))
    for (i, row), (k, share) in ((a, b) for a in enumerate(rows) for b in enumerate(shares)):
        at_s = s[0] + (s[1] - s[0]) * float(share)
        at_t = min(1.0, max(0.0, t[0] + (t[1] - t[0]) * float(row)))
        points[i, k] = hull_point(at_s, at_t, side)
    side_direction = np.array([0.0, side, 0.0])
    dents = noise3("wreck/dents", points.astype(np.float32), 1.7, octaves=3).astype(np.float64)
    lap = 0.02 * (strake % 2)
    depth = lap + 0.035 * dents - 0.35 * _bend(points, side)
    points = points + side_direction * depth[..., None]
    u = points[..., :1] / TILE + offset[0]
    girth = np.cumsum(np.vstack([np.zeros((1, n + 1)), _lengths(np.diff(points, axis=0))]), axis=0)
    uvs = np.concatenate([side * -u, girth[..., None] / TILE + offset[1]], axis=2)
    plate = surface(points, uvs)
    return plate if side < 0.0 else plate.flip()


def _bend(points: np.ndarray, side: float) -> np.ndarray:
    """Return how much plates around the tear are pushed in, 0..1."""
    if side > 0.0:
        return np.zeros(points.shape[:2])
    x0 = LENGTH * (0.5 * sum(TEAR_STATIONS) - 0.5)
    a = (points[..., 0] - x0) / (0.62 * LENGTH * (TEAR_STATIONS[1] - TEAR_STATIONS[0]))
    b = (points[..., 2] - 2.2) / 2.2
    square = a * a + b * b
    ripple = noise3("wreck/tear", points.astype(np.float32), 0.6, octaves=2).astype(np.float64)
    return np.clip(1.5 - square, 0.0, 1.0) * (1.0 + 0.8 * ripple)


def _lengths(vectors: np.ndarray) -> np.ndarray:
    return np.sqrt((vectors * vectors).sum(axis=-1))


def make_frames() -> list[Shape]:
    """Return the frames inside the shell, each a flat bar with a flange."""
    frames = []
    for station in range(2, N_STATIONS - 1):
        s = station / N_STATIONS
        for side in (-1.0, 1.0):
            ts = np.linspace(0.08, 0.99, 14)
            is_lost = [is_torn(s, float(t), side) for t in ts]
            if any(is_lost):  # a stub remains below the opening
                ts = ts[: is_lost.index(True)]
            if len(ts) < 2:
                continue
            shell = np.array([hull_point(s, float(t), side) for t in ts])
            middle = np.array([shell[0, 0], 0.0, 1.9])
            directions = middle - shell
            directions /= _lengths(directions)[:, None]
            edge = shell + 0.17 * directions
            flange = np.array([0.09, 0.0, 0.0])
            rows = np.stack([shell + 0.03 * directions, edge, edge + flange])
            lengths = np.linspace(0.0, 3.0, len(ts))
            uvs = np.stack(np.broadcast_arrays(np.array([[0.0], [0.06], [0.09]]), lengths), axis=2)
            frames.append(surface(rows, uvs))
    return frames


def make_decks() -> list[Shape]:
    """Return the main deck with its hatch, and the floor of the hold."""
    shapes = []
    stations = np.unique([*np.linspace(0.005, 0.995, 40), *HOLD])
    for s0, s1 in zip(stations[:-1].tolist(), stations[1:].tolist(), strict=True):
        is_hatch = HOLD[0] + 0.02 <= 0.5 * (s0 + s1) <= HOLD[1] - 0.02
        for side in (-1.0, 1.0):
            edge = [np.array(hull_point(s, 1.0, side)) for s in (s0, s1)]
            inner_width = HATCH_HALF_WIDTH if is_hatch else 0.0
            middle = [
                np.array([p[0], side * min(inner_width, abs(p[1])), p[2] + 0.08]) for p in edge
            ]
            corners = [middle[0], middle[1], edge[1], edge[0]]
            deck = _lay(corners, side)
            shapes.append(deck)
    for s0, s1 in zip(*(np.linspace(*HOLD, 9)[k : 8 + k].tolist() for k in (0, 1)), strict=True):
        for side in (-1.0, 1.0):
            edge = [_edge_at_height(s, TANK_TOP, side) for s in (s0, s1)]
            middle = [np.array([p[0], 0.0, TANK_TOP]) for p in edge]
            shapes.append(_lay([middle[0], middle[1], edge[1], edge[0]], side))
    return shapes


def _lay(corners: list[np.ndarray], side: float) -> Shape:
    """Return a level face that faces up, with coordinates in metres."""
    a, b, c, d = (tuple(corner.tolist()) for corner in corners)
    face = quad(a, b, c, d, cuts=(1, 3))
    return (face if side > 0.0 else face.flip()).project_uv(TILE)


def _edge_at_height(s: float, z: float, side: float) -> np.ndarray:
    """Return the point of the shell at a height, by bisection."""
    low, high = 0.0, 1.0
    for _ in range(30):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if hull_point(s, middle, side)[2] < z else (low, middle)
    return np.array(hull_point(s, low, side))


def make_hold() -> list[Shape]:
    """Return the bulkheads of the hold, the coaming of the hatch and two of its beams."""
    shapes = []
    for s in HOLD:
        ts = np.linspace(0.0, 1.0, 12)
        starboard = np.array([hull_point(s, float(t), -1.0) for t in ts])
        port = starboard * np.array([1.0, -1.0, 1.0])
        shapes.append(surface(np.stack([starboard, port])).project_uv(TILE))
    x0, x1 = (LENGTH * (s - 0.5) for s in (HOLD[0] + 0.02, HOLD[1] - 0.02))
    w, low, high = HATCH_HALF_WIDTH, DEPTH, DEPTH + COAMING + 0.2
    for lower, upper in (
        ((x0 - 0.06, -w - 0.06, low), (x1 + 0.06, -w, high)),
        ((x0 - 0.06, w, low), (x1 + 0.06, w + 0.06, high)),
        ((x0 - 0.06, -w, low), (x0, w, high)),
        ((x1, -w, low), (x1 + 0.06, w, high)),
        ((x0 + 1.5, -w, high - 0.45), (x0 + 1.62, w, high - 0.05)),
        ((x0 + 3.1, -w, high - 0.45), (x0 + 3.22, w, high - 0.05)),
    ):
        shapes.append(box(lower, upper).project_uv(TILE))
    return [join(*shapes)]
