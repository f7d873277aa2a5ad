"""The meshes of an import: they are found, read and copied with their materials and images."""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from pathlib import Path

from ..assets import load_model
from ..assets.mesh import Model
from ..base.files.input_files import is_inside
from ..errors import AssetError, AssetNotFound, BadSetting
from .report import ImportReport, Place
from .robot import NameTable
from .sdf.spec import Shape

MESH_FOLDER = "meshes"
"""The folder of the meshes in the folder of the scene."""
MAX_COPIED_BYTES = 4 * 2**30
"""The greatest size of all copied files together [bytes]."""


@dataclass(frozen=True, eq=False)
class CopiedMesh:
    """A mesh in the folder of the scene."""

    file: str
    """The name by which the scene or the robot file refers to it."""
    model: Model
    """The mesh."""


@dataclass(eq=False)
class MeshFiles:
    """The meshes of an import.

    Args:
        folder: the folder of the scene.
        data_path: the folders in which meshes are searched.
        report: receives the meshes that are not found.
    """

    folder: Path
    data_path: tuple[Path, ...]
    report: ImportReport
    _meshes: dict[tuple[str, Path], CopiedMesh | None] = field(default_factory=dict, init=False)
    _copies: dict[Path, str] = field(default_factory=dict, init=False)
    _names: NameTable = field(default_factory=NameTable, init=False)
    _n_bytes: int = field(default=0, init=False)

    def copy(self, shape: Shape, label: str, place: Place) -> CopiedMesh | None:
        """Return the mesh of a shape; report it and return None if it cannot be used."""
        key = shape.uri, shape.folder.parent
        if key not in self._meshes:
            self._meshes[key] = self._load(shape, label, place)
        elif self._meshes[key] is None:
            self.report.add("left out", label, place, f"its mesh {shape.uri!r} is missing")
        mesh = self._meshes[key]
        if mesh is not None and shape.submesh:
            self.report.add(
                "changed", label, place,
                f"the whole mesh is shown, not its part {shape.submesh!r} alone",
            )  # fmt: skip
        return mesh

    def reserve(self, stem: str, suffix: str) -> str:
        """Return the name of a new file of the scene in the folder of the meshes."""
        name = f"{MESH_FOLDER}/{self._names.add(stem)}{suffix}"
        (self.folder / name).parent.mkdir(parents=True, exist_ok=True)
        return name

    def _load(self, shape: Shape, label: str, place: Place) -> CopiedMesh | None:
        try:
            model = load_model(shape.uri, named_by=shape.folder, data_path=self.data_path)
        except AssetNotFound:
            reason = f"there is no mesh {shape.uri!r}; --data-path adds a folder"
            self.report.add("left out", label, place, reason)
            return None
        except AssetError as error:
            self.report.add("left out", label, place, str(error).removesuffix("."))
            return None
        if model.source != "file":
            reason = f"there is no mesh {shape.uri!r}; --data-path adds a folder"
            self.report.add("left out", label, place, reason)
            return None
        for remark in model.remarks:
            self.report.add("changed", label, place, remark)
        return CopiedMesh(self._copy_files(model), model)

    def _copy_files(self, model: Model) -> str:
        """Copy the files of a model, and return the new name of the first."""
        paths = [file.path.resolve() for file in model.files]
        if paths[0] in self._copies:
            return self._copies[paths[0]]
        root = Path(os.path.commonpath([path.parent for path in paths]))
        stem = self._names.add(paths[0].stem)
        base = Path(MESH_FOLDER) if len(paths) == 1 else Path(MESH_FOLDER) / stem
        for index, path in enumerate(paths):
            relative_path = path.relative_to(root)
            name = f"{stem}{path.suffix}" if len(paths) == 1 else str(relative_path)
            target = self.folder / base / name
            if not is_inside(target.parent, [self.folder]):
                raise BadSetting(f"{target}: is outside {self.folder}.")
            data = path.read_bytes()
            self._n_bytes += len(data)
            if self._n_bytes > MAX_COPIED_BYTES:
                raise BadSetting(f"the meshes are larger than {MAX_COPIED_BYTES >> 30} GiB.")
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_bytes(data)
            if index == 0:
                self._copies[path] = (base / name).as_posix()
        return self._copies[paths[0]]
