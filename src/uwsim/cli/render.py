"""``uwsim render``: what a camera of a scene sees, as picture files."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import numpy as np
import typer
from PIL import Image

from ..errors import AllErrors, BadSetting
from .files import scene_file
from .options import CompatOption, DataPathOption
from .plan import compatibility_of, pairs_of

if TYPE_CHECKING:
    from ..rendering.renderer import Picture

MILLIMETRES = 1000.0
DEEPEST = 65535
"""Largest value of a 16-bit depth picture [mm]; what is farther has this value, nothing has 0."""


def render(
    scene: Annotated[str, typer.Argument(metavar="SCENE", help="A scene file, or a bundled name.")],
    camera: Annotated[str, typer.Option(help="Name of a virtual camera of the scene.")],
    out: Annotated[
        Path, typer.Option("--out", "-o", metavar="FILE.png", help="Where the picture goes.")
    ],
    depth: Annotated[
        bool,
        typer.Option(
            "--depth",
            help="Also FILE-depth.png (16 bit, millimetres, 0: nothing there) and FILE-depth.npy "
            "(float32, metres, inf: nothing there), both along the optical axis.",
        ),
    ] = False,
    segmentation: Annotated[
        bool,
        typer.Option(
            "--segmentation",
            help="Also FILE-ids.png (16 bit, 0: nothing there) and FILE-ids.csv: the name of "
            "each number in it.",
        ),
    ] = False,
    seed: Annotated[int, typer.Option(min=0, help="Seed of the camera's noise.")] = 0,
    settings: Annotated[
        list[str] | None,
        typer.Option(
            "--set",
            metavar="PATH=VALUE",
            help="Change the scene, as oceanState.fog.density=0.4; may be repeated.",
        ),
    ] = None,
    compat: CompatOption = None,
    data_path: DataPathOption = None,
) -> None:
    """Draw what a camera of a scene sees at time 0: with its noise, and through the water."""
    from ..scene.reader import read_scene
    from ..scene.settings import apply_setting
    from ..simulation import Simulation

    wrong, spec = AllErrors(), None
    folders = tuple(data_path or ())
    with wrong.kept():
        if out.suffix.lower() != ".png":
            raise BadSetting(f"-o {out}: only .png pictures are written.")
    with wrong.kept():
        spec = read_scene(scene_file(scene, folders))
    for name, value in pairs_of(settings or [], wrong):
        with wrong.kept():
            spec = None if spec is None else apply_setting(spec, name, value)
    slips = compatibility_of(compat or [], wrong)
    wrong.check()
    assert spec is not None
    simulation = Simulation(spec, seed=seed, data_path=folders, compatibility=slips)
    try:
        eye = simulation.camera(camera)
        written = [save(out, eye.shoot())]
        if depth or segmentation:
            picture = simulation.picture(eye.world_from_camera, eye.intrinsics)
            if depth:
                written += save_depth(out, picture)
            if segmentation:
                written += save_ids(out, picture, simulation.part_names)
    finally:
        simulation.close()
    print("written: " + ", ".join(str(path) for path in written))


def save(path: Path, pixels: np.ndarray) -> Path:
    """Write a picture, (h, w, 3) or (h, w); 8 or 16 bit as its array is."""
    Image.fromarray(pixels).save(path)
    return path


def save_depth(out: Path, picture: Picture) -> list[Path]:
    """Write the planar depth: millimetres for the eye, metres for programs."""
    metres = picture.depth  # (h, w) [m]
    seen = np.isfinite(metres)
    rounded = np.rint(np.where(seen, metres, 0.0) * MILLIMETRES)
    exact = beside(out, "-depth.npy")
    np.save(exact, metres)
    return [
        save(beside(out, "-depth.png"), np.minimum(rounded, DEEPEST).astype(np.uint16)),
        exact,
    ]


def save_ids(out: Path, picture: Picture, names: dict[int, str]) -> list[Path]:
    """Write which thing each pixel shows, and what the numbers mean."""
    assert picture.ids is not None
    numbers, counts = np.unique(picture.ids, return_counts=True)
    legend = beside(out, "-ids.csv")
    with legend.open("w", newline="", encoding="utf-8") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["id", "name", "pixels"])
        for number, count in zip(numbers.tolist(), counts.tolist(), strict=True):
            table.writerow([number, names.get(number, ""), count])
    return [save(beside(out, "-ids.png"), picture.ids), legend]


def beside(out: Path, ending: str) -> Path:
    """``view.png`` and ``-ids.csv`` -> ``view-ids.csv``."""
    return out.with_name(out.stem + ending)
