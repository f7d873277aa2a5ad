"""Draw the figures of the UWSim benchmarking paper from simulations with uwsim.

    python examples/paper_figures.py FOLDER            all of them, about a minute
    python examples/paper_figures.py FOLDER --quick    few levels and points, for CI

3: the scene, with the camera image as an inset. 4: the tracker in decreasing visibility.
5-7: total, centroid and corner error over fog. 8, 9: scene and camera at fog 0 and 1.1.
10, 11: visibility over distance and over fog, measured from images of two plates.
"""

from __future__ import annotations

import argparse
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import numpy.typing as npt
from PIL import Image

from paper.figures import (
    draw_image_grid,
    draw_image_with_inset,
    draw_visibility_over_distance,
    draw_visibility_over_fog,
)
from uwsim.analysis.plots import save_plot, value_plot
from uwsim.analysis.report.overlay import overlay
from uwsim.api import load as load_scene
from uwsim.assets.find import find
from uwsim.assets.mesh import Mesh, Model
from uwsim.base.geometry import Intrinsics, Pose
from uwsim.cli import main as uwsim
from uwsim.rendering.renderer import Renderer
from uwsim.rendering.water import Light, Water
from uwsim.results.result import Result
from uwsim.results.result_file import load

SCENE, CAMERA, SEED = "visibility-scene.xml", "bowtech1", 1
EYE, TARGET = (-1.8, 3.8, -2.0), (0.1, 1.9, -3.3)  # of the viewer, in W [m]
PAPER_FOG, PAPER_DISTANCE = 1.1, 1.36  # [1/m], [m]
FOGS_OF_DISTANCE = (0.1, 0.25, 0.5, 0.75, 1.05, 2.0)  # [1/m]
DISTANCES = (0.2, 0.4, 0.6, 0.8, 1.0, 1.36, 1.7, 2.0, 2.5, 3.0, 3.5, 4.0, 5.0, 6.0)  # [m]
FOGS = tuple(0.1 * i for i in range(21))  # [1/m]
OVERLAY_FOGS = (0.0, 0.4, 0.7, 0.9, 1.1, 1.3)  # [1/m]
QUICK_FOGS = (0.0, 0.4, 1.1)  # [1/m]


def main() -> None:
    parser = argparse.ArgumentParser(description="Draw the figures of the paper.")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--quick", action="store_true", help="few levels and points, for CI")
    options = parser.parse_args()
    folder: Path = options.folder
    folder.mkdir(parents=True, exist_ok=True)
    draw_scene(folder)
    draw_visibility(folder, is_quick=options.quick)
    draw_benchmark(folder, is_quick=options.quick)


# ------------------------------------------------------------------ 3, 8, 9: the scene


def draw_scene(folder: Path) -> None:
    path = find(SCENE)
    assert path is not None
    simulation = load_scene(path, seed=SEED)
    viewer = Intrinsics.from_fovy(1320, 990, math.radians(60.0), near=0.1)
    try:
        camera = simulation.world.sensors.camera(CAMERA)
        views = {}
        for fog in (0.0, PAPER_FOG):
            simulation.set_fog(fog)
            scene_image = simulation.world.scenery.render_clean(
                camera_pose(EYE, TARGET), viewer
            ).colour
            camera_image = simulation.world.scenery.render_clean(
                camera.world_from_camera, camera.intrinsics
            ).colour
            views[fog] = scene_image[..., :3], camera_image[..., :3]
    finally:
        simulation.close()
    save_plot(draw_image_with_inset(*views[0.0]), folder / "figure-03-scene.png")
    captions = ["fog 0", f"fog {PAPER_FOG:g} m⁻¹"]
    for name, image_index in (("08-scene", 0), ("09-camera", 1)):
        grid = draw_image_grid([views[fog][image_index] for fog in views], captions, columns=2)
        save_plot(grid, folder / f"figure-{name}-clear-and-fog.png")


def camera_pose(eye: tuple[float, float, float], target: tuple[float, float, float]) -> Pose:
    """Return the pose in W of an upright camera at ``eye`` that points at ``target`` [m]."""
    back = np.subtract(eye, target) / np.linalg.norm(np.subtract(eye, target))
    right = np.cross([0.0, 0.0, 1.0], back)
    right /= np.linalg.norm(right)
    return Pose(np.array(eye), np.stack([right, np.cross(back, right), back], axis=1))


# ------------------------------------------------------------------ 10, 11: visibility


class Plates:
    """A black and a white plate, viewed along their normal, at any distance in any fog.

    V = 1 - (white(d) - black(d)) / (white(0.2 m, fog 0) - black(0.2 m, fog 0)), means of the
    central 9 x 9 pixels of 8-bit images, without noise and attenuation.
    """

    def __init__(self, *, fog_distance: str = "ray") -> None:
        self.renderer = Renderer()
        self.plates = [plate(shade) for shade in (1.0, 0.0)]
        self.intrinsics = Intrinsics.from_fovy(320, 240, math.radians(50.0))
        clear_water = Water(fog=0.0, attenuation=(0.0, 0.0, 0.0))
        self.water = replace(clear_water, fog_distance=fog_distance)
        self.reference = self.contrast(0.0, 0.2)

    def visibility(self, fog: float, distance: float) -> float:
        """Return V at a fog density [1/m] and a distance [m]."""
        return 1.0 - self.contrast(fog, distance) / self.reference

    def contrast(self, fog: float, distance: float) -> float:
        """Measure white minus black [grey level], with a vertical view from a depth of 5 m."""
        eye = Pose(np.array([0.0, 0.0, -5.0]), np.eye(3))
        plate_pose = np.eye(4)
        plate_pose[2, 3] = -5.0 - distance
        levels = []
        for model in self.plates:
            handle = self.renderer.add(model, 1)
            self.renderer.place(handle, plate_pose)
            water, light = replace(self.water, fog=fog), Light(shadows=False)
            image = self.renderer.draw(eye, self.intrinsics, water, light, targets={"colour"})
            self.renderer.remove(handle)
            levels.append(float(image.colour[116:125, 156:165, :3].mean()))
        return levels[0] - levels[1]

    def close(self) -> None:
        """Release the graphics context."""
        self.renderer.close()


def plate(shade: float) -> Model:
    """Return a square of 40 m in the plane z = 0, facing up, black (0) or white (1)."""
    corners = np.array([[-20, -20, 0], [20, -20, 0], [20, 20, 0], [-20, 20, 0]], np.float32)
    mesh = Mesh(
        vertices=corners,
        normals=np.tile(np.array([0, 0, 1], np.float32), (4, 1)),
        uvs=np.zeros((4, 2), np.float32),
        triangles=np.array([[0, 1, 2], [0, 2, 3]], np.uint32),
        colour=(shade, shade, shade),
    )
    return Model(name=f"plate {shade:g}", meshes=(mesh,), source="stand-in")


def draw_visibility(folder: Path, *, is_quick: bool) -> None:
    distances, fogs = (DISTANCES[::4], FOGS[::5]) if is_quick else (DISTANCES, FOGS)
    plates = Plates()
    over_distance = {
        fog: (distances, [plates.visibility(fog, d) for d in distances]) for fog in FOGS_OF_DISTANCE
    }
    over_fog = fogs, [plates.visibility(fog, PAPER_DISTANCE) for fog in fogs]
    plates.close()
    save_plot(
        draw_visibility_over_distance(over_distance), folder / "figure-10-visibility-distance.png"
    )
    figure = draw_visibility_over_fog(
        over_fog, distance=PAPER_DISTANCE, marked_fog=PAPER_FOG, marker_label="the paper's"
    )
    save_plot(figure, folder / "figure-11-visibility-fog.png")


# ------------------------------------------------------------------ 4, 5-7: the benchmark


def draw_benchmark(folder: Path, *, is_quick: bool) -> None:
    result = run_benchmark("esm", folder / "visibility.result", is_quick=is_quick)
    control = run_benchmark("frozen", folder / "frozen.result", is_quick=is_quick)
    fogs = [fog for fog in OVERLAY_FOGS if not is_quick or fog in QUICK_FOGS]
    images, captions = draw_overlays(result, folder / "visibility.result", fogs)
    save_plot(draw_image_grid(images, captions, columns=3), folder / "figure-04-tracking.png")
    for number, column in ((5, "total"), (6, "centroid"), (7, "corners")):
        figure = value_plot(result, column, control=control)
        save_plot(figure, folder / f"figure-{number:02}-{column}.png")


def run_benchmark(algorithm: str, out: Path, *, is_quick: bool) -> Result:
    """Run a benchmark as ``uwsim bench`` does."""
    levels = [word for fog in QUICK_FOGS for word in ("--level", f"fog={fog}")] if is_quick else []
    command = ["bench", "visibility", "--algorithm", algorithm, "--seed", str(SEED), *levels]
    status = uwsim([*command, "--out", str(out), "--overwrite"])
    if status != 0:
        raise SystemExit(status)
    return load(out)


def draw_overlays(
    result: Result, directory: Path, fogs: list[float]
) -> tuple[list[npt.NDArray[np.uint8]], list[str]]:
    """Draw the last camera images at these fogs, with truth, estimate and status."""
    images, captions = [], []
    for image in result.images:
        fog, status = result.numbers("fog")[image.row], result.values("status")[image.row]
        if fog is not None and min(abs(fog - requested_fog) for requested_fog in fogs) < 1e-9:
            pixels = np.asarray(Image.open(directory / image.file).convert("RGB"))
            quads = {"truth": image.truth, "estimate": image.estimate}
            images.append(overlay(pixels, **quads, scale=3))
            captions.append(f"fog {fog:g} m⁻¹" + ("" if status == "ok" else f", {status}"))
    return images, captions


if __name__ == "__main__":
    main()
