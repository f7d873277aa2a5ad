"""The image on the tank's bottom: a photo mosaic of a sea floor, 3.48 x 7 m.

Sand with ripples, cobbles, larger rocks, shells and weed, as in a survey from a few metres' height.
Nothing in it repeats, so that a tracker or a mosaic finds only one place.
"""

from __future__ import annotations

from typing import NamedTuple

import cv2
import numpy as np
import numpy.typing as npt

from uwsim.assets.images import PixelImage
from uwsim.assets.mesh import Texture
from uwsim.base import rng

from ..textures import Grey, noise, shading, smoothstep

SIZE = (1632, 816)
"""The numbers of rows and columns: 4.3 mm a pixel."""

PALETTE = np.array(
    [
        (0.60, 0.60, 0.50),  # sand
        (0.27, 0.30, 0.31),  # dark cobbles
        (0.68, 0.67, 0.59),  # light cobbles
        (0.22, 0.25, 0.25),  # dark rock
        (0.49, 0.45, 0.39),  # light rock
        (0.30, 0.37, 0.20),  # crust on rocks
        (0.07, 0.14, 0.08),  # weed in shadow
        (0.28, 0.38, 0.16),  # weed in light
    ],
    dtype=np.float32,
)
"""The colours of which every pixel is mixed, in the order of the layers in `_paint_rows`."""

BAND_ROWS = 24
"""The number of rows that are painted at once."""

Pixels = npt.NDArray[np.uint8]


class Fields(NamedTuple):
    """The fields that determine the image, one value for each pixel.

    ``grain`` and ``dunes`` are fine and broad noise of the sand. The heights and shades of cobbles
    and rocks are from 0 to 1, as are the cover by rocks and their shadow. ``crust``, ``fronds`` and
    ``beds`` are noise of the crust on rocks, of weed, and of where weed grows. ``exposure`` is the
    brightness.
    """

    grain: Grey
    dunes: Grey
    cobble: Grey
    cobble_shade: Grey
    rock: Grey
    rock_shade: Grey
    on_rock: Grey
    shadow: Grey
    crust: Grey
    fronds: Grey
    beds: Grey
    exposure: Grey


def stones(
    name: str, height: int, width: int, *, count: int, gap: float, bend: float = 0.05
) -> tuple[Grey, Grey]:
    """Return the height, 0..1, and the shade, 0..1, of rounded stones laid side by side.

    Voronoi cells of random points, their borders bent by noise.

    Args:
        name: The name of the random stream.
        height: The number of rows.
        width: The number of columns.
        count: The number of stones.
        gap: Half the width of the joints [pixels].
        bend: The shift of the borders, in typical sizes of a stone.
    """
    stream = rng.stream(0, f"assets/{name}/stones")
    seeds = np.ones((height, width), dtype=np.uint8)
    seeds[stream.integers(0, height, count), stream.integers(0, width, count)] = 0
    _, labels = cv2.distanceTransformWithLabels(
        seeds, cv2.DIST_L2, cv2.DIST_MASK_5, labelType=cv2.DIST_LABEL_PIXEL
    )
    size = float(np.sqrt(height * width / count))
    cells = max(4, round(1.3 * min(height, width) / size))
    columns = np.arange(width, dtype=np.float32)[None, :]
    rows = np.arange(height, dtype=np.float32)[:, None]
    shift = np.float32(bend * size)
    map_x = shift * noise(f"{name}/bend-x", height, width, cells=cells, octaves=2, tiles=False)
    map_y = shift * noise(f"{name}/bend-y", height, width, cells=cells, octaves=2, tiles=False)
    map_x += columns
    map_y += rows
    shades = stream.random(count + 1, dtype=np.float32)
    image = cv2.remap(
        shades[labels], map_x, map_y, cv2.INTER_NEAREST, borderMode=cv2.BORDER_REFLECT
    )
    shade = np.asarray(image, dtype=np.float32)
    is_inside = np.ones((height, width), dtype=np.uint8)
    is_inside[:, 1:] = shade[:, 1:] == shade[:, :-1]
    is_inside[1:] &= shade[1:] == shade[:-1]
    rise: Grey = np.asarray(cv2.distanceTransform(is_inside, cv2.DIST_L2, 3), dtype=np.float32)
    rise -= np.float32(gap)
    rise *= np.float32(1.0 / (0.30 * size))
    np.clip(rise, 0.0, 1.0, out=rise)
    # A dome: steep at the rim, flat on top.
    high: Grey = rise * (np.float32(2.0) - rise)
    return high, shade


def mosaic() -> Texture:
    """Return the whole image."""
    h, w = SIZE
    name = "tank/mosaic"

    def field(layer: str, cells: int, octaves: int, gain: float = 0.55) -> Grey:
        return noise(f"{name}/{layer}", h, w, cells=cells, octaves=octaves, gain=gain, tiles=False)

    cobble, cobble_shade = stones(f"{name}/cobble", h, w, count=3000, gap=0.6, bend=0.07)
    rock, rock_shade = stones(f"{name}/rock", h, w, count=150, gap=5.0, bend=0.07)
    is_rock = ((rock_shade * 97.0) % 1.0 < 0.30) & (rock > 0.02)
    on_rock = cv2.blur(is_rock.astype(np.float32), (3, 3))
    small_rock = cv2.resize(on_rock, (w // 4, h // 4), interpolation=cv2.INTER_AREA)
    shadow = cv2.resize(cv2.GaussianBlur(np.roll(small_rock, (3, 3), (0, 1)), (0, 0), 2.0), (w, h))
    fields = Fields(*(np.asarray(values, dtype=np.float32) for values in (
        field("grain", 57, 5, 0.9), field("broad", 3, 6), cobble, cobble_shade,
        rock, rock_shade, on_rock, shadow, field("crust", 24, 6, 0.7),
        field("weed", 40, 5, 0.85), field("beds", 5, 4), _exposures(h, w),
    )))  # fmt: skip
    pixels = np.empty((h, w, 3), dtype=np.uint8)
    for top in range(0, h, BAND_ROWS):
        # In bands, so that the layers fit in the processor's cache, with a row more on each side.
        first_row, end_row = max(top - 1, 0), min(top + BAND_ROWS + 1, h)
        band = _paint_rows(first_row, Fields(*(values[first_row:end_row] for values in fields)))
        pixels[top : top + BAND_ROWS] = band[top - first_row : top - first_row + BAND_ROWS]
    _scatter_shells(pixels)
    return Texture(name=name, image=PixelImage(pixels), repeats=False)


def _paint_rows(first_row: int, fields: Fields) -> Pixels:
    """Paint rows of the image from their fields, beginning with number ``first_row``."""
    grain, dunes, cobble, cobble_shade, rock, rock_shade = fields[:6]
    on_rock, shadow, crust, fronds, beds, exposure = fields[6:]
    h, w = grain.shape
    phase_rows = np.arange(first_row, first_row + h, dtype=np.float32)[:, None] * np.float32(0.123)
    phase_columns = np.arange(w, dtype=np.float32)[None, :] * np.float32(0.039)
    ripples = np.sin(phase_rows + phase_columns + 1.6 * dunes)
    grain_shade = 1.0 + 0.09 * grain

    on_cobble = smoothstep(-0.2, 0.2, dunes + 0.30 * grain + 0.25 * (cobble - 0.6))
    on_weed = smoothstep(1.0, 1.7, beds) * smoothstep(-0.9, 0.1, fronds)
    weedless = exposure * (1.0 - on_weed)
    ground = (1.0 - 0.55 * shadow) * (1.0 - on_rock) * weedless

    sand = (grain_shade + 0.05 * dunes) * shading(ripples + 0.25 * grain, 0.32)
    sand *= (1.0 - on_cobble) * ground
    pebbles = grain_shade * shading(cobble, 1.0) * (0.42 + 0.58 * smoothstep(0.0, 0.6, cobble))
    pebbles *= on_cobble * ground
    boulders = (0.95 + 0.10 * grain) * shading(rock + 0.05 * crust, 2.6) * on_rock * weedless
    crust_cover = smoothstep(0.3, 1.6, crust)
    weed = shading(fronds, 0.30) * on_weed
    lightness = smoothstep(-1.2, 1.8, fronds)

    layers = np.empty((len(PALETTE), h * w), dtype=np.float32)
    for row, layer in enumerate(
        (
            sand,
            pebbles * (1.0 - cobble_shade),
            pebbles * cobble_shade,
            boulders * (1.0 - crust_cover) * (1.0 - rock_shade),
            boulders * (1.0 - crust_cover) * rock_shade,
            boulders * crust_cover,
            weed * (1.0 - lightness),
            weed * lightness,
        )
    ):
        layers[row] = layer.ravel()
    planes = np.einsum("ij,ik->jk", PALETTE * np.float32(255.0), layers)  # (3, h*w)
    image: Pixels = cv2.merge([cv2.convertScaleAbs(plane.reshape(h, w)) for plane in planes])
    return image


def _scatter_shells(image: Pixels) -> None:
    """Paint shells and pebbles: small bright or dark ellipses with a shadow."""
    h, w = image.shape[:2]
    stream = rng.stream(0, "assets/tank/mosaic/shells")
    for _ in range(380):
        centre = (int(stream.integers(0, w)), int(stream.integers(0, h)))
        axes = (int(stream.integers(2, 8)), int(stream.integers(2, 5)))
        angle = float(stream.uniform(0, 180))
        light = 255.0 * float(stream.choice([0.86, 0.76, 0.22, 0.48]))
        tone = (light * 0.97, light * 0.96, light * 0.86)
        cv2.ellipse(image, (centre[0] + 2, centre[1] + 2), axes, angle, 0, 360, (30, 32, 32), -1)
        cv2.ellipse(image, centre, axes, angle, 0, 360, tone, -1, cv2.LINE_AA)
        ridge = (max(1, axes[0] // 2), max(1, axes[1] // 2))
        ridge_tone = (0.72 * tone[0], 0.72 * tone[1], 0.72 * tone[2])
        cv2.ellipse(image, centre, ridge, angle, 180, 360, ridge_tone, 1, cv2.LINE_AA)


def _exposures(h: int, w: int) -> Grey:
    """Return the brightness of the mosaic's images, which differ and are dimmer at the rim."""
    stream = rng.stream(0, "assets/tank/mosaic/seams")
    rows, columns = 6, 3
    gain = np.ones((h // 2, w // 2), dtype=np.float32)
    for r in range(rows):
        for c in range(columns):
            top, left = (int(v) for v in stream.integers(-20, 20, 2))
            y0, x0 = max(0, r * h // 2 // rows + top), max(0, c * w // 2 // columns + left)
            y1, x1 = (r + 1) * h // 2 // rows + 24, (c + 1) * w // 2 // columns + 24
            part = gain[y0:y1, x0:x1]
            v = np.linspace(-1, 1, part.shape[0], dtype=np.float32)[:, None]
            u = np.linspace(-1, 1, part.shape[1], dtype=np.float32)[None, :]
            part[:] = stream.uniform(0.95, 1.06) * (1.04 - 0.08 * (u * u + v * v))
    return np.asarray(cv2.resize(gain, (w, h)), dtype=np.float32)
