r"""Gazebo's plug-in LiftDrag: the fins of a vehicle.

With the angle of attack :math:`\alpha`, the coefficients are :math:`C_L = c_{la} \alpha` and
:math:`C_D = c_{da} |\alpha|` up to the stall; beyond it they have the slopes ``cla_stall`` and
``cda_stall``, and :math:`C_L` does not change its sign (LiftDrag.hh of gz-sim). They become the
table of coefficients of a fixed fin of the link, which the joint of the link turns.

Not imported: a foil with an angle of zero lift (``a0``), the moment ``cma``, ``radial_symmetry``.
"""

from __future__ import annotations

import math

import numpy as np

from ...base.geometry import Pose
from ...base.numerics.linear import cross, length
from ...scene.hydrodynamics.spec import MAX_FIN_AREA, FinSpec
from ..robot import NameTable
from ..sdf.flat_model import FlatPlugin
from ..sdf.values import Source, flag_of, number_of, text_of, triple_of
from .context import PluginContext, check
from .thrusters import triple

LIFT_DRAG = "lift-drag"


def read_fins(context: PluginContext) -> list[FinSpec]:
    """Return the fins of a model."""
    names, fins = NameTable(), []
    for plugin in context.model.plugins:
        if plugin.plugin.kind not in (LIFT_DRAG, "liftdragplugin"):
            continue
        source = context.source(plugin)
        fin = _read_fin(plugin, source, context, names)
        check(source)
        if fin is not None:
            fins.append(fin)
    return fins


def _read_fin(
    plugin: FlatPlugin, source: Source, context: PluginContext, names: NameTable
) -> FinSpec | None:
    node = plugin.plugin.node
    path = context.find_link(text_of(node, "link_name"), plugin)
    if path is None:
        return None
    area = number_of(node, 1.0, source, "area")
    if not 0.0 < area <= MAX_FIN_AREA:
        context.add("left out", plugin, f"its area is {area:g} m2")
        return None
    if number_of(node, 0.0, source, "a0") or flag_of(node, False, "radial_symmetry"):
        context.add("left out", plugin, "only symmetric foils are imported (a0 0, no "
                    "radial_symmetry)")  # fmt: skip
        return None
    forward = np.array(triple_of(node, (1.0, 0.0, 0.0), source, "forward"))
    upward = np.array(triple_of(node, (0.0, 0.0, 1.0), source, "upward"))
    span = cross(forward, upward)
    if not length(span) > 1e-6:
        context.add("left out", plugin, "its <forward> and <upward> are parallel")
        return None
    pressure_centre = triple_of(node, (0.0, 0.0, 0.0), source, "cp")
    position = context.robot.frame_from_part(path, Pose(np.array(pressure_centre), np.eye(3)))
    name = names.add(f"{path}_fin")
    context.add("imported", plugin, f"fin {name} with a table of coefficients; the density is "
                "that of the water")  # fmt: skip
    return FinSpec(
        name=name,
        link=context.robot.links[path].name,
        position=triple(position.position),
        axis=triple(span / length(span)),
        chord=triple(forward / length(forward)),
        area=area,
        coefficients=_table(plugin, source),
        limits=(0.0, 0.0),
    )


def _table(plugin: FlatPlugin, source: Source) -> tuple[float, ...]:
    """Return rows of angle, lift and drag, for angles from 0 to 90 degrees."""
    node = plugin.plugin.node
    stall = min(max(number_of(node, 0.5 * math.pi, source, "alpha_stall"), 1e-3), 0.5 * math.pi)
    lift = number_of(node, 1.0, source, "cla") * stall
    drag = abs(number_of(node, 0.01, source, "cda")) * stall
    lift_slope = number_of(node, 0.0, source, "cla_stall")
    drag_slope = number_of(node, 1.0, source, "cda_stall")
    rows = [(0.0, 0.0, 0.0), (stall, lift, drag)]
    angles = [0.5 * math.pi]
    if lift * lift_slope < 0.0:
        angles.insert(0, stall - lift / lift_slope)
    for angle in angles:
        if rows[-1][0] + 1e-6 < angle <= 0.5 * math.pi:
            excess = angle - stall
            change = lift + lift_slope * excess
            rows.append(
                (
                    angle,
                    change if change * lift > 0.0 else 0.0,
                    max(drag + drag_slope * excess, 0.0),
                )
            )
    return tuple(round(value, 9) for row in rows for value in row)
