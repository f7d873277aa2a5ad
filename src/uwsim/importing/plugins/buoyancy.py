"""Gazebo's plug-in Buoyancy: the density of the water and the height of its surface."""

from __future__ import annotations

from ...schema import Diagnostics
from ..report import ImportReport
from ..sdf.spec import SdfWorld
from ..sdf.values import Source, child_of, children_of, number_of, text_of
from .coefficients import Water
from .context import check

BUOYANCY = "buoyancy"
AIR_DENSITY = 100.0
"""The density below which a layer is air [kg/m3]."""


def read_water(world: SdfWorld, report: ImportReport) -> Water:
    """Return the water of a world; of a model alone, water in which collision shapes float."""
    plugin = next((plugin for plugin in world.plugins if plugin.kind == BUOYANCY), None)
    if plugin is None:
        return Water(has_buoyancy=world.is_model)
    node = plugin.node
    source = Source(plugin.place.file, Diagnostics(plugin.place.file), report)
    water = Water()
    layered_node = child_of(node, "graded_buoyancy")
    if layered_node is None:
        water.density = number_of(node, 1000.0, source, "uniform_fluid_density")
        note = "the water has a surface; in Gazebo it is everywhere"
    else:
        water.density = number_of(layered_node, 1000.0, source, "default_density")
        layers = sorted(
            (
                number_of(layer, 0.0, source, "above_depth"),
                number_of(layer, 1.0, source, "density"),
            )
            for layer in children_of(layered_node, "density_change")
        )
        air = [height for height, density in layers if density < AIR_DENSITY]
        water.surface = air[0] if air else None
        note = "" if len(layers) == len(air) <= 1 else "layers of several liquids are not imported"
    check(source)
    water.buoyant_names = tuple(
        text for child in children_of(node, "enable") if (text := text_of(child))
    )
    report.add("changed" if note else "imported", "plugin buoyancy", plugin.place,
               f"{water.density:g} kg/m3" + (f"; {note}" if note else ""))  # fmt: skip
    return water
