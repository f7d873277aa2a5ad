"""The files of a scenario: those of the user are copied, and every file is listed with its hash."""

from __future__ import annotations

import json
from collections.abc import Iterable
from pathlib import Path, PurePosixPath
from typing import Any

from ..assets.find import PACKAGE
from ..base.files.input_files import InputFile, compute_hash, is_inside, read_bytes, record_inputs
from ..errors import BadSetting
from ..physics.compile_scene import compile_scene
from ..runs.planning.make_plan import make_plan
from ..runs.planning.plan_request import PlanRequest
from ..runs.prepare import hash_inputs
from ..scene.spec import SceneSpec
from ..simulation import Simulation
from .request import ScenarioRequest

PROVENANCE_FILE = "provenance.json"
"""The name of the file with the sources and the hashes."""
MAX_COPIED_BYTES = 2 * 2**30
"""The greatest size of all copied files [bytes]."""


def find_inputs(scene: SceneSpec, request: ScenarioRequest) -> list[InputFile]:
    """Return the files that a scene reads, except the scene file itself."""
    with record_inputs() as files:
        model = compile_scene(scene, seed=request.seed, data_path=request.folders)
        Simulation(model).close()
    scene_path = Path(scene.path).resolve()
    return [file for file in files if file.path.resolve() != scene_path]


def copy_inputs(files: Iterable[InputFile], scene: SceneSpec, folder: Path) -> None:
    """Copy the user's files among those that a scene reads; bundled ones come with uwsim.

    Raises:
        BadSetting: the files are too large.
    """
    own_files = [file for file in files if not is_inside(file.path, [PACKAGE])]
    size = sum(file.path.stat().st_size for file in own_files)
    if size > MAX_COPIED_BYTES:
        raise BadSetting(f"The scene reads files of {size / 2**30:.1f} GiB; expected at most 2.")
    scene_folder = Path(scene.path).resolve().parent
    for file in own_files:
        copy = folder / _relative_copy(file, scene_folder)
        copy.parent.mkdir(parents=True, exist_ok=True)
        copy.write_bytes(read_bytes(file.path))


def _relative_copy(file: InputFile, scene_folder: Path) -> PurePosixPath:
    path = file.path.resolve()
    if path.is_relative_to(scene_folder):
        return PurePosixPath(path.relative_to(scene_folder).as_posix())
    name = PurePosixPath(file.name)
    is_plain = not name.is_absolute() and ".." not in name.parts
    return name if is_plain else PurePosixPath(path.name)


def check_benchmark_file(path: Path, algorithm: str) -> dict[str, str]:
    """Open a benchmark of a scenario; return the hashes of the bundled files that it reads.

    Args:
        path: the benchmark file.
        algorithm: the algorithm with which it is opened.

    Raises:
        BadSetting: it reads a file that is neither in its folder nor bundled.
        UwsimError: it is invalid.
    """
    with record_inputs() as files:
        hash_inputs(make_plan(PlanRequest(benchmark=str(path), algorithm=algorithm)))
    for file in files:
        if not is_inside(file.path, [path.parent, PACKAGE]):
            raise BadSetting(
                f"The scene names {file.path.name} outside its folder; expected a name relative to "
                "the scene file."
            )
    return {
        file.path.resolve().relative_to(PACKAGE.resolve()).as_posix(): file.sha256
        for file in files
        if is_inside(file.path, [PACKAGE])
    }


def write_provenance(folder: Path, sources: dict[str, Any], bundled_files: dict[str, str]) -> None:
    """Write the sources of a scenario, and the hashes of its files and of bundled ones."""
    files = sorted(path for path in folder.rglob("*") if path.is_file())
    provenance = {
        **sources,
        "files": {path.relative_to(folder).as_posix(): compute_hash(path) for path in files},
        "bundled": dict(sorted(bundled_files.items())),
    }
    text = json.dumps(provenance, indent=2, ensure_ascii=False) + "\n"
    (folder / PROVENANCE_FILE).write_text(text, encoding="utf-8")
