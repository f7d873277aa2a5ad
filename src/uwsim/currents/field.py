r"""field: a current read from a file, as velocities over x, y, z and time.

.. code-block:: xml

    <u:field> <u:file>fjord.nc</u:file> <u:start>0</u:start> <u:outside>edge</u:outside> </u:field>

A ``.csv`` file has a line of names, ``x,y,z,t,u,v,w``, and a line of numbers for every node of a
full grid, in any order. A ``.nc`` file is classic NetCDF (version 3) with coordinate variables
``x``, ``y``, ``z`` and ``t`` (or ``time``), and ``u``, ``v``, ``w`` over them. Positions are in
metres, times in seconds and velocities in m/s, all in L (the localized world frame); a NetCDF file
may state other ``units`` (`uwsim.currents.units`). ``w`` and all coordinates are optional: without
``w``, the water does not move along z; without a coordinate, the velocity does not depend on it.
"""

from __future__ import annotations

import array
import csv
import io
import itertools
import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np
import numpy.typing as npt

from ..base.files.input_files import read_bytes
from ..base.geometry import Array
from ..base.numerics.calls import address_of
from ..base.numerics.jit import njit
from ..base.numerics.memory import carray, pointer, view_doubles
from ..errors import AssetError
from ..schema import MAX_NUMBER, element, parse_number
from .compiled import CompiledCurrent
from .current import MAX_SPEED, CurrentSpec, SceneContext
from .flow_function import QUERY, FlowFunction, Record, fill
from .units import unit

Ints = npt.NDArray[np.int64]
AXES = ("t", "x", "y", "z")
COMPONENTS = ("u", "v", "w")
MAX_FILE_BYTES = {".csv": 64 * 2**20, ".nc": 256 * 2**20, ".cdf": 256 * 2**20}
"""The largest size of a file by its suffix [bytes]; reading a table needs five times the memory."""


@dataclass(frozen=True, kw_only=True)
class FieldSpec(CurrentSpec):
    """A ``<u:field>``: velocities on a grid over x, y, z and time, linear between its nodes."""

    file: str = element(namespaced=True)
    """The name of the file, ``.csv`` or ``.nc``."""
    start: float = element(namespaced=True, default=0.0)
    """The time in the file at which the simulation begins [s]. If the file counts time from a date,
    this time counts from the first time in the file."""
    outside: Literal["edge", "still"] = element(namespaced=True, default="edge")
    """The velocity outside the grid: the velocity at the nearest ``edge``, or ``still`` water.
    Before the first and after the last time, the velocity is that of the first or last time."""

    def bind(self, context: SceneContext) -> Field:
        """Read the grid from the file.

        Raises:
            AssetError: the file is unusable.
        """
        grid = read_grid(context.find(self.file), name=self.file)
        return Field(grid, start=self.start, outer_water=self.outside)

    def files(self, context: SceneContext) -> dict[str, Path]:
        """Return the path of the file, by its name in the scene."""
        return {self.file: context.find(self.file)}


@dataclass(frozen=True)
class Grid:
    """Velocities at the nodes of a rectilinear grid, whose nodes may be unevenly spaced."""

    axes: tuple[Array, Array, Array, Array]
    """The increasing values of t [s], x, y and z [m] in L; (0,) for an absent coordinate."""
    velocities: Array
    """The velocities at the nodes in L, (n_t, n_x, n_y, n_z, 3) [m/s]."""


def read_grid(path: Path, *, name: str = "") -> Grid:
    """Read a grid from a ``.csv`` or ``.nc`` file.

    Args:
        path: the path of the file.
        name: the name of the file in the scene; by default the last part of its path.

    Raises:
        AssetError: the file is unusable.
    """
    readers = {".csv": read_csv, ".nc": read_netcdf, ".cdf": read_netcdf}
    reader = readers.get(path.suffix.lower())
    if reader is None:
        raise AssetError(f"{path}: a field is a .csv or a .nc file, not {path.suffix!r}.")
    try:
        return reader(
            path, read_bytes(path, name=name, at_most=MAX_FILE_BYTES[path.suffix.lower()])
        )
    except OSError as error:
        raise AssetError(f"{path}: {error.strerror or error}.") from error
    except csv.Error as error:
        raise AssetError(f"{path}: is not a table that can be read ({error}).") from error
    except MemoryError as error:
        raise AssetError(f"{path}: is larger than the memory.") from error


def read_csv(path: Path, data: bytes) -> Grid:
    """Read a grid from the bytes of a table with one line for each node."""
    text = io.TextIOWrapper(io.BytesIO(data), "utf-8-sig", errors="replace", newline="")
    cells = array.array("d")
    with text as file:
        lines = csv.reader(file)
        names = [name.strip() for name in next(lines, [])]
        _check_names(path, names)
        for row in lines:
            if not any(cell.strip() for cell in row):
                continue
            if len(row) != len(names):
                raise AssetError(
                    f"{path}:{lines.line_num}: {len(row)} values; expected {len(names)}: "
                    f"{', '.join(names)}."
                )
            location = f"{path}:{lines.line_num}"
            cells.extend(
                _number(*cell_names, location) for cell_names in zip(names, row, strict=True)
            )
    if not cells:
        raise AssetError(f"{path}: has no line of numbers.")
    table = np.frombuffer(cells).reshape(-1, len(names))  # (n, names)
    columns = {name: table[:, i] for i, name in enumerate(names)}
    zeros = np.zeros(len(table))
    coordinates = [np.unique(columns.get(name, zeros), return_inverse=True) for name in AXES]
    axes = tuple(values for values, _ in coordinates)
    shape = tuple(len(values) for values in axes)
    node = _nodes(path, axes, tuple(index for _, index in coordinates))  # (n,)
    velocities = np.empty((*shape, 3))
    node_velocities = velocities.reshape(-1, 3)
    for i, name in enumerate(COMPONENTS):
        node_velocities[node, i] = columns.get(name, zeros)
    return Grid((axes[0], axes[1], axes[2], axes[3]), velocities)


def read_netcdf(path: Path, data: bytes) -> Grid:
    """Read a grid from the bytes of a classic NetCDF file."""
    from scipy.io import netcdf_file

    if data[:4] == b"\x89HDF":
        raise AssetError(
            f"{path}: is NetCDF-4; expected classic NetCDF. `nccopy -k classic` converts it."
        )
    try:
        with netcdf_file(io.BytesIO(data), mmap=False, maskandscale=True) as dataset:
            arrays: dict[str, tuple[tuple[str, ...], Array]] = {}
            units: dict[str, str] = {}
            for variable_name, variable in dataset.variables.items():
                if variable_name not in (*AXES, "time", *COMPONENTS):
                    continue
                name = "t" if variable_name == "time" else variable_name
                arrays[name] = (
                    tuple(
                        "t" if dimension == "time" else dimension
                        for dimension in variable.dimensions
                    ),
                    np.ma.filled(np.ma.asarray(variable[:], dtype=np.float64), np.nan),
                )
                units_text = getattr(variable, "units", b"")
                units[name] = (
                    units_text.decode("latin-1")
                    if isinstance(units_text, bytes)
                    else str(units_text)
                )
    except (TypeError, ValueError, IndexError, KeyError) as error:
        raise AssetError(f"{path}: is not a NetCDF file that can be read ({error}).") from error
    _check_names(path, list(arrays))
    _convert(path, arrays, units)
    axes = [_axis(path, name, *arrays[name]) if name in arrays else np.zeros(1) for name in AXES]
    coordinates = {name: axis for name, axis in zip(AXES, axes, strict=True) if name in arrays}
    shape = tuple(len(axis) for axis in axes)
    velocities = np.zeros((*shape, 3))
    for i, name in enumerate(COMPONENTS):
        if name in arrays:
            velocities[..., i] = _component(path, name, *arrays[name], coordinates)
    return Grid((axes[0], axes[1], axes[2], axes[3]), velocities)


def _convert(
    path: Path, arrays: dict[str, tuple[tuple[str, ...], Array]], units: Mapping[str, str]
) -> None:
    """Convert all arrays to metres, seconds and m/s, and reverse every descending axis."""
    for name, (dimensions, values) in arrays.items():
        try:
            factor, counts_from_date = unit(name, units[name])
        except ValueError as error:
            raise AssetError(f"{path}: {error}.") from error
        if counts_from_date and values.size:
            values = values - values.min()
        arrays[name] = dimensions, values * factor if factor != 1.0 else values
    descending = [
        name
        for name in AXES
        if name in arrays and arrays[name][0] == (name,) and (np.diff(arrays[name][1]) < 0.0).all()
    ]
    for name, (dimensions, values) in arrays.items():
        flip_axes = tuple(i for i, dimension in enumerate(dimensions) if dimension in descending)
        arrays[name] = dimensions, np.flip(values, flip_axes)


def _axis(path: Path, name: str, dimensions: tuple[str, ...], values: Array) -> Array:
    if dimensions != (name,):
        raise AssetError(
            f"{path}: {name} is over ({', '.join(dimensions)}); expected a coordinate over itself."
        )
    if (
        not (np.abs(values) <= MAX_NUMBER).all()
        or not (np.diff(values) > 0.0).all()
        or len(values) == 0
    ):
        raise AssetError(
            f"{path}: the values of {name} neither increase nor decrease all along, or are beyond "
            f"{MAX_NUMBER:g}."
        )
    return values


def _component(
    path: Path, name: str, dimensions: tuple[str, ...], values: Array, axes: Mapping[str, Array]
) -> Array:
    """Return a velocity component over (t, x, y, z); absent coordinates have length 1."""
    unknown_dimensions = [dimension for dimension in dimensions if dimension not in axes]
    if unknown_dimensions or len(set(dimensions)) < len(dimensions):
        raise AssetError(
            f"{path}: {name} is over ({', '.join(dimensions)}); expected coordinates of "
            f"{', '.join(AXES)}, each with a variable of its own."
        )
    if n_missing := int(np.count_nonzero(~np.isfinite(values))):
        raise AssetError(
            f"{path}: {n_missing} of {values.size} values of {name} are missing; "
            "expected a number at every node (0 on land)."
        )
    if np.abs(values).max(initial=0.0) > MAX_SPEED:
        largest_index = np.unravel_index(int(np.argmax(np.abs(values))), values.shape)
        location = ", ".join(
            f"{axis} {axes[axis][i]:g}" for axis, i in zip(dimensions, largest_index, strict=True)
        )
        raise AssetError(
            f"{path}: {name} is {values[largest_index]:g} at {location}; "
            f"expected numbers from -{MAX_SPEED:g} to {MAX_SPEED:g} [m/s]."
        )
    order = [dimensions.index(axis) for axis in AXES if axis in dimensions]
    missing_axes = [i for i, axis in enumerate(AXES) if axis not in dimensions]
    return np.expand_dims(values.transpose(order), missing_axes)


def _check_names(path: Path, names: list[str]) -> None:
    valid_names = (*AXES, *COMPONENTS)
    unknown_names = [name for name in names if name not in valid_names]
    missing_names = [name for name in ("u", "v") if name not in names]
    if unknown_names or missing_names or len(set(names)) < len(names):
        raise AssetError(
            f"{path}: has {', '.join(names) or 'nothing'}; expected u and v, optionally "
            "w, x, y, z and t, each once."
        )


def _nodes(path: Path, axes: tuple[Array, ...], indices: tuple[Ints, ...]) -> Ints:
    """Return the flat node index of each line; every node of the grid must have one line."""
    shape = tuple(len(values) for values in axes)
    n_lines, n_nodes = len(indices[0]), math.prod(shape)
    expected = f"expected a full grid of {' x '.join(map(str, shape))} nodes over {', '.join(AXES)}"
    if n_nodes > max(1000, 10 * n_lines):
        raise AssetError(f"{path}: has {n_lines} nodes; {expected}.")
    node: Ints = np.ravel_multi_index(indices, shape)
    counts = np.bincount(node, minlength=n_nodes)
    for is_invalid, problem in ((counts > 1, "occurs twice"), (counts == 0, "is missing")):
        if is_invalid.any():
            node_index = np.unravel_index(int(np.argmax(is_invalid)), shape)
            location = ", ".join(
                f"{name} {axis[i]:g}" for name, axis, i in zip(AXES, axes, node_index, strict=True)
            )
            n_invalid = np.count_nonzero(is_invalid)
            raise AssetError(
                f"{path}: the node {location} {problem} ({n_invalid} such); {expected}."
            )
    return node


def _number(name: str, cell: str, location: str) -> float:
    value = parse_number(cell.strip())
    if value is None:
        raise AssetError(f"{location}: {cell.strip()[:40]!r}; expected a number.")
    bound = MAX_SPEED if name in COMPONENTS else MAX_NUMBER
    if abs(value) > bound:
        unit = " [m/s]" if name in COMPONENTS else ""
        raise AssetError(
            f"{location}: {name} is {value:g}; expected a number from "
            f"-{bound:g} to {bound:g}{unit}."
        )
    return value


FIELD = np.dtype(
    [
        ("start", np.float64),  # time in the file when the simulation begins [s]
        ("is_still_outside", np.int64),  # 1 if the water outside the grid is still
        ("axes", np.int64, 4),  # the addresses of the values of t, x, y, z
        ("lengths", np.int64, 4),  # the number of values of t, x, y, z
        ("velocities", np.int64),  # the address of the velocities in L, (t, nodes, 3) [m/s]
        ("n_nodes", np.int64),
        ("corners", np.int64),  # the address of records of `CORNER`
        ("n_corners", np.int64),
    ]
)
"""The parameters of `flow_field`."""
CORNER = np.dtype([("is_upper", np.int64, 3), ("offset", np.int64)])
"""A corner of a grid cell: 1 along each of x, y, z where it is the upper node, and its flat node
index minus that of the cell's lowest corner."""


class Field(CompiledCurrent):
    """A current interpolated linearly along t, x, y and z between the nodes of a grid.

    Linear interpolation preserves neither divergence nor curl exactly: a velocity field without
    divergence at the nodes is free of it between them only on average. Not modelled: geographic
    coordinates, land, eddies smaller than a cell.
    """

    def __init__(self, grid: Grid, *, start: float = 0.0, outer_water: str = "edge") -> None:
        n_x, n_y, n_z = grid.velocities.shape[1:4]
        axes = [np.ascontiguousarray(axis, dtype=np.float64) for axis in grid.axes]
        velocities = np.ascontiguousarray(grid.velocities, dtype=np.float64)
        has_cells = [n > 1 for n in (n_x, n_y, n_z)]
        cell_corners = [
            corner
            for corner in itertools.product((0, 1), repeat=3)
            if _has_corner(corner, has_cells)
        ]
        corners = np.zeros(len(cell_corners), CORNER)
        corners["is_upper"] = cell_corners
        corners["offset"] = (corners["is_upper"] * (n_y * n_z, n_z, 1)).sum(axis=1)
        row = np.zeros(1, FIELD)
        row["start"], row["is_still_outside"] = start, outer_water == "still"
        row["axes"], row["lengths"] = [address_of(axis) for axis in axes], grid.velocities.shape[:4]
        row["velocities"], row["n_nodes"] = address_of(velocities), n_x * n_y * n_z
        row["corners"], row["n_corners"] = address_of(corners), len(corners)
        self._flow = FlowFunction(
            function=flow_field, parameters=row, memory_owners=(axes, velocities, corners)
        )


def _has_corner(corner: tuple[int, ...], has_cells: list[bool]) -> bool:
    """Return whether a corner exists; an axis with a single node has only the lower corner."""
    return all(has_cell or node == 0 for node, has_cell in zip(corner, has_cells, strict=True))


@njit
def axis_of(current: Record, k: int) -> Array:
    """Return the values of coordinate k of t, x, y, z."""
    return view_doubles(current.axes[k], current.lengths[k])


@njit
def time_interval(current: Record, time: float) -> tuple[int, float, float]:
    """Locate a simulation time [s] between the times of a field.

    Returns:
        The index of the preceding time, the fraction of the interval that has passed [1], and the
        length of the interval [s]; both are 0 outside the times of the field.
    """
    times, now = axis_of(current, 0), current.start + time
    last_index = len(times) - 1
    if now < times[0] or last_index == 0:
        return 0, 0.0, 0.0
    if now >= times[last_index]:
        return last_index, 0.0, 0.0
    i = np.searchsorted(times, now, side="right") - 1
    span = times[i + 1] - times[i]
    return i, (now - times[i]) / span, span


@njit
def find_cell(current: Record, point: Array, shares: Array) -> tuple[int, bool]:
    """Find the grid cell of a point.

    Args:
        current: a record of `FIELD`.
        point: the point in L, (3,) [m].
        shares: receives the weights of the lower and the upper node along x, y, z, (3, 2).

    Returns:
        The flat index of the cell's lowest node, and whether the point is inside the grid.
    """
    node, is_inside = 0, True
    for k in range(3):
        axis = axis_of(current, 1 + k)
        n = len(axis)
        node *= n
        shares[k, 0], shares[k, 1] = 1.0, 0.0
        if n > 1:
            i = np.searchsorted(axis[1:-1], point[k], side="right")
            upper = (point[k] - axis[i]) / (axis[i + 1] - axis[i])
            is_inside = is_inside and 0.0 <= upper <= 1.0
            shares[k, 1] = min(max(upper, 0.0), 1.0)
            shares[k, 0] = 1.0 - shares[k, 1]
            node += i
    return node, is_inside


def flow_field(parameters_address: int, query_address: int, time: float) -> None:
    """Evaluate a query of a field; see `uwsim.currents.flow_function`."""
    current = carray(pointer(parameters_address), (1,), FIELD)[0]
    query = carray(pointer(query_address), (1,), QUERY)[0]
    corners = carray(pointer(current.corners), (current.n_corners,), CORNER)
    i, fraction, span = time_interval(current, time)
    size = 3 * current.n_nodes
    velocities = view_doubles(current.velocities + 8 * size * i, size)
    ends = view_doubles(current.velocities + 8 * size * (i + 1 if span > 0.0 else i), size)
    shares, velocity, change = np.empty((3, 2)), np.empty(3), np.empty(3)
    for p in range(query.n):
        node, is_inside = find_cell(current, view_doubles(query.points + 24 * p, 3), shares)
        velocity[:], change[:] = 0.0, 0.0
        for c in range(current.n_corners):
            corner = corners[c]
            x, y, z = corner.is_upper
            weight = shares[0, x] * shares[1, y] * shares[2, z]
            if current.is_still_outside != 0 and not is_inside:
                weight *= 0.0
            column = 3 * (node + corner.offset)
            for k in range(3):
                component = velocities[column + k]
                difference = ends[column + k] - component
                if fraction > 0.0:
                    velocity[k] += weight * (component + difference * fraction)
                else:
                    velocity[k] += weight * component
                change[k] += weight * difference
        fill(query.velocity + 24 * p, 1, velocity)
        if query.acceleration != 0:
            if span > 0.0:
                change /= span
            fill(query.acceleration + 24 * p, 1, change)
