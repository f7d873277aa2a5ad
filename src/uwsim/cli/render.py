"""``uwsim render``: images of a scene's cameras, or free views of it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from ..assets.bundled import scene_file
from ..base.terminal import print_warnings
from ..errors import BadSetting, ErrorCollector
from ..runs.foreign_code import announce_code, refuse_code
from ..runs.planning.option_values import compatibility_of, pairs_of
from ..runs.stand_ins import warn_of_stand_ins
from .options.help_texts import INPUT, OUTPUT, in_group
from .options.options import DataPathOption, NoCodeOption, SceneArgument, SettingOptions
from .output.image_files import save, save_depth, save_ids
from .views import RenderedView, Wanted

if TYPE_CHECKING:
    from ..scene.spec import SceneSpec


@dataclass(frozen=True, kw_only=True)
class LookOptions:
    """From where the scene is looked at."""

    camera: Annotated[
        str | None,
        in_group(
            INPUT,
            "--camera",
            metavar="NAME",
            help="A virtual camera of the scene (uwsim info SCENE names them); need not be given "
            "where there is one.",
        ),
    ] = None
    view: Annotated[
        str | None,
        in_group(
            INPUT,
            "--view",
            metavar="orbit|top|viewer",
            help="View of the vehicles from a chosen orbit, from above, or of the file's viewer "
            "(its element camera).",
        ),
    ] = None
    eye: Annotated[
        str | None,
        in_group(INPUT, "--from", metavar="X,Y,Z", help="Look from here, in the file's frame [m]."),
    ] = None
    at: Annotated[
        str | None,
        in_group(
            INPUT, "--at", metavar="X,Y,Z", help="Look at this point, in the file's frame [m]."
        ),
    ] = None


@dataclass(frozen=True, kw_only=True)
class ImageOptions:
    """Which files are written."""

    out: Annotated[Path, in_group(OUTPUT, "--out", "-o", metavar="FILE.png", help="Image file.")]
    size: Annotated[
        str | None,
        in_group(
            OUTPUT,
            "--size",
            metavar="WxH",
            help="Of the image [px], instead of the camera's own, or of resw and resh.",
        ),
    ] = None
    depth: Annotated[
        bool,
        in_group(
            OUTPUT,
            "--depth",
            help="Also FILE-depth.png (16 bit, millimetres, 0: nothing there) and FILE-depth.npy "
            "(float32, metres, inf: nothing there), both along the optical axis.",
        ),
    ] = False
    segmentation: Annotated[
        bool,
        in_group(
            OUTPUT,
            "--segmentation",
            help="Also FILE-ids.png (16 bit, 0: nothing there) and FILE-ids.csv: the name of "
            "each number in it.",
        ),
    ] = False


def render(
    scene: SceneArgument,
    *,
    look: LookOptions,
    changes: SettingOptions,
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
    output: ImageOptions,
    no_code: NoCodeOption = False,
    data_path: DataPathOption = None,
) -> None:
    """Draw a scene at time 0: what a camera of it sees, or a view of it.

    The image of a virtual camera has its noise and the water. A view has no noise, and air above
    the water; orbit and top are drawn without fog, unless --set gives it. Without --camera, --view
    and --from the scene's only virtual camera is used; without one, the file's viewer; without
    either, an orbit view.
    """
    from ..checks import model_warnings
    from ..physics.compile_scene import compile_scene
    from ..simulation import Simulation

    wrong, wanted = ErrorCollector(), None
    folders = tuple(data_path or ())
    with wrong.collect():
        if output.out.suffix.lower() != ".png":
            raise BadSetting(f"-o {output.out}: only .png images are written.")
    spec = scene_of(scene, folders, changes.all_settings, wrong)
    with wrong.collect():
        at = (look.eye, look.at)
        wanted = Wanted.of(look.camera, look.view, *at, output.size, changes.all_settings)
    with wrong.collect():
        if spec is not None and no_code:
            refuse_code(spec)
    quirks = compatibility_of(changes.compat or [], wrong)
    wrong.raise_errors()
    assert spec is not None
    assert wanted is not None
    announce_code(spec)
    warn_of_stand_ins(spec, folders)
    model = compile_scene(spec, seed=seed, data_path=folders, compatibility=quirks)
    simulation = Simulation(model)
    try:
        print_warnings(model_warnings(model))
        rendered = wanted.render(simulation, spec)
        written = save_all(rendered, simulation.world.scenery.part_names, output)
    finally:
        simulation.close()
    print(f"{rendered.what}; written: " + ", ".join(str(path) for path in written))


def scene_of(
    scene: str, folders: tuple[Path, ...], settings: Sequence[str], wrong: ErrorCollector
) -> SceneSpec | None:
    """Read the scene and apply every ``--set``; None, and what is wrong is kept, if it fails."""
    from ..scene.reader import read_scene
    from ..scene.settings import apply_setting, xacro_arguments

    spec, pairs = None, pairs_of(settings, wrong)
    with wrong.collect():
        path = scene_file(scene, folders)
        spec = read_scene(path, data_path=folders, arguments=xacro_arguments(pairs))
    for name, value in pairs:
        with wrong.collect():
            spec = None if spec is None else apply_setting(spec, name, value)
    return spec


def save_all(rendered: RenderedView, names: dict[int, str], output: ImageOptions) -> list[Path]:
    """Write every file that is asked for."""
    written = [save(output.out, rendered.pixels)]
    if output.depth:
        written += save_depth(output.out, rendered.render_clean())
    if output.segmentation:
        written += save_ids(output.out, rendered.render_clean(), names)
    return written
