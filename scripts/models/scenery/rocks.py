"""Boulders: ``objects/rock1`` to ``rock5``, z up; a fifth of each is below z = 0, in the sand.

A rock is a sphere that random planes cut, with noise on its surface: breaks are flat and edges are
round, as of stone in surf. Crust, turf of algae and barnacles grow on it, mostly on its top.
"""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np

from uwsim.base import rng

from ..baked import Skin, bake
from ..fields import Points, Values, cells3, noise3, ridges3
from ..parts import Part
from ..textures import Colour, smoothstep

BURIED_SHARE = 0.2
"""The share of the height that is below z = 0."""
BASALT, GRANITE, LIMESTONE = (0.31, 0.31, 0.305), (0.44, 0.41, 0.375), (0.57, 0.54, 0.475)
CRUST, TURF, BARNACLE = (0.44, 0.33, 0.325), (0.285, 0.28, 0.175), (0.66, 0.63, 0.56)
"""The colours of coralline algae, of turf, and of barnacles and worm tubes."""


def rock1() -> tuple[Part, ...]:
    """A stone of 0.6 m."""
    return _rock("rock1", (0.34, 0.28, 0.22), GRANITE, n=14, side=160)


def rock2() -> tuple[Part, ...]:
    """A boulder of 1.3 m."""
    return _rock("rock2", (0.72, 0.58, 0.52), BASALT, n=18, side=192)


def rock3() -> tuple[Part, ...]:
    """A flat slab of 2.2 m."""
    return _rock("rock3", (1.2, 0.85, 0.42), LIMESTONE, n=20, side=224)


def rock4() -> tuple[Part, ...]:
    """A boulder of 3 m."""
    return _rock("rock4", (1.6, 1.35, 1.15), BASALT, n=22, side=208)


def rock5() -> tuple[Part, ...]:
    """A standing rock of 4 m."""
    return _rock("rock5", (1.5, 1.3, 2.3), GRANITE, n=22, side=208)


def _rock(
    name: str, axes: tuple[float, float, float], stone: Colour, *, n: int, side: int = 256
) -> tuple[Part, ...]:
    scale = np.array(axes, dtype=np.float32)
    size = float(np.mean(axes))
    part = bake(
        f"rocks/{name}",
        partial(rock_radius, name, scale),
        partial(paint_rock, name, size, stone),
        n=n,
        side=side,
    )
    bottom, top = part.mesh.vertices[:, 2].min(), part.mesh.vertices[:, 2].max()
    shift = np.array([0.0, 0.0, -bottom - BURIED_SHARE * (top - bottom)], dtype=np.float32)
    return (replace(part, mesh=replace(part.mesh, vertices=part.mesh.vertices + shift)),)


def rock_radius(name: str, scale: Points, direction: Points) -> Values:
    """Return the radius [m]: an ellipsoid that planes cut, with noise."""
    stream = rng.stream(0, f"assets/rocks/{name}/planes")
    axis_shares = direction / scale
    radius = 1.0 / np.sqrt((axis_shares * axis_shares).sum(axis=-1))
    unit = direction * radius[..., None] / scale  # on the unit sphere
    share = np.full(direction.shape[:-1], 1.25, dtype=np.float32)
    for _ in range(13):
        normal = stream.standard_normal(3)
        normal = (normal / np.sqrt((normal * normal).sum())).astype(np.float32)
        distance = np.float32(stream.uniform(0.62, 0.95))
        cosine = np.maximum((unit * normal).sum(axis=-1), np.float32(1e-3))
        share = _smooth_minimum(share, distance / cosine, 0.10)
    bumps = noise3(f"rocks/{name}/bumps", unit * 1.0, 0.9, octaves=4, gain=0.48)
    cracks = ridges3(f"rocks/{name}/cracks", unit * 1.0, 0.8, octaves=2)
    relief: Values = share * (1.0 + 0.055 * bumps - 0.05 * smoothstep(0.7, 1.0, cracks))
    return radius * relief


def _smooth_minimum(a: Values, b: Values, width: float) -> Values:
    h = np.clip(0.5 + 0.5 * (b - a) / np.float32(width), 0.0, 1.0)
    minimum: Values = b + (a - b) * h - np.float32(width) * h * (1.0 - h)
    return minimum


def paint_rock(name: str, size: float, stone: Colour, points: Points, direction: Points) -> Skin:
    """Return stone with layers, cracks and growth."""
    key = f"rocks/{name}"
    grain = noise3(f"{key}/grain", points, 0.12, octaves=6, gain=0.72)
    cloud_noise = noise3(f"{key}/broad", points, 0.7 * size, octaves=4)
    layer_height = points[..., 2] + 0.3 * points[..., 0]
    layers = np.sin(layer_height * np.float32(2 * np.pi * 4.0 / size) + 1.8 * cloud_noise)
    cracks = smoothstep(0.80, 0.97, ridges3(f"{key}/cracks", points, 0.45 * size, octaves=3))
    colour = (
        np.array(stone, dtype=np.float32)
        * (1.0 + 0.16 * grain + 0.14 * cloud_noise + 0.05 * layers)[..., None]
    )
    colour *= (1.0 - 0.6 * cracks)[..., None]
    height = 0.006 * grain + 0.004 * layers * min(1.0, size) - 0.022 * cracks

    upward = smoothstep(-0.3, 0.8, direction[..., 2] + 0.22 * cloud_noise)
    crust = smoothstep(0.15, 0.5, noise3(f"{key}/crust", points, 0.35, octaves=5, gain=0.6))
    crust *= 0.25 + 0.45 * (1.0 - upward)
    turf_noise = noise3(f"{key}/turf", points, 0.5, octaves=6, gain=0.7)
    turf = smoothstep(0.0, 0.7, turf_noise + 1.1 * upward - 0.7)
    tufts = noise3(f"{key}/tufts", points, 0.035, octaves=3, gain=0.8)
    distance, shade = cells3(f"{key}/barnacles", points, 0.028)
    colony = smoothstep(0.4, 1.1, noise3(f"{key}/colony", points, 0.45, octaves=4))
    shell = smoothstep(0.42, 0.25, distance) * colony * (shade > 0.35)
    mouth = smoothstep(0.13, 0.08, distance) * shell

    colour = _blend(colour, CRUST, crust * (0.8 + 0.2 * grain))
    turf_colour = np.array(TURF, dtype=np.float32) * (1.0 + 0.35 * tufts)[..., None]
    colour = colour + (turf_colour - colour) * (0.85 * turf)[..., None]
    colour = _blend(colour, BARNACLE, shell * (0.7 + 0.3 * shade))
    colour *= (1.0 - 0.7 * mouth)[..., None]
    height = height + 0.003 * crust + turf * (0.004 + 0.003 * tufts) + 0.008 * shell - 0.008 * mouth
    roughness = np.clip(0.78 + 0.05 * grain + 0.15 * turf - 0.1 * crust, 0.3, 1.0)
    return Skin(colour, np.asarray(height, dtype=np.float32), roughness)


def _blend(colour: Points, end: Colour, amount: Values) -> Points:
    blend: Points = colour + (np.array(end, dtype=np.float32) - colour) * amount[..., None]
    return blend
