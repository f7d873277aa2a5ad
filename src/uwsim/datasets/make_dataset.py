"""The making of a data set: from a request to its files."""

from __future__ import annotations

import json
import re
import shutil
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from ..assets.bundled import benchmark_file, bundled_files, scene_file
from ..benchmark.reader import read_benchmark
from ..benchmark.spec import BenchmarkSpec
from ..errors import AssetNotFound, BadSetting, ErrorCollector
from ..model.scene_model import SceneModel
from ..physics.compile_scene import compile_scene
from ..results.atomic_file import write_text
from ..results.directory import lock_directory
from ..runs.foreign_code import announce_code, refuse_code
from ..scene.reader import read_scene
from ..scene.settings import apply_setting, xacro_arguments
from ..scene.spec import SceneSpec
from ..scene.variation import UniformSpec, check_variations
from ..schema import Diagnostics
from ..simulation import Simulation
from ..version import __version__
from .camera import make_camera
from .card import write_card
from .contact_sheet import write_contact_sheet
from .formats import write_formats
from .instances import find_instances
from .keypoints import KEYPOINTS_FILE, to_document
from .request import DatasetRequest
from .scene_draw import DatasetSources, find_scene_seed
from .shards import FOLDER, draw_indices, draw_numbers, image_folders, is_finished, read_records
from .sonar_images.dataset_sonar import make_sonar
from .splits import find_split
from .statistics_plot import write_statistics
from .workers import OnImage, render_all

DESCRIPTION = "dataset.json"
"""The file that describes the data set; it is written first."""
FILE_NAMES = re.compile(
    r"(dataset\.json|keypoints\.json|labels\.jsonl|README\.md|contact-sheet\.png|statistics\.png|data\.yaml|(train|val|test)\.txt"
    r"|(images|depth|instances|classes)|records|coco|kitti|labels)"
)
"""The names of the files and folders of a data set."""
BYTES_PER_PIXEL = {"png": 2.4, "jpeg": 1.1}
"""The estimated size of all files of an image over its number of pixels [bytes]."""
RECORD_BYTES = 6000.0
"""The estimated size of the labels of an image [bytes]."""
Progress = Callable[[int, int, int], AbstractContextManager[OnImage]]
"""A function of the number of images, those that were finished before, and the number of workers;
it shows the progress in a block, and yields a function to call after each image."""


@dataclass(frozen=True)
class Dataset:
    """A finished data set."""

    directory: Path
    """The directory."""
    n_images: int
    """The number of images."""
    n_rendered: int
    """The number of images that this call rendered."""
    splits: dict[str, int]
    """The number of images of each split."""
    n_instances: int
    """The number of labelled instances with visible pixels."""
    n_unlisted: int
    """The number of images of an earlier call with more of them, which are not in the labels."""


def make_dataset(request: DatasetRequest, progress: Progress | None = None) -> Dataset:
    """Make a data set, or continue one that was interrupted or had fewer images.

    Raises:
        UwsimError: a value of the request, a file, or the directory is invalid; or no camera pose
            is useful; with all errors.
    """
    request.check()
    sources = read_sources(request)
    if request.runs_code:
        announce_code(sources.scene)
    else:
        refuse_code(sources.scene)
    model = compile_scene(
        sources.scene, seed=find_scene_seed(request, sources, 0), data_path=sources.folders
    )
    with Simulation(model, is_blind=True) as simulation:  # every name is checked before the start
        table = find_instances(simulation, request.classes)
        table.with_keypoints(request.keypoints)
        table.find_targets(request.targets)
        make_camera(simulation, request)
        if request.sonar is not None:
            make_sonar(simulation, request)
        if request.fog is not None:
            simulation.set_fog(request.fog.low)
    description = {
        "uwsim": __version__,
        "request": request.identity,
        "classes": list(table.classes),
        "scene_file": Path(sources.scene.path).name,
    }
    _check_directory(request, description)
    missing_draws = [n for n in draw_numbers(request) if not is_finished(request, n)]
    n_pending = sum(len(draw_indices(request, number)) for number in missing_draws)
    _check_disk(request, n_pending)
    with lock_directory(request.out):
        for folder in (*image_folders(request), FOLDER):
            (request.out / folder).mkdir(exist_ok=True)
        write_text(request.out / DESCRIPTION, json.dumps(description, indent=1) + "\n")
        if request.keypoints:
            text = json.dumps(to_document(request.keypoints), indent=1)
            write_text(request.out / KEYPOINTS_FILE, text + "\n")
        if missing_draws:
            n_done = request.n_images - n_pending
            show = (
                nullcontext(_ignore)
                if progress is None
                else (progress(request.n_images, n_done, min(request.workers, len(missing_draws))))
            )
            with show as on_image:
                render_all(request, sources, missing_draws, on_image, model)
        return _finish(request, sources, model, table.classes, n_pending)


def _ignore() -> None:
    pass


def _finish(
    request: DatasetRequest,
    sources: DatasetSources,
    model: SceneModel,
    classes: Sequence[str],
    n_rendered: int,
) -> Dataset:
    """Write the labels in all formats, the card and the contact sheet."""
    records = [
        {**record, "split": find_split(request, record["index"], varies=sources.varies)}
        for record in read_records(request)
    ]
    write_formats(request, records, classes)
    write_contact_sheet(request.out, records, classes)
    write_statistics(request.out, records)
    write_card(request, records, classes, model)
    return Dataset(
        directory=request.out,
        n_images=len(records),
        n_rendered=n_rendered,
        splits=dict(sorted(Counter(record["split"] for record in records).items())),
        n_instances=sum(
            instance["visible_pixels"] > 0 for record in records for instance in record["instances"]
        ),
        n_unlisted=sum(
            path.stem.isdecimal() and int(path.stem) >= request.n_images
            for path in (request.out / "images").iterdir()
        ),
    )


def read_sources(request: DatasetRequest) -> DatasetSources:
    """Read the scene, or the benchmark and its scene, and apply settings and variations.

    Raises:
        UwsimError: a file or a setting is invalid; with all errors.
    """
    folders, benchmark = request.data_path, None
    path = _find_benchmark(request)
    if path is not None:
        benchmark = read_benchmark(path)
        folders = (path.parent, *folders)
    scene = _read_scene(request, benchmark, path, folders)
    errors = ErrorCollector()
    for setting, value in request.settings:
        with errors.collect():
            scene = apply_setting(scene, setting, value)
    errors.raise_errors()
    new_variations = tuple(
        UniformSpec(path=name, low=bounds.low, high=bounds.high)
        for name, bounds in request.variations
    )
    if new_variations:
        scene = replace(scene, vary=(*scene.vary, *new_variations))
        diagnostics = Diagnostics(Path(scene.path))
        check_variations(scene, diagnostics)
        messages = [diagnostic.message for diagnostic in diagnostics.to_list()]
        for message in messages:
            with errors.collect():
                raise BadSetting(f"--vary: {message}")
        errors.raise_errors()
    return DatasetSources(scene, benchmark, tuple(map(Path, folders)))


def _find_benchmark(request: DatasetRequest) -> Path | None:
    """Return the file of a benchmark; None if the request names a scene."""
    name = request.scene
    if name in bundled_files("scenes") or f"{name}.xml" in bundled_files("scenes"):
        return None
    try:
        path = benchmark_file(name, request.data_path)
    except AssetNotFound:
        return None
    return path if b"<benchmark" in path.read_bytes()[:100_000] else None


def _read_scene(
    request: DatasetRequest,
    benchmark: BenchmarkSpec | None,
    path: Path | None,
    folders: tuple[Path, ...],
) -> SceneSpec:
    name = request.scene
    if benchmark is not None:
        if benchmark.scene is None:
            raise BadSetting(f"{path}: the benchmark names no scene (u:scene); give a scene.")
        name = benchmark.scene
    arguments = xacro_arguments(request.settings)
    file = scene_file(name, folders, named_by=path)
    return read_scene(file, data_path=folders, arguments=arguments)


def _check_directory(request: DatasetRequest, description: dict[str, Any]) -> None:
    """Raise BadSetting if the directory has anything but this data set."""
    out = request.out
    if out.exists() and not out.is_dir():
        raise BadSetting(f"--out {out}: is a file, not a directory.")
    foreign_name = next(_foreign_names(out), None) if out.is_dir() else None
    if foreign_name is not None:
        raise BadSetting(f"--out {out}: has {foreign_name!r}, which is not of a data set of uwsim.")
    file = out / DESCRIPTION
    if not file.exists():
        return
    try:
        stored_description = json.loads(file.read_text(encoding="utf-8"))
        differences = _find_differences(stored_description, description)
    except (OSError, ValueError, TypeError, AttributeError, KeyError):
        raise BadSetting(f"{file}: is damaged. Choose another --out.") from None
    if differences:
        raise BadSetting(
            f"--out {out}: has a data set with other values of {', '.join(differences)}. Give the "
            "same options to continue it, or another --out."
        )


def _foreign_names(out: Path) -> Iterator[str]:
    for path in sorted(out.iterdir()):
        if not FILE_NAMES.fullmatch(path.name) and not path.name.endswith(".part"):
            yield path.name


def _find_differences(stored_description: dict[str, Any], description: dict[str, Any]) -> list[str]:
    names = sorted({*stored_description["request"], *description["request"]})
    differences = [
        name
        for name in names
        if stored_description["request"].get(name)
        != json.loads(json.dumps(description["request"].get(name)))
    ]
    names_of_make = [
        name for name in ("uwsim", "classes") if stored_description[name] != description[name]
    ]
    return [*differences, *names_of_make]


def _check_disk(request: DatasetRequest, n_missing: int) -> None:
    """Raise BadSetting if the estimated size of the missing images exceeds the free space."""
    existing_folder = next(
        p for p in (request.out.absolute(), *request.out.absolute().parents) if p.exists()
    )
    size = estimate_bytes(request, n_missing)
    free_bytes = shutil.disk_usage(existing_folder).free
    if size > free_bytes:
        raise BadSetting(
            f"--out {request.out}: {n_missing} images take about {_format_size(size)}, and "
            f"{_format_size(free_bytes)} are free. Make "
            "fewer or smaller images, or use --encoding jpeg."
        )


def _format_size(n_bytes: float) -> str:
    """Return a size in GB, or in MB below one GB."""
    return f"{n_bytes / 1e9:.1f} GB" if n_bytes >= 1e9 else f"{n_bytes / 1e6:.1f} MB"


def estimate_bytes(request: DatasetRequest, n_images: int) -> float:
    """Return the estimated size of all files of a number of images [bytes]."""
    width, height = request.size
    return n_images * (width * height * BYTES_PER_PIXEL[request.encoding] + RECORD_BYTES)
