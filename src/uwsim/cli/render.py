"""``uwsim render``: images of the cameras of a scene, or views of it from elsewhere."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from ..assets.bundled import scene_file
from ..base.exceptions import convert_to_run_failed
from ..base.terminal import print_warnings
from ..errors import BadSetting, ErrorCollector
from ..runs.foreign_code import announce_code, refuse_code
from ..runs.planning.option_values import compatibility_of, pairs_of
from ..runs.substituted_files import warn_of_substituted_files
from .options.help_texts import INPUT, OUTPUT, option
from .options.options import DataPathOption, NoCodeOption, SceneArgument, SettingOptions
from .output.image_files import save_depth, save_ids, save_image
from .simulated_time import read_duration, run_pieces
from .views import RenderedView, ViewRequest

if TYPE_CHECKING:
    from ..scene.spec import SceneSpec
    from ..simulation import Simulation


@dataclass(frozen=True, kw_only=True)
class ViewOptions:
    """The options of the viewpoint."""

    camera: Annotated[
        str | None,
        option(
            INPUT,
            "--camera",
            metavar="NAME",
            help="A virtual camera of the scene (uwsim info SCENE lists them); not needed if the "
            "scene has only one.",
        ),
    ] = None
    view: Annotated[
        str | None,
        option(
            INPUT,
            "--view",
            metavar="orbit|top|viewer",
            help="View of the vehicles from a selected orbit, from above, or of the file's viewer "
            "(its element camera).",
        ),
    ] = None
    viewpoint: Annotated[
        str | None,
        option(INPUT, "--from", metavar="X,Y,Z", help="Viewpoint, in the file's frame [m]."),
    ] = None
    target: Annotated[
        str | None,
        option(INPUT, "--at", metavar="X,Y,Z", help="Target of the view, in the file's frame [m]."),
    ] = None


@dataclass(frozen=True, kw_only=True)
class ImageOptions:
    """The options of the image files."""

    out: Annotated[Path, option(OUTPUT, "--out", "-o", metavar="FILE.png", help="Image file.")]
    size: Annotated[
        str | None,
        option(
            OUTPUT,
            "--size",
            metavar="WxH",
            help="Size of the image [px], instead of the camera's size, or of resw and resh.",
        ),
    ] = None
    depth: Annotated[
        bool,
        option(
            OUTPUT,
            "--depth",
            help="Also write FILE-depth.png (16 bit, millimetres, 0: no surface) and "
            "FILE-depth.npy (float32, metres, inf: no surface), both along the optical axis.",
        ),
    ] = False
    segmentation: Annotated[
        bool,
        option(
            OUTPUT,
            "--segmentation",
            help="Also write FILE-ids.png (16 bit, 0: no body) and FILE-ids.csv: the name of each "
            "number in it.",
        ),
    ] = False


def render(
    scene: SceneArgument,
    *,
    view_options: ViewOptions,
    changes: SettingOptions,
    seed: Annotated[
        int,
        option(
            INPUT,
            "--seed",
            metavar="N",
            min=0,
            help="Seed of the camera's noise, and of variations of the scene (u:vary).",
        ),
    ] = 0,
    output: ImageOptions,
    no_code: NoCodeOption = False,
    time: Annotated[
        str,
        option(
            INPUT,
            "--time",
            metavar="SECONDS",
            help="Simulate the scene up to this time before the image, as 20 or 2min: with its "
            "waves, currents and forces, without programs.",
        ),
    ] = "0",
    data_path: DataPathOption = None,
) -> None:
    """Draw a scene: the image of a camera in it, or a view of it.

    The image of a virtual camera has its noise and the water. A view has no noise, and air above
    the water; orbit and top are rendered without fog, unless --set sets it. Without --camera,
    --view and --from it renders the scene's only virtual camera. Without one it renders the file's
    viewer, else an orbit view.
    """
    from ..checks import model_warnings
    from ..physics.compile_scene import compile_scene
    from ..simulation import Simulation

    errors, view_request, duration = ErrorCollector(), None, 0.0
    folders = tuple(data_path or ())
    with errors.collect():
        if output.out.suffix.lower() != ".png":
            raise BadSetting(f"-o {output.out}: only .png images are written.")
    spec = load_scene(scene, folders, changes.all_settings, errors)
    with errors.collect():
        points = (view_options.viewpoint, view_options.target)
        view_request = ViewRequest.from_options(
            view_options.camera, view_options.view, *points, output.size, changes.all_settings
        )
    with errors.collect():
        duration = read_duration(time, "--time")
    with errors.collect():
        if spec is not None and no_code:
            refuse_code(spec)
    quirks = compatibility_of(changes.compat or [], errors)
    errors.raise_errors()
    assert spec is not None
    assert view_request is not None
    announce_code(spec)
    warn_of_substituted_files(spec, folders)
    model = compile_scene(spec, seed=seed, data_path=folders, compatibility=quirks)
    simulation = Simulation(model)
    try:
        print_warnings(model_warnings(model))
        if duration > 0.0:
            advance_to(simulation, duration, Path(spec.path).stem)
        rendered_view = view_request.render(simulation, spec)
        paths = save_images(rendered_view, simulation.world.scenery.part_names, output)
    finally:
        simulation.close()
    print(f"{rendered_view.title}; written: " + ", ".join(str(path) for path in paths))


def advance_to(simulation: Simulation, duration: float, title: str) -> None:
    """Simulate a scene up to a time [s], and show the progress."""
    with convert_to_run_failed():
        for _ in run_pieces(simulation, duration, title):
            pass


def load_scene(
    scene: str, folders: tuple[Path, ...], settings: Sequence[str], errors: ErrorCollector
) -> SceneSpec | None:
    """Read the scene and apply every ``--set``; after an error, collect it and return None."""
    from ..scene.reader import read_scene
    from ..scene.settings import apply_setting, xacro_arguments

    spec, pairs = None, pairs_of(settings, errors)
    with errors.collect():
        path = scene_file(scene, folders)
        spec = read_scene(path, data_path=folders, arguments=xacro_arguments(pairs))
    for name, value in pairs:
        with errors.collect():
            spec = None if spec is None else apply_setting(spec, name, value)
    return spec


def save_images(view: RenderedView, names: dict[int, str], output: ImageOptions) -> list[Path]:
    """Write all requested files."""
    paths = [save_image(output.out, view.pixels, view.record)]
    if output.depth:
        paths += save_depth(output.out, view.render_clean())
    if output.segmentation:
        paths += save_ids(output.out, view.render_clean(), names)
    return paths
