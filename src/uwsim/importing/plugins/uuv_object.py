r"""UUV Simulator's plug-in of underwater objects: Fossen's model of each link, and its buoyancy.

.. code-block:: xml

    <plugin name="uuv_plugin" filename="libuuv_underwater_object_ros_plugin.so">
      <fluid_density>1028</fluid_density>
      <link name="rexrov/base_link">
        <volume>1.83826</volume> <center_of_buoyancy>0 0 0.3</center_of_buoyancy>
        <hydrodynamic_model> <type>fossen</type>
          <added_mass>...</added_mass> <linear_damping>...</linear_damping>
          <quadratic_damping>...</quadratic_damping>
        </hydrodynamic_model>
      </link>
    </plugin>

Matrices are in axes with y to starboard and z down (``ToNED`` of HydrodynamicModel), so that with
the axes of the link, y to port and z up, :math:`M = S M_f S`, S = diag(1, -1, -1, 1, -1, -1).
Damping is negative in these files; the sign of a positive one is turned, as the plug-in does not
propel. Not imported: models other than ``fossen``, damping by the forward speed.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from lxml import etree

from ...base.geometry import Array
from ..sdf.flat_model import FlatPlugin
from ..sdf.values import (
    Source,
    attribute_of,
    child_of,
    children_of,
    flag_of,
    number_of,
    numbers_in,
    text_of,
    triple_of,
)
from .coefficients import BodyCoefficients, positive_damping
from .context import PluginContext, check

DEFAULT_DENSITY = 1028.0
"""The density of the plug-in without ``<fluid_density>`` [kg/m3]."""
SIGNS = np.array([1.0, -1.0, -1.0, 1.0, -1.0, -1.0])
"""The diagonal of S."""


def read_uuv_object(plugin: FlatPlugin, context: PluginContext) -> Iterator[BodyCoefficients]:
    """Yield the coefficients of each link of the plug-in."""
    node, source = plugin.plugin.node, context.source(plugin)
    density = number_of(node, DEFAULT_DENSITY, source, "fluid_density")
    for child in children_of(node, "link"):
        path = context.find_link(attribute_of(child, "name"), plugin)
        if path is not None:
            mass = context.robot.links[path].link.inertial.mass
            coefficients = _read_link(child, path, plugin, source, density, mass)
            check(source)
            yield coefficients
    check(source)


def _read_link(
    node: etree._Element,
    path: str,
    plugin: FlatPlugin,
    source: Source,
    density: float,
    mass: float,
) -> BodyCoefficients:
    notes: list[str] = []
    model = child_of(node, "hydrodynamic_model")
    kind = text_of(model, "type").lower()
    if kind and kind != "fossen":
        notes.append(
            f"the model {kind!r} is not imported, only 'fossen': no added_mass mass, no damping"
        )
        model = None
    added_mass = _matrix(model, "added_mass", source)
    if np.trace(added_mass) < 0.0:
        added_mass = -added_mass
    if np.abs(added_mass - added_mass.T).max() > 1e-9 * max(np.abs(added_mass).max(), 1.0):
        notes.append("the added_mass mass is not symmetric; its symmetric part is used")
    if _matrix(model, "linear_damping_forward_speed", source).any():
        notes.append("<linear_damping_forward_speed> has no counterpart")
    box = child_of(node, "box")
    edges = tuple(number_of(box, 0.0, source, name) for name in ("length", "width", "height"))
    volume: float | None = None
    if flag_of(node, False, "neutrally_buoyant"):
        volume = mass / density
    elif child_of(node, "volume") is not None:
        volume = number_of(node, 0.0, source, "volume")
    linear = -_matrix(model, "linear_damping", source)
    quadratic = -_matrix(model, "quadratic_damping", source)
    return BodyCoefficients(
        path=path,
        plugin=plugin,
        added_mass=0.5 * (added_mass + added_mass.T),
        linear_damping=positive_damping(linear, "linear damping", notes),
        quadratic_damping=positive_damping(quadratic, "quadratic damping", notes),
        notes=notes,
        volume=volume,
        centre_of_buoyancy=triple_of(node, (0.0, 0.0, 0.0), source, "center_of_buoyancy"),
        box=(edges[0], edges[1], edges[2]) if min(edges) > 0.0 else None,
        density=density,
    )


def _matrix(node: etree._Element | None, name: str, source: Source) -> Array:
    """Return a matrix of 6 or 36 numbers in the axes of the link, (6, 6)."""
    child = child_of(node, name)
    if child is None:
        return np.zeros((6, 6))
    count = 6 if len((child.text or "").split()) == 6 else 36
    values = numbers_in(child, count, source) or (0.0,) * count
    matrix = np.diag(values) if count == 6 else np.array(values).reshape(6, 6)
    result: Array = SIGNS[:, None] * matrix * SIGNS
    return result
