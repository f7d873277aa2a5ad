"""The images of sea floors: tiles that fit together in any order in which their corners agree.

A tile has sand or gravel at each of its four corners. Two tiles whose common corners agree have the
same pixels along their common edge, so that a floor of tiles in random order does not repeat, with
images of a few metres (Wang tiles; Cohen et al., ACM SIGGRAPH 2003). The inside differs between
tiles of equal corners: shells, stones and the bends of ripples.
"""

from __future__ import annotations

import itertools
from typing import NamedTuple

import numpy as np

from uwsim.base import rng

from ..fields import cells3
from ..surfaces import Material, make_material
from ..textures import Grey, Pixels, noise, smoothstep

TILE = 1.2
"""The side of a tile [m]."""
SIDE, MARGIN = 256, 6
"""The side of the image of a tile with its margin, and the margin [px]."""
CONTENT_SIDE = SIDE - 2 * MARGIN
N_COLUMNS = 6
"""The number of tiles in a row of the image; there are as many rows."""
N_RIPPLES = 7
"""The number of ripples along a tile."""
SAND, TROUGH, FLECK = (0.60, 0.53, 0.41), (0.46, 0.41, 0.33), (0.80, 0.77, 0.70)
STONES = ((0.33, 0.32, 0.30), (0.45, 0.42, 0.37), (0.40, 0.35, 0.29), (0.52, 0.48, 0.41))

Corners = tuple[int, int, int, int]
"""The corners of a tile, 1 for gravel, 0 for sand: lower left and right, upper left and right."""


class _Base(NamedTuple):
    """Images of one tile's period, which all tiles use: heights [m] and noise."""

    phase: Grey
    grain: Grey
    clouds: Grey
    details: Grey


def tile_corners() -> list[Corners]:
    """Return the corners of each tile in the image: each case twice, equal corners four times."""
    cases: list[Corners] = [*itertools.product((0, 1), repeat=4)]  # type: ignore[list-item]
    return [*cases, *cases, cases[0], cases[0], cases[-1], cases[-1]]


def seabed_material() -> Material:
    """Return the material with all tiles."""
    base = make_base_layers()
    tiles = [make_tile(index, corners, base) for index, corners in enumerate(tile_corners())]
    images, heights, roughnesses = (
        np.concatenate(
            [np.concatenate(list(row), axis=1) for row in _rows([tile[k] for tile in tiles])]
        )
        for k in range(3)
    )
    pixel = TILE / CONTENT_SIDE
    return make_material(
        "seabed", images, heights, roughnesses, pixel=(pixel, pixel), repeats=False,
        occlusion_depth=0.02,
    )  # fmt: skip


def tile_frame(index: int) -> tuple[float, float, float, float]:
    """Return the coordinates (u0, v0, u1, v1) of the inside of a tile in the image."""
    row, column = divmod(index, N_COLUMNS)
    width = SIDE * N_COLUMNS
    u0 = (column * SIDE + MARGIN) / width
    v1 = 1.0 - (row * SIDE + MARGIN) / width
    return u0, v1 - CONTENT_SIDE / width, u0 + CONTENT_SIDE / width, v1


def make_base_layers() -> _Base:
    """Make the layers of one period that all tiles use."""
    rows = np.arange(CONTENT_SIDE, dtype=np.float32)[:, None] / np.float32(CONTENT_SIDE)
    columns = np.arange(CONTENT_SIDE, dtype=np.float32)[None, :] / np.float32(CONTENT_SIDE)
    warp = noise("seabed/warp", CONTENT_SIDE, CONTENT_SIDE, cells=2, octaves=4)
    phase = np.float32(2.0 * np.pi) * (N_RIPPLES * rows + columns) + 1.1 * warp
    return _Base(
        phase,
        noise("seabed/grain", CONTENT_SIDE, CONTENT_SIDE, cells=61, octaves=3, gain=1.0),
        noise("seabed/broad", CONTENT_SIDE, CONTENT_SIDE, cells=3, octaves=4),
        noise("seabed/fine", CONTENT_SIDE, CONTENT_SIDE, cells=12, octaves=4, gain=0.7),
    )


def make_tile(index: int, corners: Corners, base: _Base) -> tuple[Pixels, Grey, Grey]:
    """Return the colour, the height [m] and the roughness of a tile with its margin."""
    layers = _Base(*(np.pad(layer, MARGIN, mode="wrap") for layer in base))
    line = np.clip((np.arange(SIDE, dtype=np.float32) - MARGIN + 0.5) / CONTENT_SIDE, 0.0, 1.0)
    u, v = line[None, :], 1.0 - line[:, None]
    low_left, low_right, high_left, high_right = corners
    gravel = (1 - v) * ((1 - u) * low_left + u * low_right)
    gravel = gravel + v * ((1 - u) * high_left + u * high_right)
    inner_weight = 16.0 * u * (1.0 - u) * v * (1.0 - v)  # 0 along the edges
    bend_noise = noise(f"seabed/{index}", CONTENT_SIDE, CONTENT_SIDE, cells=3, octaves=4)
    bend = inner_weight * np.pad(bend_noise, MARGIN, mode="wrap")
    cover = smoothstep(0.25, 0.85, gravel + 0.10 * layers.clouds + 0.16 * bend)

    # a full turn between the corners' phases would show an edge; the bend vanishes there
    phase = layers.phase + 1.6 * bend
    ripple = np.sin(phase) + 0.22 * np.sin(2.0 * phase + 0.9)
    strength = np.clip(0.8 + 0.25 * layers.clouds + 0.3 * bend, 0.15, 1.3)
    height = 0.0075 * ripple * strength * (1.0 - 0.8 * cover) + 0.0003 * layers.grain
    image = np.array(SAND, dtype=np.float32) * np.ones((SIDE, SIDE, 1), dtype=np.float32)
    image = _blend(image, TROUGH, 0.7 * smoothstep(0.1, -1.1, ripple * strength))
    image = _blend(image, FLECK, 0.5 * smoothstep(1.6, 2.6, layers.grain))
    image *= (1.0 + 0.045 * layers.grain + 0.035 * layers.clouds + 0.03 * bend)[..., None]
    roughness = np.full((SIDE, SIDE), 0.92, dtype=np.float32)
    for key, n_cells, share in (
        ("pebbles", 30, 0.9),
        ("stones", 13, 0.6),
        ("cobbles", 6, 0.22),
    ):
        image, height = _add_stones(key, n_cells, cover * share, image, height)
    _scatter_shells(index, image, height)
    return image, height.astype(np.float32), roughness


def _add_stones(
    key: str, n_cells: int, cover: Grey, image: Pixels, height: Grey
) -> tuple[Pixels, Grey]:
    """Add stones where gravel covers the sand, few on plain sand."""
    line = (np.arange(SIDE, dtype=np.float32) - MARGIN + 0.5) / CONTENT_SIDE * n_cells
    x, y = np.meshgrid(line, line)
    points = np.stack([x, y, np.full_like(x, 0.5)], axis=2)
    distance, shade = cells3(f"seabed/{key}", points, 1.0, period=n_cells)
    rank = (shade * 53.0) % 1.0
    reach = 0.24 + 0.36 * ((shade * 29.0) % 1.0)
    # a stone at the rim of the gravel is half buried, and thus smaller
    exposure = smoothstep(0.0, 0.30, cover - rank)
    is_there = (exposure > 0.0).astype(np.float32)
    ratio = distance / np.maximum(reach * np.sqrt(exposure), np.float32(1e-3))
    dome = np.sqrt(np.clip(1.0 - ratio * ratio, 0.0, 1.0)) * reach * exposure
    rise = dome * np.float32(0.42 * TILE / n_cells)
    tone = np.array(STONES, dtype=np.float32)[((shade * 101.0) % 1.0 * len(STONES)).astype(int)]
    tone = tone * (0.8 + 0.4 * ((shade * 71.0) % 1.0))[..., None]
    amount = smoothstep(0.02, 0.16, dome)
    ring = smoothstep(1.35, 1.0, ratio) * is_there * (1.0 - amount)
    image = image * (1.0 - 0.35 * ring)[..., None]
    return image + (tone - image) * amount[..., None], height + rise


def _scatter_shells(index: int, image: Pixels, height: Grey) -> None:
    """Add shells and single stones to the inside of a tile, in place."""
    stream = rng.stream(0, f"assets/seabed/{index}/shells")
    for _ in range(26):
        long_axis = float(stream.uniform(2.0, 9.0) if stream.random() < 0.3 else 2.2)  # [px]
        short_axis = long_axis * float(stream.uniform(0.5, 0.95))
        reach = int(long_axis) + 3
        edge = MARGIN + reach + 2
        row, column = (int(value) for value in stream.integers(edge, SIDE - edge, 2))
        cos, sin = (float(value) for value in _unit(stream))
        is_shell = float(stream.random()) < 0.6
        tone = np.float32(stream.uniform(0.62, 0.9) if is_shell else stream.uniform(0.2, 0.5))
        window = (slice(row - reach, row + reach + 1), slice(column - reach, column + reach + 1))
        y, x = np.mgrid[-reach : reach + 1, -reach : reach + 1].astype(np.float32)
        a, b = (cos * x + sin * y) / long_axis, (cos * y - sin * x) / short_axis
        radius = np.sqrt(a * a + b * b)
        amount = smoothstep(1.05, 0.85, radius)
        ribs = 1.0 + (0.14 if is_shell else 0.0) * np.sin(9.0 * a + 4.0 * b)
        shadow = smoothstep(1.6, 0.9, np.sqrt((a - 0.35) * (a - 0.35) + (b + 0.35) * (b + 0.35)))
        patch = image[window] * (1.0 - 0.4 * shadow)[..., None]
        colour = np.array((1.0, 0.95, 0.86), dtype=np.float32) * np.asarray(tone * ribs)[..., None]
        image[window] = patch + (colour - patch) * amount[..., None]
        dome = np.sqrt(np.clip(1.0 - radius * radius, 0.0, 1.0))
        height[window] += dome * np.float32(0.5 * short_axis * TILE / CONTENT_SIDE)


def _unit(stream: np.random.Generator) -> tuple[float, float]:
    angle = float(stream.uniform(0.0, 2.0 * np.pi))
    return float(np.cos(angle)), float(np.sin(angle))


def _blend(image: Pixels, end: tuple[float, float, float], amount: Grey) -> Pixels:
    blend: Pixels = image + (np.array(end, dtype=np.float32) - image) * amount[..., None]
    return blend


def _rows(tiles: list[Pixels]) -> list[list[Pixels]]:
    return [tiles[i : i + N_COLUMNS] for i in range(0, len(tiles), N_COLUMNS)]
