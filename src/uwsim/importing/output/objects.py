"""Objects of the scene: static models, and loose bodies without joints."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from ...base.geometry import (
    UNIT_SCALE,
    ZERO,
    Array,
    Pose,
    Triple,
    rpy_from_rotation,
    xyz_from_rotation,
)
from ...base.numerics.linear import product
from ...scene.object import ObjectSpec, PhysicsSpec, ShapeType
from ..mesh_files import CopiedMesh, MeshFiles
from ..plugins.coefficients import Water
from ..plugins.thrusters import triple
from ..report import ImportReport
from ..robot import NameTable
from ..sdf.flat_model import FlatLink, FlatModel
from ..sdf.spec import Visual
from ..volumes import displacement_of
from .primitives import Part, shape_part, write_parts, write_shape

MESH_COLOUR = (0.6, 0.6, 0.6, 1.0)


@dataclass(frozen=True)
class ObjectWriter:
    """The writer of objects.

    Args:
        meshes: the meshes of the import.
        names: the names of vehicles and objects in the scene.
        report: receives what differs from the file.
    """

    meshes: MeshFiles
    names: NameTable
    report: ImportReport

    def static_objects(self, model: FlatModel, name: str) -> Iterator[ObjectSpec]:
        """Yield an object for each visible shape of a model that never moves."""
        visuals = [
            (link, visual, pose) for link in model.links.values() for visual, pose in link.visuals
        ]
        for link, visual, link_from_visual in visuals:
            pose = model.world_from_model @ link.model_from_link @ link_from_visual
            label = f"visual {link.path} {visual.name}"
            object_name = name if len(visuals) == 1 else f"{name}_{visual.name or link.path}"
            spec = self._shape_object(visual, pose, label, self.names.add(object_name))
            if spec is None:
                continue
            if link.collisions:
                yield replace(spec, physics=_fixed_physics(visual))
            else:
                yield replace(spec, is_solid=False)
        for link in model.links.values():
            self._report_link(link, has_visuals=bool(link.visuals))

    def loose_object(self, model: FlatModel, name: str, water: Water) -> ObjectSpec | None:
        """Return the object of a single link that moves; None if it has no visible shape."""
        link = next(iter(model.links.values()))
        world_from_link = model.world_from_model @ link.model_from_link
        shapes = link.visuals or link.collisions
        meshes = [(visual, pose) for visual, pose in shapes if visual.shape.kind == "mesh"]
        if len(shapes) == len(meshes) == 1:
            visual, link_from_object = meshes[0]
            pose = world_from_link @ link_from_object
            spec = self._shape_object(visual, pose, f"visual {visual.name}", name)
        else:
            link_from_object = Pose.identity()
            spec = self._merged_object(link, world_from_link, name)
        if spec is None:
            return None
        self._report_link(link, has_visuals=True)
        return replace(spec, physics=self._loose_physics(link, link_from_object, model, water))

    def _shape_object(
        self, visual: Visual, world_from_object: Pose, label: str, name: str
    ) -> ObjectSpec | None:
        """Return the object of one shape, without physics."""
        scale, offset = UNIT_SCALE, ZERO
        if visual.shape.kind == "mesh":
            mesh = self.meshes.copy(visual.shape, label, visual.place)
            if mesh is None:
                return None
            scale, offset = self._mesh_scale(visual, mesh, label)
            file = mesh.file
        else:
            file = write_shape(visual, self.meshes, name)
        return ObjectSpec(
            name=name,
            file=file,
            position=triple(world_from_object.position),
            orientation=triple(np.array(rpy_from_rotation(world_from_object.rotation))),
            scale_factor=scale,
            offsetr=offset,
        )

    def _mesh_scale(self, visual: Visual, mesh: CopiedMesh, label: str) -> tuple[Triple, Triple]:
        """Return the scale of a mesh, and the rotation that undoes that of scene files.

        Meshes of a scene file are turned from Collada's vertical axis to z, and have no unit;
        Gazebo applies the unit and leaves the axes.
        """
        x, y, z = visual.shape.scale
        if min(x, y, z) < 0.0:
            self.report.add("changed", label, visual.place, "its scale is negative: not mirrored")
        asset = mesh.model.asset
        unit = mesh.model.unit
        scale = (abs(x) * unit, abs(y) * unit, abs(z) * unit)
        if asset is None or asset.up_axis == "Z":
            return scale, ZERO
        return scale, triple(np.array(xyz_from_rotation(asset.z_up_from_file.T)))

    def _merged_object(self, link: FlatLink, world_from_link: Pose, name: str) -> ObjectSpec | None:
        """Return an object of all shapes of a link, in the frame of the link."""
        parts: list[Part] = []
        for visual, pose in link.visuals or link.collisions:
            label = f"visual {visual.name}"
            if visual.shape.kind != "mesh":
                parts.append(shape_part(visual.shape, visual.colour, pose))
                continue
            mesh = self.meshes.copy(visual.shape, label, visual.place)
            if mesh is not None:
                parts += _mesh_parts(mesh, visual, pose)
                self.report.add("changed", label, visual.place, "merged, without its images")
        if not parts:
            return None
        return ObjectSpec(
            name=name,
            file=write_parts(parts, self.meshes, name),
            position=triple(world_from_link.position),
            orientation=triple(np.array(rpy_from_rotation(world_from_link.rotation))),
        )

    def _loose_physics(
        self, link: FlatLink, link_from_object: Pose, model: FlatModel, water: Water
    ) -> PhysicsSpec:
        """Return mass, inertia and displaced volume in the frame of the object."""
        object_from_inertial = link_from_object.inverse() @ link.link_from_inertial
        xx, yy, zz, xy, xz, yz = link.inertial.inertia
        inertia = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        turn = object_from_inertial.rotation
        object_inertia = product(product(turn, inertia), turn.T)
        products = object_inertia - np.diag(np.diag(object_inertia))
        if np.abs(products).max() > 1e-6 * np.abs(object_inertia).max():
            self.report.add("changed", f"link {link.path}", link.place,
                            "the products of its inertia are left out")  # fmt: skip
        volume = 0.0
        if water.is_buoyant(model.model.name, link.path):
            volume = self._volume(link)
        return PhysicsSpec(
            mass=link.inertial.mass,
            inertia=triple(np.diag(object_inertia)),
            collision_shape_type=_shape_type(link),
            volume=volume,
            centre_of_mass=triple(object_from_inertial.position),
        )

    def _volume(self, link: FlatLink) -> float:
        shapes = []
        for collision, pose in link.collisions:
            mesh = None
            if collision.shape.kind == "mesh":
                label = f"collision {collision.name}"
                mesh = self.meshes.copy(collision.shape, label, collision.place)
            shapes.append((collision.shape, pose, mesh))
        displacement = displacement_of(shapes)
        return 0.0 if displacement is None else float(f"{displacement.volume:.9g}")

    def _report_link(self, link: FlatLink, *, has_visuals: bool) -> None:
        for sensor, _ in link.sensors:
            self.report.add("left out", f"sensor {sensor.name}", sensor.place,
                            "objects have no sensors")  # fmt: skip
        if has_visuals:
            self.report.add("imported", f"link {link.path}", link.place, "object")
        elif link.collisions:
            self.report.add("left out", f"link {link.path}", link.place,
                            "it has contacts, but nothing visible")  # fmt: skip


def _fixed_physics(visual: Visual) -> PhysicsSpec:
    if visual.shape.kind in ("box", "sphere"):
        kind: ShapeType = "box" if visual.shape.kind == "box" else "sphere"
        return PhysicsSpec(mass=0.0, collision_shape_type=kind)
    return PhysicsSpec(mass=0.0, collision_shape_type="trimesh")


def _shape_type(link: FlatLink) -> ShapeType:
    kinds = {collision.shape.kind for collision, _ in link.collisions}
    return "sphere" if kinds == {"sphere"} else "box"


def _mesh_parts(mesh: CopiedMesh, visual: Visual, pose: Pose) -> Iterator[Part]:
    """Yield the parts of a mesh in the frame of the link, with their mean colours."""
    factor: Array = np.array(visual.shape.scale) * mesh.model.unit
    for part in mesh.model.meshes:
        vertices = pose.transform(part.vertices.astype(np.float64) * factor)
        colour = (*part.colour, part.opacity) if visual.colour is None else visual.colour
        yield Part(vertices, part.triangles.astype(np.int64), colour)
