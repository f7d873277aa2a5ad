r"""bathymetry: an object whose file is a chart, the sea floor as heights on a grid.

.. code-block:: xml

    <object>
      <name>terrain</name>
      <file>bay.tif</file>
      <u:bathymetry>
        <u:crop>-500 -500 500 500</u:crop> <u:spacing>2</u:spacing> <u:holes>fill</u:holes>
      </u:bathymetry>
    </object>

The file is a GeoTIFF, a NetCDF file in the layout of GEBCO, an ESRI ASCII grid or a list of x, y
and z. Its coordinates are converted to the frame W: x east, y north, z up, about the
``<nedOrigin>`` of the scene (`coordinates`). The ``<position>`` of the object moves it, for example
by the height of the chart's datum above the surface of the scene.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Literal

import numpy as np

from ..base.files.input_files import read_bytes
from ..base.geodesy import Geodetic
from ..base.geometry import ZERO, Triple
from ..errors import AssetError, UwsimError
from ..schema import MAX_DISTANCE, Numbers, Spec, element
from .chart import Chart
from .chart_files import read_chart
from .coordinates import parse_system
from .grid_cache import cached_grid
from .height_grid import HeightGrid, Heights
from .resampling import resample
from .sediment import SedimentMapSpec, find_classes

MAX_HEIGHT = 12_000.0
"""The greatest height or depth [m]."""


@dataclass(frozen=True, kw_only=True)
class BathymetrySpec(Spec):
    """A ``<u:bathymetry>``: the file of the object is a chart of the sea floor."""

    crop: Numbers = element(namespaced=True, default=())
    """The limits west, south, east and north in W, about the origin of the scene [m]; without them
    the largest rectangle within the chart."""
    spacing: float | None = element(
        namespaced=True, default=None, exclusive_minimum=0.0, maximum=MAX_DISTANCE
    )
    """The distance between nodes, to which the chart is interpolated linearly [m]; without it the
    distance in the chart."""
    holes: Literal["refuse", "fill"] = element(namespaced=True, default="refuse")
    """The treatment of nodes without a height: an error, or the height of the nearest node."""
    positive: Literal["up", "down"] = element(namespaced=True, default="up")
    """The direction of the numbers in the file: heights up, or depths down."""
    coordinates: str = element(namespaced=True, default="")
    """The coordinate system of a file that does not state it, such as ``EPSG:32631``; without both,
    coordinates are metres east and north of the scene's origin."""
    sediment: SedimentMapSpec | None = element(namespaced=True, default=None)
    """The map of materials; without it the whole floor has the `<u:acousticMaterial>`, or sand."""

    def errors(self) -> Iterator[str]:
        """Yield errors of limits that are no rectangle."""
        if self.crop and len(self.crop) != 4:
            yield f"<u:crop> has {len(self.crop)} numbers; expected west, south, east and north"
        elif self.crop and not (self.crop[0] < self.crop[2] and self.crop[1] < self.crop[3]):
            yield "<u:crop> is empty; expected west below east and south below north"
        if self.sediment is not None:
            yield from self.sediment.errors()

    def read(
        self,
        path: Path,
        *,
        name: str,
        origin: Geodetic | None,
        shift: Triple = ZERO,
        sediment_path: Path | None = None,
    ) -> HeightGrid:
        """Read the height grid in W, from the cache if possible.

        Args:
            path: the file of the chart.
            name: its name in the scene.
            origin: the position on Earth of the origin of W; None: the scene has none.
            shift: the displacement of the chart in W [m].
            sediment_path: the file of the map of materials; None without one.

        Raises:
            AssetError: the file is invalid, or does not fit the scene.
        """
        key = path, name, self, origin, shift, sediment_path

        def build(data: bytes) -> HeightGrid:
            grid = self.fit(self._read_chart(path, data), str(path), origin)
            if self.sediment is not None and sediment_path is not None:
                chart, names = self._read_chart(sediment_path), self.sediment.names
                classes = find_classes(chart, str(sediment_path), grid, origin, len(names))
                grid = replace(grid, classes=classes)
            x, y, z = shift
            if not any(shift):
                return grid
            heights = grid.heights + np.float32(z)
            return replace(grid, west=grid.west + x, south=grid.south + y, heights=heights)

        try:
            return cached_grid(key, partial(_read_files, path, name, sediment_path), build)
        except OSError as error:
            raise AssetError(f"{path}: cannot be read ({error.strerror or error}).") from error

    def _read_chart(self, path: Path, data: bytes | None = None) -> Chart:
        chart = read_chart(path, data)
        if self.coordinates and chart.system.kind == "local":
            return chart.with_system(parse_system(self.coordinates))
        return chart

    def fit(self, chart: Chart, source: str, origin: Geodetic | None) -> HeightGrid:
        """Return the height grid in W of a chart; see `read`.

        Args:
            chart: the chart.
            source: its file, for errors.
            origin: the position on Earth of the origin of W; None: the scene has none.
        """
        _check_heights(chart, source)
        if self.positive == "down":
            chart = replace(chart, heights=-chart.heights)
        west, south, east, north = self.crop or (0.0,) * 4
        crop = (west, south, east, north) if self.crop else None
        grid = resample(chart, source, origin, crop, self.spacing)
        n_holes = int(np.count_nonzero(np.isnan(grid.heights)))
        if not n_holes:
            return grid
        if self.holes == "refuse" or n_holes == grid.heights.size:
            raise AssetError(_describe_holes(source, grid, n_holes))
        return replace(grid, heights=fill_holes(grid.heights))


def _read_files(path: Path, name: str, sediment_path: Path | None) -> bytes:
    """Read the files and those with their coordinate systems, so that they are recorded."""
    data = read_bytes(path, name=name)
    if sediment_path is not None:
        read_bytes(sediment_path)
    for file in (path, sediment_path):
        with suppress(OSError, UwsimError):
            if file is not None:
                read_bytes(file.with_suffix(".prj"))
    return data


def fill_holes(heights: Heights) -> Heights:
    """Return heights in which each missing one is that of the nearest node."""
    from scipy.ndimage import distance_transform_edt

    _, nearest_nodes = distance_transform_edt(np.isnan(heights), return_indices=True)
    return np.ascontiguousarray(heights[tuple(nearest_nodes)])


def _check_heights(chart: Chart, source: str) -> None:
    with np.errstate(invalid="ignore"):
        is_extreme = np.abs(chart.heights) > MAX_HEIGHT
    if is_extreme.any():
        i, j = np.unravel_index(int(np.argmax(is_extreme)), chart.shape)
        raise AssetError(
            f"{source}: the height is {chart.heights[i, j]:g} in row {i} from the south, column "
            f"{j} from the west ({int(is_extreme.sum())} such); expected -{MAX_HEIGHT:g} to "
            f"{MAX_HEIGHT:g} m. Does the file state its value for no data?"
        )


def _describe_holes(source: str, grid: HeightGrid, n_holes: int) -> str:
    i, j = np.unravel_index(int(np.argmax(np.isnan(grid.heights))), grid.shape)
    x, y = grid.west + j * grid.spacing, grid.south + i * grid.spacing
    advice = "a smaller <u:crop>" if n_holes == grid.heights.size else "<u:holes>fill</u:holes>"
    return (
        f"{source}: {n_holes} of {grid.heights.size} nodes have no height, the first at x {x:.6g}, "
        f"y {y:.6g} m of the scene; expected heights everywhere, or {advice}."
    )
