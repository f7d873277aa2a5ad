"""``uwsim render``: what a camera of a scene sees, or a view of it, as image files."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import numpy as np
from PIL import Image

from ..assets.bundled import scene_file
from ..errors import AllErrors, BadSetting
from ..runs.foreign_code import announce_code, refuse_code
from ..runs.make_plan import compatibility_of, pairs_of
from ..runs.stand_ins import warn_of_stand_ins
from ..terminal import say_notices
from .options import CompatOption, DataPathOption, NoCodeOption, SceneArgument, SetOption
from .taught import INPUT, OUTPUT, in_group
from .views import Wanted

if TYPE_CHECKING:
    from ..rendering.renderer import RenderedImage

MILLIMETRES = 1000.0
DEEPEST = 65535
"""Largest value of a 16-bit depth image [mm]; what is farther has this value, nothing has 0."""


def render(
    scene: SceneArgument,
    out: Annotated[
        Path, in_group(OUTPUT, "--out", "-o", metavar="FILE.png", help="Where the image goes.")
    ],
    camera: Annotated[
        str | None,
        in_group(
            INPUT,
            "--camera",
            metavar="NAME",
            help="A virtual camera of the scene (uwsim info SCENE names them); need not be given "
            "where there is one.",
        ),
    ] = None,
    view: Annotated[
        str | None,
        in_group(
            INPUT,
            "--view",
            metavar="orbit|top|viewer",
            help="Look at the vehicles from where they are seen best, from above, or as the file's "
            "viewer does (its element camera).",
        ),
    ] = None,
    eye: Annotated[
        str | None,
        in_group(INPUT, "--from", metavar="X,Y,Z", help="Look from here, in the file's frame [m]."),
    ] = None,
    at: Annotated[
        str | None,
        in_group(
            INPUT, "--at", metavar="X,Y,Z", help="Look at this point, in the file's frame [m]."
        ),
    ] = None,
    settings: SetOption = None,
    compat: CompatOption = None,
    seed: Annotated[
        int,
        in_group(
            INPUT,
            "--seed",
            metavar="N",
            min=0,
            help="Seed of the camera's noise, and of what varies in the scene (u:vary).",
        ),
    ] = 0,
    size: Annotated[
        str | None,
        in_group(
            OUTPUT,
            "--size",
            metavar="WxH",
            help="Of the image [px], instead of the camera's own, or of resw and resh.",
        ),
    ] = None,
    depth: Annotated[
        bool,
        in_group(
            OUTPUT,
            "--depth",
            help="Also FILE-depth.png (16 bit, millimetres, 0: nothing there) and FILE-depth.npy "
            "(float32, metres, inf: nothing there), both along the optical axis.",
        ),
    ] = False,
    segmentation: Annotated[
        bool,
        in_group(
            OUTPUT,
            "--segmentation",
            help="Also FILE-ids.png (16 bit, 0: nothing there) and FILE-ids.csv: the name of "
            "each number in it.",
        ),
    ] = False,
    no_code: NoCodeOption = False,
    data_path: DataPathOption = None,
) -> None:
    """Draw a scene at time 0: what a camera of it sees, or a view of it.

    A virtual camera sees with its noise and through the water. A view has no noise, and air above
    the water; orbit and top are drawn without fog, unless --set gives it. Without --camera, --view
    and --from the scene's one virtual camera sees; where there is none, the file's viewer; without
    either it is an orbit view.
    """
    from ..scene.reader import read_scene
    from ..scene.settings import apply_setting
    from ..simulation import Simulation

    wrong, spec, wanted = AllErrors(), None, None
    folders = tuple(data_path or ())
    with wrong.kept():
        if out.suffix.lower() != ".png":
            raise BadSetting(f"-o {out}: only .png images are written.")
    with wrong.kept():
        spec = read_scene(scene_file(scene, folders))
    for name, value in pairs_of(settings or [], wrong):
        with wrong.kept():
            spec = None if spec is None else apply_setting(spec, name, value)
    with wrong.kept():
        wanted = Wanted.of(camera, view, eye, at, size, settings or ())
    with wrong.kept():
        if spec is not None and no_code:
            refuse_code(spec)
    quirks = compatibility_of(compat or [], wrong)
    wrong.check()
    assert spec is not None
    assert wanted is not None
    announce_code(spec)
    warn_of_stand_ins(spec, folders)
    simulation = Simulation(spec, seed=seed, data_path=folders, compatibility=quirks)
    try:
        say_notices(simulation.world.warnings)
        rendered = wanted.render(simulation, spec)
        written = [save(out, rendered.pixels)]
        if depth:
            written += save_depth(out, rendered.render_clean())
        if segmentation:
            written += save_ids(out, rendered.render_clean(), simulation.world.scenery.part_names)
    finally:
        simulation.close()
    print(f"{rendered.what}; written: " + ", ".join(str(path) for path in written))


def save(path: Path, pixels: np.ndarray) -> Path:
    """Write an image, (h, w, 3) or (h, w); 8 or 16 bit as its array is."""
    Image.fromarray(pixels).save(path)
    return path


def save_depth(out: Path, image: RenderedImage) -> list[Path]:
    """Write the planar depth: millimetres for the eye, metres for programs."""
    metres = image.depth  # (h, w) [m]
    seen = np.isfinite(metres)
    rounded = np.rint(np.where(seen, metres, 0.0) * MILLIMETRES)
    exact = beside(out, "-depth.npy")
    np.save(exact, metres)
    return [
        save(beside(out, "-depth.png"), np.minimum(rounded, DEEPEST).astype(np.uint16)),
        exact,
    ]


def save_ids(out: Path, image: RenderedImage, names: dict[int, str]) -> list[Path]:
    """Write which thing each pixel shows, and what the numbers mean."""
    assert image.ids is not None
    numbers, counts = np.unique(image.ids, return_counts=True)
    legend = beside(out, "-ids.csv")
    with legend.open("w", newline="", encoding="utf-8") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["id", "name", "pixels"])
        for number, count in zip(numbers.tolist(), counts.tolist(), strict=True):
            table.writerow([number, names.get(number, ""), count])
    return [save(beside(out, "-ids.png"), image.ids), legend]


def beside(out: Path, ending: str) -> Path:
    """``view.png`` and ``-ids.csv`` -> ``view-ids.csv``."""
    return out.with_name(out.stem + ending)
