"""Pictures of the bundled models: ``python -m scripts.models.pictures [FOLDER]``.

Each of the models of `SCENERY` has a thumbnail; the stand-ins for UWSim's models are on one sheet
with their names. The light is a sun of no colour and a weak lamp at the camera, in water without an
effect on images; the background is plain.
"""

from __future__ import annotations

import math
import re
import sys
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
import numpy.typing as npt
from PIL import Image, ImageDraw, ImageFont

from uwsim.assets import STAND_INS, find, load_model
from uwsim.assets.mesh import Model
from uwsim.assets.stand_ins import SCENERY, BundledModel
from uwsim.base.geometry import Array, Intrinsics, Pose
from uwsim.optics import Medium
from uwsim.rendering.lights.lamp import Lamp
from uwsim.rendering.physical.physical_water import Daylight, PhysicalWater
from uwsim.rendering.physical.view import ViewContents
from uwsim.rendering.renderer import Renderer
from uwsim.rendering.water import Light, Water
from uwsim.scene.urdf.kinematics import link_poses
from uwsim.scene.urdf.reader import read_urdf

FOLDER = Path("docs/images/models/thumbnails")
SIZE = (320, 240)
"""The size of a thumbnail [px]."""
SAMPLES = 3
"""The number of samples along a side of a pixel."""
JPEG_QUALITY = 86
BACKGROUND = ((236, 239, 242), (188, 194, 200))
"""The background at the top and at the bottom."""
FIELD_OF_VIEW = math.radians(24.0)
ROBOT = "girona500_arm5e.urdf"
ARM = "robot/ARM5E/arm5e"
"""The name of the picture of the arm alone."""
POSTURE = (0.35, 0.75, 1.3, 0.5, 0.6)
"""The angles of the robot's arm and jaw [rad]."""
Z_UP_FROM_Z_DOWN = np.diag([1.0, -1.0, -1.0])
Z_UP_FROM_Y_UP = np.array([[-1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]])
COLUMNS, CELL = 6, (200, 150)
"""The number of columns of the sheet and the size of a picture on it [px]."""
CAPTION_HEIGHT = 22
Pixels = npt.NDArray[np.uint8]


@dataclass(frozen=True)
class View:
    """The direction from which a picture shows a model."""

    azimuth: float = math.radians(-55.0)
    """The direction of the camera from the x axis towards y [rad]."""
    elevation: float = math.radians(24.0)
    """The elevation of the camera [rad]."""
    zoom: float = 1.0
    """The size of the model in the picture; 1 fills it with the bounding box."""
    rotation: tuple[tuple[float, ...], ...] = ((1, 0, 0), (0, 1, 0), (0, 0, 1))
    """The rotation of the model, with its z up afterwards."""


VIEWS = {
    "objects/cage_panel": View(azimuth=math.radians(-70.0), elevation=math.radians(8.0)),
    "objects/chain": View(azimuth=math.radians(-80.0), elevation=math.radians(12.0)),
    "objects/dock_round": View(azimuth=math.radians(-140.0), elevation=math.radians(20.0)),
    "objects/dock_square": View(azimuth=math.radians(-140.0), elevation=math.radians(20.0)),
    "objects/net": View(azimuth=math.radians(-75.0), elevation=math.radians(10.0)),
    "objects/pier": View(azimuth=math.radians(-60.0), elevation=math.radians(6.0)),
    "objects/wreck": View(azimuth=math.radians(-50.0), elevation=math.radians(20.0)),
    "robot/BLUEROV2/bluerov2_heavy": View(
        azimuth=math.radians(-40.0), rotation=tuple(map(tuple, Z_UP_FROM_Z_DOWN.tolist()))
    ),
    "robot/GIRONA500/girona500": View(
        azimuth=math.radians(-50.0), elevation=math.radians(14.0), zoom=1.0,
        rotation=tuple(map(tuple, Z_UP_FROM_Y_UP.tolist())),
    ),
    "robot/GIRONA500/g500_March11": View(
        azimuth=math.radians(-50.0), elevation=math.radians(14.0), zoom=1.0,
        rotation=tuple(map(tuple, Z_UP_FROM_Y_UP.tolist())),
    ),
    "terrain/pool/pool": View(azimuth=math.radians(-60.0), elevation=math.radians(35.0)),
    "terrain/CIRS/cirs": View(elevation=math.radians(35.0)),
    "terrain/CIRS/cirs_trident": View(elevation=math.radians(35.0)),
    ARM: View(azimuth=math.radians(-75.0), elevation=math.radians(4.0)),
    ROBOT: View(azimuth=math.radians(-38.0), elevation=math.radians(10.0)),
}  # fmt: skip
ARM_LINKS = f"{ARM}_"
"""The beginning of the names of links that only the picture of the robot shows."""

PlacedModels = list[tuple[Model, Array]]
"""Models, with the rotation and position of each as a matrix (4, 4)."""


def write_pictures(folder: Path) -> None:
    """Write all pictures into a folder."""
    folder.mkdir(parents=True, exist_ok=True)
    renderer = Renderer()
    pictures = {name: [(load_model(name), np.eye(4))] for name in SCENERY}
    pictures = {name: models for name, models in pictures.items() if not _is_arm(name)}
    pictures[ROBOT] = place_robot()
    pictures[ARM] = pictures[ROBOT][1:]
    for name, models in pictures.items():
        image = draw_models(renderer, models, VIEWS.get(name, View()), SIZE)
        _save(folder / f"{find_picture_name(name)}.jpg", image)
    _save(folder / "stand-ins.jpg", draw_sheet(renderer))
    renderer.close()


def find_picture_name(name: str) -> str:
    """Return the name of a picture without its ending: that of the model in lower case."""
    return re.sub(r"[^a-z0-9]+", "-", name.rpartition("/")[2].removesuffix(".urdf").lower())


def place_robot() -> PlacedModels:
    """Return the meshes of the robot with an arm, z up."""
    path = find(ROBOT)
    assert path is not None
    robot = read_urdf(path)
    poses = link_poses(robot, POSTURE)
    turn = Pose(np.zeros(3), Z_UP_FROM_Z_DOWN)
    return [
        (
            load_model(visual.file),
            (turn @ poses[link.name] @ Pose.from_rpy(visual.position, visual.rpy)).matrix,
        )
        for link in robot.links
        for visual in link.visuals
    ]


def draw_models(
    renderer: Renderer, models: PlacedModels, view: View, size: tuple[int, int]
) -> Pixels:
    """Draw models on a plain background, (h, w, 3)."""
    renderer.clear()
    corners = []
    turn = np.eye(4)
    turn[:3, :3] = view.rotation
    for number, (model, matrix) in enumerate(models):
        world_from_model = turn @ matrix
        renderer.place(renderer.add(model, number + 1), world_from_model)
        vertices = np.concatenate([mesh.vertices for mesh in model.meshes]).astype(float)
        corners.append(vertices @ world_from_model[:3, :3].T + world_from_model[:3, 3])
    points = np.concatenate(corners)
    pose, distance = _fit_camera(points, view, size)
    width, height = (SAMPLES * side for side in size)
    lens = Intrinsics.from_fovy(width, height, FIELD_OF_VIEW)
    lamp = Lamp(
        world_from_lamp=pose, half_angle=math.radians(30.0), casts_shadow=False,
        intensity=0.35 * distance * distance,
    )  # fmt: skip
    water = PhysicalWater(
        medium=Medium(absorption=(1e-6,) * 3, scattering=(1e-6,) * 3), exposure=1.7,
        daylight=Daylight(
            elevation=math.radians(48.0), azimuth=view.azimuth + math.radians(35.0), sky_share=0.45
        ),
        has_blur=False, has_lamp_veil=False,
    )  # fmt: skip
    surface_height = float(points[:, 2].max()) + 4.0
    image = renderer.draw(
        pose, lens, Water(surface_height=surface_height, physical_water=water), Light(),
        targets={"colour", "ids"}, contents=ViewContents(lamps=(lamp,)),
    )  # fmt: skip
    assert image.colour is not None
    assert image.ids is not None
    ramp = np.linspace(0.0, 1.0, height)[:, None, None]
    low, high = (np.array(colour, dtype=float) for colour in BACKGROUND)
    background = low + (high - low) * ramp * np.ones((1, width, 1))
    samples = np.where((image.ids > 0)[..., None], image.colour.astype(float), background)
    pixels = cv2.resize(samples.astype(np.float32), size, interpolation=cv2.INTER_AREA)
    return np.rint(pixels).astype(np.uint8)


def draw_sheet(renderer: Renderer) -> Pixels:
    """Draw all stand-ins that are models on one sheet, with their names, (h, w, 3)."""
    names = [
        name
        for name, entry in STAND_INS.items()
        if isinstance(entry, BundledModel) and not entry.scene
    ]
    cells = [_draw_cell(renderer, name) for name in names]
    cells += [np.full_like(cells[0], 255)] * (-len(cells) % COLUMNS)
    rows = [np.concatenate(cells[k : k + COLUMNS], 1) for k in range(0, len(cells), COLUMNS)]
    return np.concatenate(rows)


def _draw_cell(renderer: Renderer, name: str) -> Pixels:
    image = draw_models(renderer, [(load_model(name), np.eye(4))], VIEWS.get(name, View()), CELL)
    caption = Image.new("L", (CELL[0], CAPTION_HEIGHT), 255)
    font = ImageFont.load_default(size=12)
    ImageDraw.Draw(caption).text((5, 4), name.partition("/")[2], fill=40, font=font)
    text = np.repeat(np.asarray(caption)[..., None], 3, axis=2)
    return np.concatenate([image, text])


def _fit_camera(points: Array, view: View, size: tuple[int, int]) -> tuple[Pose, float]:
    """Return the camera that looks at all points, and its distance from their middle [m]."""
    middle = 0.5 * (points.min(axis=0) + points.max(axis=0))
    cosine = math.cos(view.elevation)
    back = np.array([cosine * math.cos(view.azimuth), cosine * math.sin(view.azimuth),
                     math.sin(view.elevation)])  # fmt: skip
    right = np.cross([0.0, 0.0, 1.0], back)
    right /= np.linalg.norm(right)
    rotation = np.stack([right, np.cross(back, right), back], axis=1)
    offsets = (points - middle) @ rotation
    for axis in (0, 1):  # the middle of the outline is the middle of the picture
        shift = 0.5 * (offsets[:, axis].min() + offsets[:, axis].max())
        middle = middle + shift * rotation[:, axis]
        offsets[:, axis] -= shift
    slope = math.tan(0.5 * FIELD_OF_VIEW) * 0.94
    reach = np.maximum(np.abs(offsets[:, 0]) * size[1] / size[0], np.abs(offsets[:, 1])) / slope
    distance = float((reach + offsets[:, 2]).max()) / view.zoom
    return Pose(middle + distance * back, rotation), distance


def _is_arm(name: str) -> bool:
    return name.startswith(ARM_LINKS)


def _save(path: Path, image: Pixels) -> None:
    Image.fromarray(image).save(path, "JPEG", quality=JPEG_QUALITY, optimize=True)
    print(f"{path.stat().st_size / 1e3:6.1f} kB  {path}")


if __name__ == "__main__":
    write_pictures(Path(sys.argv[1]) if sys.argv[1:] else FOLDER)
