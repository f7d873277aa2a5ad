"""The import of a file of VRML, X3D or OpenSceneGraph: a scene with the file as one object.

The file is copied with its images. Its nodes are not objects of their own, and its viewpoints,
lights, sensors and animations are not imported.
"""

from __future__ import annotations

from pathlib import Path

from ..base.geometry import Triple
from ..errors import AssetError
from ..scene.object import ObjectSpec, PhysicsSpec
from ..scene.ocean_state import OceanStateSpec
from ..scene.sim_params import ViewerCameraSpec
from ..scene.spec import SceneSpec
from .mesh_files import MeshFiles
from .report import ImportReport, Place
from .robot import NameTable
from .sdf.spec import Shape

GRAPH_SUFFIXES = (".wrl", ".x3d", ".x3dv", ".osg", ".osgt", ".ive")
"""The suffixes of scene graphs; those of OpenSceneGraph need the program osgconv."""
SURFACE_MARGIN = 2.0
"""The height of the surface above the highest point of the file [m]."""


def import_graph(path: Path, meshes: MeshFiles, report: ImportReport) -> SceneSpec:
    """Return a scene with a scene graph as a fixed object, and a view of all of it.

    Raises:
        AssetError: the file cannot be read.
    """
    place = Place(file=str(path), line=1)
    label = f"file {path.name}"
    shape = Shape(kind="mesh", uri=str(path.absolute()), folder=path.absolute())
    mesh = meshes.copy(shape, label, place)
    if mesh is None:
        raise AssetError(f"{path}: {report.rows[-1].reason.removeprefix(f'{path.absolute()}: ')}.")
    name = NameTable().add(path.stem)
    box = mesh.model.box
    centre: Triple = tuple(  # type: ignore[assignment]  # three numbers
        round(0.5 * (low + high), 6) for low, high in zip(box.lower, box.upper, strict=True)
    )
    size = max(high - low for low, high in zip(box.lower, box.upper, strict=True))
    x, y, z = centre
    report.add("imported", label, place,
               f"fixed object {name} of {mesh.model.n_triangles} triangles")  # fmt: skip
    return SceneSpec(
        ocean_state=OceanStateSpec(
            ocean_surface_height=max(0.0, round(box.upper[2] + SURFACE_MARGIN, 3))
        ),
        camera=ViewerCameraSpec(
            position=(x - 0.8 * size, y - 0.8 * size, z + 0.6 * size), look_at=centre
        ),
        objects=(
            ObjectSpec(
                name=name,
                file=mesh.file,
                physics=PhysicsSpec(mass=0.0, collision_shape_type="trimesh"),
            ),
        ),
    )
