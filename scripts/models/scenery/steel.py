"""Steel that has been under water for years: rests of paint, rust, streaks, silt and growth."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from ..cached import cache_image
from ..fields import cells3
from ..surfaces import Material, make_material
from ..textures import Colour, Grey, Pixels, noise, smoothstep

DARK_RUST, RUST, ORANGE = (0.135, 0.10, 0.08), (0.225, 0.15, 0.10), (0.33, 0.205, 0.12)
SILT, TURF, SHELL = (0.36, 0.335, 0.27), (0.205, 0.195, 0.135), (0.47, 0.44, 0.38)
BRIGHTNESS = 1.42
"""The factor on all colours: reflectances of 0.05 to 0.15, as of rust and turf."""
N_BARNACLES = 28
"""The number of barnacles along a side of an image that they cover entirely."""


@dataclass(frozen=True)
class Coat:
    """The state of a surface; shares are from 0 (nowhere) to 1 (everywhere)."""

    paint: Colour = (0.5, 0.5, 0.5)
    """The colour of the paint."""
    paint_share: float = 0.4
    """The share that is still painted."""
    growth: float = 0.4
    """The share that turf and barnacles cover."""
    silt: float = 0.3
    """The share on which silt lies."""
    streaks: float = 0.5
    """The strength of streaks that run down."""


@cache_image
def weathered_steel(name: str, coat: Coat, *, size: int = 512, metres: float = 3.0) -> Material:
    """Return a material that repeats every ``metres``; its rows run down."""
    key = f"steel/{name}"
    clouds = noise(f"{key}/clouds", size, size, cells=2, octaves=7, gain=0.62)
    flakes = noise(f"{key}/flakes", size, size, cells=14, octaves=5, gain=0.7)
    grain = noise(f"{key}/grain", size, size, cells=size // 6, octaves=2, gain=0.8)
    runs = _streaks(key, size)
    image = _blend(_fill_plain(size, RUST), DARK_RUST, smoothstep(-0.4, 1.0, clouds + 0.4 * flakes))
    image = _blend(image, ORANGE, 0.8 * smoothstep(0.5, 1.7, flakes + 0.5 * runs))
    level = 2.6 * (coat.paint_share - 0.5)
    paint = smoothstep(-0.3, 0.3, level + 0.55 * clouds - 0.85 * flakes)
    image = _blend(image, coat.paint, paint * (0.9 - 0.25 * smoothstep(-0.5, 1.5, runs)))
    image = _blend(image, ORANGE, 0.55 * coat.streaks * smoothstep(0.6, 1.8, runs))
    image = _blend(image, DARK_RUST, 0.5 * coat.streaks * smoothstep(0.5, 1.6, -runs))
    height = 0.0035 * paint + 0.0022 * flakes * (1.0 - paint) + 0.0004 * grain
    roughness = np.clip(0.86 - 0.22 * paint + 0.05 * grain, 0.3, 1.0)

    silt = smoothstep(0.0, 1.2, 2.2 * (coat.silt - 0.5) + noise(f"{key}/silt", size, size, cells=4))
    image = _blend(image, SILT, 0.8 * silt)
    image, height, roughness = _add_growth(key, coat.growth, image, height, roughness, metres)
    image *= (1.0 + 0.05 * grain + 0.05 * clouds)[..., None] * BRIGHTNESS
    pixel = metres / size
    return make_material(key, image, height, roughness, pixel=(pixel, pixel), occlusion_depth=0.012)


def _add_growth(
    key: str, share: float, image: Pixels, height: Grey, roughness: Grey, metres: float
) -> tuple[Pixels, Grey, Grey]:
    """Add turf of algae, and colonies of barnacles."""
    size = height.shape[0]
    patches = noise(f"{key}/turf", size, size, cells=3, octaves=7, gain=0.66)
    tufts = noise(f"{key}/tufts", size, size, cells=size // 8, octaves=3, gain=0.8)
    turf = smoothstep(-0.6, 0.9, 2.6 * (share - 0.5) + patches)
    shade = np.clip(1.0 + 0.38 * tufts, 0.25, 1.9)[..., None]
    turf_image = np.array(TURF, dtype=np.float32) * shade
    image = image + (turf_image - image) * (0.72 * turf)[..., None]
    height = height + turf * (0.006 + 0.0028 * tufts)
    colony = smoothstep(-0.1, 0.7, 2.2 * (share - 0.6) + noise(f"{key}/colony", size, size))
    line = np.arange(size, dtype=np.float32) / size * N_BARNACLES
    x, y = np.meshgrid(line, line)
    points = np.stack([x, y, np.full_like(x, 0.5)], axis=2)
    distance, rank = cells3(f"{key}/barnacles", points, 1.0, period=N_BARNACLES)
    reach = 0.22 + 0.24 * ((rank * 37.0) % 1.0)
    is_there = colony > rank * 0.9 + 0.1
    cone = np.clip(1.6 * (1.0 - distance / reach), 0.0, 1.0) * is_there
    mouth = smoothstep(0.36, 0.22, distance / reach) * is_there
    shell = np.array(SHELL, dtype=np.float32) * (0.75 + 0.4 * ((rank * 91.0) % 1.0))[..., None]
    image = image + (shell - image) * smoothstep(0.0, 0.4, cone)[..., None]
    image *= (1.0 - 0.6 * mouth)[..., None]
    height = height + (cone - 0.8 * mouth) * np.float32(0.35 * metres / N_BARNACLES)
    return image, height, np.clip(roughness + 0.12 * turf, 0.0, 1.0)


def _streaks(key: str, size: int) -> Grey:
    """Return noise that is drawn out along the columns, of unit deviation."""
    runs = noise(f"{key}/runs", size, size, cells=size // 10, octaves=2)
    margin = size // 2
    bordered_map = cv2.copyMakeBorder(runs, margin, margin, 0, 0, cv2.BORDER_WRAP)
    blurred_map = cv2.GaussianBlur(bordered_map, (1, 161), 34.0)[margin:-margin]
    deviation = blurred_map.std()
    return np.asarray(blurred_map / deviation, dtype=np.float32)


def _fill_plain(size: int, colour: Colour) -> Pixels:
    return np.array(colour, dtype=np.float32) * np.ones((size, size, 1), dtype=np.float32)


def _blend(image: Pixels, end: Colour, amount: Grey) -> Pixels:
    blend: Pixels = image + (np.array(end, dtype=np.float32) - image) * amount[..., None]
    return blend
