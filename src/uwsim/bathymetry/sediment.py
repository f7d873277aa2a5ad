"""sediment: the materials of a chart of the sea floor, as a map.

.. code-block:: xml

    <u:bathymetry>
      <u:sediment>
        <u:file>sediment.asc</u:file> <u:materials>sand silt rock</u:materials>
      </u:sediment>
    </u:bathymetry>

The file is a chart with a code at each node: 0 for the first material, 1 for the second. A cell has
the code of the node that is nearest to its middle, the south-western one of equally near nodes.
Its material is that of the echoes of sonars,
and sets the friction of contacts. Not modelled: layers, and the penetration of bodies.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..acoustics import MATERIALS, MaterialName
from ..base.geodesy import Geodetic
from ..errors import AssetError, did_you_mean
from ..schema import Spec, element
from .chart import Chart
from .coordinates import Projection
from .height_grid import HeightGrid

MAX_MATERIALS = 32
"""The greatest number of materials of a map."""

TIE_OFFSET = 1e-6
"""The offset that decides between two nodes at the same distance, in steps of the map [1]."""

FRICTION: dict[MaterialName, float] = {
    "clay": 0.20,
    "silt": 0.20,
    "fineSand": 0.25,
    "sand": 0.30,
    "coarseSand": 0.30,
    "gravel": 0.40,
    "cobble": 0.40,
    "rock": 0.70,
    "concrete": 0.70,
}
"""The coefficients of sliding friction of steel on a sea floor [1]: those of steel sheet piles
against silt, silty sand, clean sand and gravel, and of concrete on clean rock (NAVFAC DM 7.02,
*Foundations and earth structures*, 1986, chapter 3, table 1). That of clay is taken as that of
silt. Other materials have the friction of the engine."""


@dataclass(frozen=True, kw_only=True)
class SedimentMapSpec(Spec):
    """A ``<u:sediment>``: the map of materials of a chart."""

    file: str = element(namespaced=True)
    """The chart with the codes, in the formats and coordinates of the heights."""
    materials: str = element(namespaced=True)
    """The names of the materials of the codes 0, 1, 2 ..., separated by blanks."""

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the materials, by code."""
        return tuple(self.materials.split())

    def errors(self) -> Iterator[str]:
        """Yield errors of the names."""
        if not 1 <= len(self.names) <= MAX_MATERIALS:
            yield f"<u:materials> has {len(self.names)} names; expected 1 to {MAX_MATERIALS}"
        for name in self.names[:MAX_MATERIALS]:
            if name not in MATERIALS:
                yield (
                    f"<u:materials> has {name[:40]!r}; expected names of {', '.join(MATERIALS)}"
                    f"{did_you_mean(name, MATERIALS)}"
                )


def find_classes(
    chart: Chart, source: str, grid: HeightGrid, origin: Geodetic | None, n_materials: int
) -> npt.NDArray[np.uint8]:
    """Return the code of each cell of a grid, (rows - 1, columns - 1).

    Args:
        chart: the chart with the codes.
        source: its file, for errors.
        grid: the heights in W, before the object's position is added.
        origin: the position on Earth of the origin of W; None: the scene has none.
        n_materials: the number of materials.

    Raises:
        AssetError: a cell has no code, or one without a material.
    """
    projection = Projection(chart.system, origin, source)
    rows, columns = (n - 1 for n in grid.shape)
    x = np.asarray(grid.west + grid.spacing * (np.arange(columns) + 0.5), np.float64)
    classes = np.empty((rows, columns), np.uint8)
    for i in range(rows):
        y = grid.south + grid.spacing * (i + 0.5)
        u, v = projection.from_local(x, np.full(columns, y))
        column = np.rint((u - chart.x) / chart.step_x - TIE_OFFSET).astype(np.int64)
        row = np.rint((v - chart.y) / chart.step_y - TIE_OFFSET).astype(np.int64)
        is_inside = (column >= 0) & (column < chart.shape[1]) & (row >= 0) & (row < chart.shape[0])
        codes = np.full(columns, np.nan)
        codes[is_inside] = chart.heights[row[is_inside], column[is_inside]]
        is_valid = (codes >= 0) & (codes < n_materials) & (codes == np.floor(codes))
        if not is_valid.all():
            j = int(np.argmin(is_valid))
            raise AssetError(
                f"{source}: the code at x {x[j]:.6g}, y {y:.6g} m of the scene is {codes[j]:g}; "
                f"expected a whole number from 0 to {n_materials - 1}."
            )
        classes[i] = codes
    return classes
