"""NetCDF charts (``.nc``, ``.grd``): a variable of heights over latitude and longitude, or y and x.

This is the layout of GEBCO: ``elevation(lat, lon)``. Classic NetCDF is read by SciPy, NetCDF-4 by
h5py (the extra ``charts``). The variable is one of `NAMES`, or the only one over two regular axes.
A variable called depth, or with the attribute ``positive`` ``down``, has depths. Projected axes
(y, x) have the grid mapping of CF: its ``crs_wkt``, or the orthographic projection.
"""

from __future__ import annotations

import io
import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from ..base.geodesy import Geodetic
from ..base.geometry import Array
from ..errors import AssetError, MissingExtra, UwsimError
from .chart import Chart
from .coordinates import LOCAL_SYSTEM, WGS84, CoordinateSystem, orthographic, parse_system, wkt_of
from .height_grid import Heights, check_size

NAMES = ("elevation", "z", "height", "topo", "bathymetry", "band1", "depth")
"""The names of the variable of heights, in lower case; the first of them is read."""
REGULARITY = 0.01
"""The greatest deviation of a coordinate from a regular axis, as a fraction of its step [1]."""
_LATITUDES, _LONGITUDES = ("lat", "latitude"), ("lon", "longitude")


@dataclass(frozen=True, eq=False)
class Variable:
    """A variable of a file."""

    dimensions: tuple[str, ...]
    """The names of its dimensions."""
    values: Any
    """The values, which are read when they are indexed."""
    attributes: Mapping[str, Any] = field(default_factory=dict)
    """The attributes; texts as ``str``."""


def read(path: Path, data: bytes) -> Chart:
    """Read a chart from the bytes of a NetCDF file; raise AssetError."""
    is_netcdf4 = data[:4] == b"\x89HDF"
    try:
        return (_read_netcdf4 if is_netcdf4 else _read_classic)(path, data)
    except UwsimError:
        raise
    except (TypeError, ValueError, IndexError, KeyError, OSError, RuntimeError) as error:
        raise AssetError(f"{path}: is not a NetCDF file that can be read ({error}).") from error


def _read_classic(path: Path, data: bytes) -> Chart:
    from scipy.io import netcdf_file

    file: Any = netcdf_file(io.BytesIO(data), mmap=False)
    with file as dataset:
        variables = {
            name: Variable(
                variable.dimensions,
                variable.data,
                {key: _plain_value(value) for key, value in variable._attributes.items()},
            )
            for name, variable in dataset.variables.items()
        }
        return _read_variables(path, variables)


def _read_netcdf4(path: Path, data: bytes) -> Chart:
    try:
        import h5py
    except ImportError as error:
        raise MissingExtra(
            f"{path}: NetCDF-4 needs h5py: pip install 'uwsim[charts]'. "
            "`nccopy -k classic` converts the file."
        ) from error
    with h5py.File(io.BytesIO(data), "r") as file:
        variables = {}
        for name, dataset in file.items():
            if not isinstance(dataset, h5py.Dataset) or dataset.dtype.kind not in "fiu":
                continue
            names = [scales[0].name.lstrip("/") if len(scales) else "" for scales in dataset.dims]
            dimensions = tuple(names) if dataset.ndim != 1 or names[0] else (name,)
            internal_names = ("DIMENSION_LIST", "REFERENCE_LIST", "CLASS", "NAME")
            attributes = {
                k: _plain_value(v) for k, v in dataset.attrs.items() if k not in internal_names
            }
            variables[name] = Variable(dimensions, dataset, attributes)
        return _read_variables(path, variables)


def _plain_value(value: Any) -> Any:
    """Return an attribute as a text or a number."""
    if isinstance(value, bytes):
        return value.decode("utf-8", errors="replace")
    array = np.asarray(value)
    return array.ravel()[0].item() if array.size == 1 else value


def _read_variables(path: Path, variables: Mapping[str, Variable]) -> Chart:
    name = _find_heights(path, variables)
    variable = variables[name]
    rows, columns = variable.values.shape
    check_size(rows, columns, str(path))
    axes = [variables[dimension] for dimension in variable.dimensions]
    is_transposed = variable.dimensions[0].lower() in (*_LONGITUDES, "x")
    heights = _read_heights(variable, name)
    if is_transposed:
        heights, axes = heights.T, axes[::-1]
    (y, step_y, flips_rows), (x, step_x, flips_columns) = (
        _regular_axis(path, dimension, axis)
        for dimension, axis in zip(
            variable.dimensions[::-1] if is_transposed else variable.dimensions, axes, strict=True
        )
    )
    heights = heights[::-1] if flips_rows else heights
    heights = heights[:, ::-1] if flips_columns else heights
    return Chart(
        x=x, y=y, step_x=step_x, step_y=step_y, heights=np.ascontiguousarray(heights),
        system=_system(variables, variable),
    )  # fmt: skip


def _find_heights(path: Path, variables: Mapping[str, Variable]) -> str:
    """Return the name of the variable of heights."""
    surfaces = {
        name.lower(): name
        for name, variable in variables.items()
        if len(variable.dimensions) == 2 and all(d in variables for d in variable.dimensions)
    }
    for name in NAMES:
        if name in surfaces:
            return surfaces[name]
    if len(surfaces) == 1:
        return next(iter(surfaces.values()))
    raise AssetError(
        f"{path}: has the variables {', '.join(variables)[:200] or 'none'}; expected one over "
        f"latitude and longitude (or y and x), called {', '.join(NAMES)}."
    )


def _read_heights(variable: Variable, name: str) -> Heights:
    """Return heights, z up, with NaN where there is none."""
    stored_values = np.asarray(variable.values[...])
    attributes = variable.attributes
    heights = stored_values.astype(np.float32)
    for key in ("_FillValue", "missing_value"):
        if key in attributes:
            heights[stored_values == attributes[key]] = np.nan
    if "scale_factor" in attributes or "add_offset" in attributes:
        scale, offset = attributes.get("scale_factor", 1.0), attributes.get("add_offset", 0.0)
        heights = (heights * np.float64(scale) + np.float64(offset)).astype(np.float32)
    is_depth = "positive" not in attributes and name.lower() == "depth"
    return -heights if is_depth or attributes.get("positive") == "down" else heights


def _regular_axis(path: Path, name: str, axis: Variable) -> tuple[float, float, bool]:
    """Return the least value, the step, and whether the values decrease."""
    values: Array = np.asarray(axis.values[...], np.float64).ravel()
    if len(values) < 2 or not np.isfinite(values).all():
        raise AssetError(f"{path}: {name} has {len(values)} values; expected 2 or more, finite.")
    step = float(values[-1] - values[0]) / (len(values) - 1)
    expected = values[0] + step * np.arange(len(values))
    if step == 0.0 or np.abs(values - expected).max() > REGULARITY * abs(step):
        raise AssetError(f"{path}: the steps of {name} differ; expected a regular axis.")
    return float(min(values[0], values[-1])), abs(step), step < 0.0


def _system(variables: Mapping[str, Variable], variable: Variable) -> CoordinateSystem:
    if any(name.lower() in _LATITUDES for name in variable.dimensions):
        return parse_system(WGS84)
    mapping = variables.get(str(variable.attributes.get("grid_mapping", "")))
    if mapping is None:
        return LOCAL_SYSTEM
    attributes = mapping.attributes
    if attributes.get("grid_mapping_name") == "orthographic":
        latitude, longitude = (
            float(attributes.get(f"{name}_of_projection_origin", 0.0))
            for name in ("latitude", "longitude")
        )
        return orthographic(
            Geodetic(latitude=math.radians(latitude), longitude=math.radians(longitude))
        )
    return parse_system(str(attributes.get("crs_wkt", attributes.get("spatial_ref", ""))))


def write(path: Path, chart: Chart) -> None:
    """Write a chart as classic NetCDF with the conventions of CF."""
    from scipy.io import netcdf_file

    is_geographic = chart.system.kind == "geographic"
    names = ("lat", "lon") if is_geographic else ("y", "x")
    units = ("degrees_north", "degrees_east") if is_geographic else ("m", "m")
    file: Any = netcdf_file(path, "w", version=2)
    with file as dataset:
        dataset.Conventions = "CF-1.8"
        for name, unit, values in zip(names, units, (chart.rows(), chart.columns()), strict=True):
            dataset.createDimension(name, len(values))
            axis = dataset.createVariable(name, "f8", (name,))
            axis[:], axis.units = values, unit
        variable = dataset.createVariable("elevation", "f4", names)
        variable[:] = chart.heights
        variable.units, variable.positive, variable.long_name = "m", "up", "height of the sea floor"
        variable._FillValue = np.float32(np.nan)
        if chart.system.kind in ("orthographic", "other"):
            variable.grid_mapping = "crs"
            mapping = dataset.createVariable("crs", "i4", ())
            mapping.data[...] = 0
            if chart.system.centre is not None:
                mapping.grid_mapping_name = "orthographic"
                latitude, longitude = (
                    np.float64(math.degrees(angle))  # SciPy writes a float with 32 bits
                    for angle in (chart.system.centre.latitude, chart.system.centre.longitude)
                )
                mapping.latitude_of_projection_origin = latitude
                mapping.longitude_of_projection_origin = longitude
            else:
                mapping.crs_wkt = wkt_of(chart.system)
