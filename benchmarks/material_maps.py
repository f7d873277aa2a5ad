"""Images of a textured floor without and with maps, under both image models. JSON on stdout.

The floor fills most of an image of 640 x 480 pixels. The camera moves by 1 nm from image to image,
so that each is drawn. ``ratio`` is the CPU time over 1.25 times that of the floor without maps.
"""

from __future__ import annotations

import numpy as np
from measure import main, milliseconds

from uwsim.assets.images import PixelImage
from uwsim.assets.mesh import Material, Mesh, Model, Texture
from uwsim.base.geometry import Intrinsics, Pose
from uwsim.optics import find_water
from uwsim.rendering.physical.physical_water import PhysicalWater
from uwsim.rendering.renderer import Renderer
from uwsim.rendering.water import Light, Water

SIDE = 1024
"""The side of the textures [px]."""
PHYSICAL_WATER = Water(
    surface_height=6.0,
    physical_water=PhysicalWater(medium=find_water("jerlov-3C"), exposure=2.0),
)
WATERS = {"fog": Water(fog=0.1), "physical": PHYSICAL_WATER}
MAX_RATIO = 1.25
"""The most time that maps may take, as a multiple of the time without them."""
EYE, TARGET = np.array([0.0, -3.0, 1.4]), np.array([0.0, 0.5, 0.0])


def make_texture(name: str, low: tuple[int, ...], high: tuple[int, ...]) -> Texture:
    """Return a texture of even noise."""
    generator = np.random.Generator(np.random.Philox(len(name)))
    pixels = generator.integers(low, high, (SIDE, SIDE, 3)).astype(np.uint8)
    return Texture(name=name, image=PixelImage(pixels))


def make_floor(base: Texture, material: Material | None) -> Model:
    """Return a floor of 10 x 10 m."""
    mesh = Mesh(
        vertices=np.array([[-5, -5, 0], [5, -5, 0], [5, 5, 0], [-5, 5, 0]], np.float32),
        normals=np.tile(np.array([0, 0, 1], np.float32), (4, 1)),
        uvs=np.array([[0, 0], [4, 0], [4, 4], [0, 4]], np.float32),
        triangles=np.array([[0, 1, 2], [0, 2, 3]], np.uint32),
        texture=base,
        material=material,
    )
    return Model(name="floor", meshes=(mesh,), source="file")


def measure() -> dict[str, object]:
    """Measure all floors."""
    base = make_texture("base", (80, 80, 80), (200, 200, 200))
    normal_map = make_texture("normal", (100, 100, 220), (156, 156, 255))
    finish_map = make_texture("finish", (150, 100, 0), (255, 255, 1))
    materials = {
        "no maps": None,
        "normal map": Material(roughness=0.5, normal_map=normal_map),
        "normal and finish map": Material(normal_map=normal_map, finish_map=finish_map),
    }
    back = (EYE - TARGET) / np.linalg.norm(EYE - TARGET)
    right = np.cross([0.0, 0.0, 1.0], back)
    right /= np.linalg.norm(right)
    rotation = np.stack([right, np.cross(back, right), back], axis=1)
    lens = Intrinsics.from_fovy(640, 480, np.radians(50.0))
    figures: dict[str, object] = {}
    for law, water in WATERS.items():
        plain_time = 0.0
        for name, material in materials.items():
            renderer = Renderer()
            renderer.add(make_floor(base, material), 1)
            n_drawn = 0

            def draw(renderer: Renderer = renderer, water: Water = water) -> None:
                nonlocal n_drawn
                n_drawn += 1
                pose = Pose(EYE + np.array([1e-9 * n_drawn, 0.0, 0.0]), rotation)
                renderer.draw(pose, lens, water, Light(), targets={"colour"})

            target = MAX_RATIO * plain_time if plain_time else None
            row = milliseconds(draw, target=target, calls=10)
            plain_time = plain_time or float(str(row["cpu_ms"]))
            figures[f"640x480 {law}, floor, {name}"] = row
            renderer.close()
    return figures


if __name__ == "__main__":
    main(measure)
