r"""Gazebo's plug-in Hydrodynamics: added mass and damping by derivatives in SNAME's notation.

The force on the link is, with the velocity :math:`v` relative to the water,

.. math:: F_i = X_{v_j} v_j + X_{v_j|v_j|} |v_j| v_j - M_{ij} \dot v_j

in the axes of the link, about its origin (Hydrodynamics.hh and .cc of gz-sim). The derivatives of
damping are negative; this simulator has the positive coefficients :math:`-X`. Files have the added
mass with both signs: as the derivative :math:`X_{\dot u} < 0`, and as the mass itself. Its absolute
value is imported, as no body has a negative added mass. ``<xUU>`` is read as ``<xUabsU>``.

Not imported: terms :math:`|v_j| v_k` of two different velocities.
"""

from __future__ import annotations

import numpy as np

from ...base.geometry import Array
from ..sdf.flat_model import FlatPlugin
from ..sdf.values import Source, flag_of, number_of, tag_of, text_of, triple_of
from .coefficients import BodyCoefficients, positive_damping
from .context import PluginContext, check

ROWS, COLUMNS = "xyzkmn", "UVWPQR"


def read_hydrodynamics(plugin: FlatPlugin, context: PluginContext) -> BodyCoefficients | None:
    """Return the coefficients of the plug-in; None if its link does not exist."""
    node, source = plugin.plugin.node, context.source(plugin)
    path = context.find_link(text_of(node, "link_name"), plugin)
    if path is None:
        return None
    added_mass, linear, quadratic = np.zeros((6, 6)), np.zeros((6, 6)), np.zeros((6, 6))
    for i, row in enumerate(ROWS):
        for j, column in enumerate(COLUMNS):
            added_mass[i, j] = number_of(node, 0.0, source, f"{row}Dot{column}")
            linear[i, j] = number_of(node, 0.0, source, f"{row}{column}")
            square = number_of(node, 0.0, source, f"{row}{column}{column}")
            quadratic[i, j] = number_of(node, square, source, f"{row}{column}abs{column}")
    check(source)
    notes: list[str] = []
    added_mass = _absolute_mass(added_mass, notes)
    if flag_of(node, False, "disable_added_mass"):
        added_mass = np.zeros((6, 6))
    if flag_of(node, False, "disable_coriolis") and added_mass.any():
        notes.append("the added mass has its Coriolis forces, which the file disables")
    linear = positive_damping(-linear, "linear damping", notes)
    quadratic = positive_damping(-quadratic, "quadratic damping", notes)
    if cross := _cross_terms(plugin, source):
        notes.append(f"{', '.join(cross[:3])}: terms of two velocities are left out")
    current = triple_of(node, (0.0, 0.0, 0.0), source, "default_current")
    return BodyCoefficients(
        path=path,
        plugin=plugin,
        added_mass=added_mass,
        linear_damping=linear,
        quadratic_damping=quadratic,
        notes=notes,
        current=current,
    )


def _absolute_mass(matrix: Array, notes: list[str]) -> Array:
    """Return the added mass, symmetric and with a positive diagonal."""
    diagonal = np.diag(matrix)
    if diagonal.sum() < 0.0:
        matrix = -matrix
        diagonal = np.diag(matrix)
    if (diagonal < 0.0).any():
        notes.append("the added mass has both signs; its absolute values are used")
        matrix = np.where(np.eye(6, dtype=bool), np.abs(matrix), matrix)
    if np.abs(matrix - matrix.T).max() > 1e-9 * max(np.abs(matrix).max(), 1.0):
        notes.append("the added mass is not symmetric; its symmetric part is used")
    result: Array = 0.5 * (matrix + matrix.T) + 0.0
    return result


def _cross_terms(plugin: FlatPlugin, source: Source) -> list[str]:
    """Return the names of elements with a product of two different velocities, which are not 0."""
    tags = []
    for child in plugin.plugin.node:
        tag = tag_of(child)
        head, _, tail = tag.partition("abs")
        is_cross = len(head) == 2 and len(tail) == 1 and head[1] != tail
        is_term = is_cross and head[0] in ROWS and tail in COLUMNS
        if is_term and number_of(plugin.plugin.node, 0.0, source, tag):
            tags.append(f"<{tag}>")
    return tags
