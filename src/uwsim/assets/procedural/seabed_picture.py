"""The picture on the tank's bottom: a photo mosaic of a sea floor, 3.48 x 7 m.

Sand with ripples, cobbles, larger rocks, shells and weed, as one would get from a survey at
a few metres' height. Nothing in it repeats, so that a tracker or a mosaic finds one place only.
"""

from __future__ import annotations

import cv2
import numpy as np

from ... import chance
from ..mesh import Texture
from .textures import Grey, Picture, finished, lit, mixed, noise, plain, step

SIZE = (2048, 1024)
"""Rows and columns: 3.4 mm a pixel."""


def stones(name: str, height: int, width: int, *, count: int, gap: float) -> tuple[Grey, Grey]:
    """Rounded stones laid side by side: their height 0..1 and a shade 0..1 for each.

    Voronoi cells of random points, their borders bent by noise; ``gap`` is the width of the
    joints [pixels].
    """
    draw = chance.stream(0, f"assets/{name}/stones")
    seeds = np.ones((height, width), dtype=np.uint8)
    seeds[draw.integers(0, height, count), draw.integers(0, width, count)] = 0
    _, labels = cv2.distanceTransformWithLabels(
        seeds, cv2.DIST_L2, cv2.DIST_MASK_5, labelType=cv2.DIST_LABEL_PIXEL
    )
    bend = float(np.sqrt(height * width / count)) * 0.10
    grid_x, grid_y = np.meshgrid(
        np.arange(width, dtype=np.float32), np.arange(height, dtype=np.float32)
    )
    cells = max(8, round(2 * np.sqrt(count)))
    grid_x += np.float32(bend) * noise(f"{name}/bend-x", height, width, cells=cells, octaves=2)
    grid_y += np.float32(bend) * noise(f"{name}/bend-y", height, width, cells=cells, octaves=2)
    bent = cv2.remap(
        labels.astype(np.float32), grid_x, grid_y, cv2.INTER_NEAREST, borderMode=cv2.BORDER_REFLECT
    )
    inside = np.ones((height, width), dtype=np.uint8)
    inside[:, 1:] &= bent[:, 1:] == bent[:, :-1]
    inside[1:] &= bent[1:] == bent[:-1]
    depth = cv2.distanceTransform(inside, cv2.DIST_L2, 3) - np.float32(gap)
    radius = 0.35 * float(np.sqrt(height * width / count))
    rise = np.clip(depth / np.float32(radius), 0.0, 1.0)
    shade = draw.random(count + 2, dtype=np.float32)[bent.astype(np.int64) % (count + 2)]
    return np.sqrt(rise).astype(np.float32), shade


def mosaic() -> Texture:
    """The whole picture."""
    h, w = SIZE
    name = "tank/mosaic"
    grain = noise(f"{name}/grain", h, w, cells=64, octaves=5, gain=0.9, tiles=False)
    broad = noise(f"{name}/broad", h, w, cells=3, octaves=5, tiles=False)
    sand: Picture = plain(h, w, (0.66, 0.62, 0.50)) * (1.0 + 0.07 * grain + 0.06 * broad)[..., None]
    y, x = np.mgrid[0:h, 0:w].astype(np.float32)
    wave = np.sin(x * 0.035 + y * 0.11 + 1.6 * broad)
    sand *= lit(wave, 0.9)[..., None]

    high, shade = stones(f"{name}/cobble", h, w, count=4200, gap=1.0)
    tint = mixed((0.30, 0.31, 0.30), (0.74, 0.68, 0.58), shade)
    cobble = tint * (1.0 + 0.10 * grain)[..., None] * lit(high, 1.6)[..., None]
    cobble *= (0.25 + 0.75 * step(0.0, 0.35, high))[..., None]
    where = step(-0.15, 0.25, broad + 0.25 * grain)
    picture = mixed(sand, cobble, where)

    high, shade = stones(f"{name}/rock", h, w, count=170, gap=6.0)
    crust = noise(f"{name}/crust", h, w, cells=24, octaves=6, gain=0.7, tiles=False)
    rock = mixed((0.24, 0.25, 0.24), (0.55, 0.47, 0.40), shade)
    rock = mixed(rock, (0.36, 0.40, 0.20), step(0.3, 1.6, crust))
    rock = rock * (lit(high + 0.05 * crust, 5.0) * (0.85 + 0.12 * grain))[..., None]
    chosen = ((shade * 97.0) % 1.0 < 0.30) & (high > 0.0)
    shadow = cv2.GaussianBlur(np.roll(chosen.astype(np.float32), (10, 10), (0, 1)), (0, 0), 6)
    picture *= (1.0 - 0.55 * shadow)[..., None]
    picture = mixed(picture, rock, cv2.GaussianBlur(chosen.astype(np.float32), (0, 0), 1.2))

    fronds = noise(f"{name}/weed", h, w, cells=40, octaves=5, gain=0.85, tiles=False)
    beds = step(1.0, 1.7, noise(f"{name}/beds", h, w, cells=5, octaves=4, tiles=False))
    weed = mixed((0.07, 0.13, 0.06), (0.32, 0.40, 0.14), step(-1.2, 1.8, fronds))
    picture = mixed(picture, weed * lit(fronds, 0.35)[..., None], beds * step(-0.9, 0.1, fronds))
    _scatter_shells(picture)
    _seams(picture)
    return finished(name, picture * np.array([0.90, 1.0, 1.04], dtype=np.float32), repeats=False)


def _scatter_shells(picture: Picture) -> None:
    """Shells and pebbles: small bright or dark ellipses with a shadow."""
    h, w = picture.shape[:2]
    draw = chance.stream(0, "assets/tank/mosaic/shells")
    for _ in range(420):
        centre = (int(draw.integers(0, w)), int(draw.integers(0, h)))
        axes = (int(draw.integers(2, 9)), int(draw.integers(2, 6)))
        angle = float(draw.uniform(0, 180))
        light = float(draw.choice([0.88, 0.80, 0.20, 0.45]))
        below = (centre[0] + 2, centre[1] + 2)
        cv2.ellipse(picture, below, axes, angle, 0, 360, (0.12, 0.11, 0.10), -1, cv2.LINE_8)
        tone = (light, light * 0.95, light * 0.84)
        cv2.ellipse(picture, centre, axes, angle, 0, 360, tone, -1, cv2.LINE_8)
        ridge = (max(1, axes[0] // 2), max(1, axes[1] // 2))
        cv2.ellipse(picture, centre, ridge, angle, 180, 360, tuple(0.75 * t for t in tone), 1)


def _seams(picture: Picture) -> None:
    """Each photograph of the mosaic was a little brighter or darker, and dimmer at its rim."""
    h, w = picture.shape[:2]
    draw = chance.stream(0, "assets/tank/mosaic/seams")
    rows, columns = 6, 3
    gain = np.ones((h, w), dtype=np.float32)
    for r in range(rows):
        for c in range(columns):
            top, left = (int(v) for v in draw.integers(-30, 30, 2))
            y0, x0 = max(0, r * h // rows + top), max(0, c * w // columns + left)
            y1, x1 = (r + 1) * h // rows + 40, (c + 1) * w // columns + 40
            part = gain[y0:y1, x0:x1]
            v, u = np.meshgrid(
                np.linspace(-1, 1, part.shape[0]), np.linspace(-1, 1, part.shape[1]), indexing="ij"
            )
            part[:] = draw.uniform(0.95, 1.06) * (1.04 - 0.09 * (u * u + v * v))
    picture *= cv2.GaussianBlur(gain, (0, 0), 2.0)[..., None]
