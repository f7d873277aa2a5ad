"""The shapes of a scene as ROS markers (``visualization_msgs/Marker``), for RViz and Foxglove."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ..assets.mesh import Mesh
from ..base.geometry import Array
from ..base.numerics.linear import product
from ..messages import ColorRGBA, Marker, MarkerArray, Point, Vector3, header
from ..model.parts import Part
from ..simulation import Simulation

SCENE_TOPIC = "scene"
"""The name of the topic with the shapes."""


def shape_markers(
    simulation: Simulation, frame_of: Callable[[Part], tuple[str, Array]]
) -> MarkerArray:
    """Return a marker for each mesh of the scene, locked to the frame of its body.

    Args:
        simulation: the simulation of the scene.
        frame_of: the function that returns the name of the frame of a part's body, and the present
            ``frame_from_world``, (4, 4).
    """
    scenery = simulation.world.scenery
    markers: list[Marker] = []
    for part in scenery.parts:
        frame, frame_from_world = frame_of(part)
        frame_from_mesh = product(frame_from_world, scenery.world_from_mesh(part))
        for mesh in part.model.meshes:
            marker = Marker(
                header=header(0.0, frame),
                ns=part.name,
                id=len(markers),
                type=Marker.TRIANGLE_LIST,
                frame_locked=True,
                scale=Vector3(x=1.0, y=1.0, z=1.0),
                color=_colour(mesh),
                points=[*_points(mesh, frame_from_mesh)],
            )
            marker.pose.orientation.w = 1.0
            markers.append(marker)
    return MarkerArray(markers=[*markers])


def _points(mesh: Mesh, frame_from_mesh: Array) -> list[Point]:
    """Return the corners of all triangles of a mesh in the marker's frame, to 0.1 mm."""
    vertices = mesh.vertices.astype(np.float64) @ frame_from_mesh[:3, :3].T + frame_from_mesh[:3, 3]
    corners = np.round(vertices, 4)[mesh.triangles.ravel()]
    return [Point(x=x, y=y, z=z) for x, y, z in corners.tolist()]


def _colour(mesh: Mesh) -> ColorRGBA:
    """Return the mesh's colour times the mean of its texture."""
    mean = np.ones(3) if mesh.texture is None else mesh.texture.pixels[..., :3].mean((0, 1)) / 255.0
    r, g, b = (np.array(mesh.colour) * mean).tolist()
    return ColorRGBA(r=r, g=g, b=b, a=mesh.opacity)
