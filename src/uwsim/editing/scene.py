"""Scenes that a program reads, changes, checks, compiles and writes: `Scene`.

.. code-block:: python

    scene = uwsim.read_scene("cirs")
    scene["girona500/bowtech1"].resw = 640
    scene.add("object", name="buoy", file="box.obj", position=(1, 0, 2))
    simulation = uwsim.load(scene)
    scene.write("my-scene.xml")
"""

from __future__ import annotations

import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..benchmark.spec import BenchmarkSpec
from ..devices.comms.comms_channels import AcousticCommsChannelSpec, CustomCommsChannelSpec
from ..errors import BadSetting, Diagnostic, SceneError
from ..forces import ForceSpec
from ..scene.object import ObjectSpec
from ..scene.ocean_state import OceanStateSpec
from ..scene.reader import read_scene as read_scene_file
from ..scene.sim_params import SimParamsSpec, ViewerCameraSpec
from ..scene.spec import NedOriginSpec, NetTracingScriptSpec, SceneSpec
from ..scene.variation import VariationSpec
from ..scene.vehicle import VehicleSpec
from ..scene.writer import write_scene
from ..topics import InterfaceSpec
from ..world import TIMESTEP
from .attributes import OptionalPart, Part, Parts
from .document import Document, check_equal, write_document
from .element import Element
from .file_names import move_file_names
from .text_diagnostics import locate_diagnostics
from .tree import (
    check_name,
    references_to,
    remove_with_references,
    rename_element,
    typed_element,
)

if TYPE_CHECKING:
    from ..model.scene_model import SceneModel

NAME = "the scene"
"""The name in messages of a scene that was not read from a file."""


class Scene(Document[SceneSpec]):
    """A scene that a program changes.

    Its attributes are the elements of a scene file: ``ocean_state``, ``vehicles``, ``objects``.
    ``scene["girona500/bowtech1"]`` is the element at a path of names.

    Args:
        spec: the first contents; None: an empty scene.
    """

    ocean_state: Part[OceanStateSpec]
    sim_params: Part[SimParamsSpec]
    camera: OptionalPart[ViewerCameraSpec]
    ned_origin: OptionalPart[NedOriginSpec]
    net_tracing_script: OptionalPart[NetTracingScriptSpec]
    custom_comms_channels: Parts[CustomCommsChannelSpec]
    acoustic_comms_channels: Parts[AcousticCommsChannelSpec]
    vehicles: Parts[VehicleSpec]
    objects: Parts[ObjectSpec]
    ros_interfaces: Parts[InterfaceSpec]
    vary: Parts[VariationSpec]
    forces: Parts[ForceSpec]
    path: str

    def __init__(self, spec: SceneSpec | None = None) -> None:
        super().__init__(SceneSpec() if spec is None else spec)

    def vehicle(self, name: str) -> Element[VehicleSpec]:
        """Return a vehicle; raise UnknownName if there is none of that name."""
        return typed_element(self, name, VehicleSpec)

    def object(self, name: str) -> Element[ObjectSpec]:
        """Return an object; raise UnknownName if there is none of that name."""
        return typed_element(self, name, ObjectSpec)

    def rename(
        self, path: str, new_name: str, *, benchmarks: Sequence[Element[BenchmarkSpec]] = ()
    ) -> None:
        """Rename the element at a path, with all references to it.

        References are the fields that name bodies, cameras, sensors and vehicles, and the paths of
        ``u:vary``. The names of topics do not change.

        Args:
            path: the path of the element.
            new_name: the new name.
            benchmarks: the benchmarks whose references change, too.
        """
        element = check_name(self, path, new_name)
        roots: list[Element[Any]] = [self, *benchmarks]
        references = [
            entry for root in roots for entry in references_to(root, path, new_name, self)
        ]
        rename_element(element, new_name, references)

    def remove(self, path: str, *, with_references: bool = False) -> None:
        """Remove the element at a path.

        Args:
            path: the path of the element.
            with_references: True to remove interfaces, variations and forces that name it, too.

        Raises:
            UnknownName: there is no such element.
            BadSetting: other elements name it; the error lists them.
        """
        remove_with_references(self, path, with_references=with_references)

    def check(self, *, data_path: Sequence[str | Path] = ()) -> tuple[Diagnostic, ...]:
        """Return the errors and warnings of ``uwsim check``, with paths instead of lines."""
        from ..checks import check_file

        text = self.to_xml()
        with tempfile.TemporaryDirectory(prefix="uwsim-") as folder:
            file = Path(folder) / "scene.xml"
            file.write_text(text, encoding="utf-8")
            diagnostics = check_file(
                file, data_path=self.folders(data_path), arguments=self.arguments
            )
            return locate_diagnostics(diagnostics, text, str(file), self.path or NAME)

    def checked_spec(self) -> SceneSpec:
        """Return the spec after the checks of a reader.

        Raises:
            SceneError: the scene is invalid; the error has every mistake in it.
        """
        text = self.to_xml()
        spec = self.spec
        with tempfile.TemporaryDirectory(prefix="uwsim-") as folder:
            file = Path(folder) / "scene.xml"
            file.write_text(text, encoding="utf-8")
            try:
                read_spec = read_scene_file(file)
            except SceneError as error:
                diagnostics = locate_diagnostics(
                    error.diagnostics, text, str(file), self.path or NAME
                )
                raise SceneError(diagnostics) from None
        check_equal(spec, read_spec)
        return spec

    def compile(
        self, *, seed: int = 0, timestep: float = TIMESTEP, data_path: Sequence[str | Path] = ()
    ) -> SceneModel:
        """Compile the scene for a seed; `uwsim.load` also opens it.

        Raises:
            UwsimError: the scene is invalid, or a file is not found.
        """
        from ..physics.compile_scene import compile_scene

        folders = tuple(Path(folder) for folder in data_path)
        return compile_scene(self.checked_spec(), seed=seed, timestep=timestep, data_path=folders)

    def to_xml(self) -> str:
        """Return the text of a scene file, without values that equal their defaults."""
        spec = self.spec
        if names := [vehicle.name for vehicle in spec.vehicles if vehicle.hydrodynamics]:
            raise BadSetting(
                f"{names[0]}: a scene file cannot state the settings of a hydrodynamics file."
            )
        return write_scene(spec)

    def write(self, path: str | Path) -> Path:
        """Write a scene file, which reads back to an equal spec, and return its path.

        The names of files are changed so that they are found from the new folder.

        Raises:
            UwsimError: the scene is invalid, or the folder does not exist.
        """
        new_path = Path(path)
        moved_scene = Scene(self.checked_spec())
        move_file_names(moved_scene, self.path, new_path)
        write_document(new_path, moved_scene.to_xml())
        return new_path

    @property
    def arguments(self) -> Mapping[str, str]:
        """The values of the xacro arguments with which the scene was read."""
        return dict(self.spec.expansion.arguments)


def read_scene(
    scene: str | Path,
    *,
    data_path: Sequence[str | Path] = (),
    arguments: Mapping[str, str | float] | None = None,
) -> Scene:
    """Read a scene that a program can change; comments of the file are not kept.

    Args:
        scene: a scene file, or a bundled name (``uwsim list scenes``).
        data_path: more folders in which files are searched.
        arguments: the values of xacro arguments by name.

    Raises:
        UwsimError: there is no such file, or it is invalid.
    """
    from ..assets.bundled import scene_file

    folders = tuple(Path(folder) for folder in data_path)
    texts = {name: str(value) for name, value in (arguments or {}).items()}
    path = scene_file(str(scene), folders)
    return Scene(read_scene_file(path, data_path=folders, arguments=texts))
