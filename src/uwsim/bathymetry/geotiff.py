"""GeoTIFF charts (``.tif``, ``.tiff``): one band of heights, with its place in GeoKeys.

The pixels are read by Pillow, in strips or tiles, uncompressed or compressed by LZW or Deflate, of
8 to 32 bits a pixel. The first pixel is that of the north-west corner. Not read: rotated rasters,
several bands, several pages (the first is read), vertical datums (heights are those of the file),
and systems that are defined by parameters other than the orthographic projection on WGS84.
"""

from __future__ import annotations

import io
import math
import warnings
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from ..base.geodesy import Geodetic
from ..errors import AssetError
from .chart import Chart
from .coordinates import LOCAL_SYSTEM, WGS84, CoordinateSystem, orthographic, parse_system
from .height_grid import Heights, check_size

SCALE, TIE_POINT, TRANSFORM = 33550, 33922, 34264
"""The tags with the pixel's size, with a pixel of known place, and with a matrix (refused)."""
KEYS, DOUBLES, NO_DATA = 34735, 34736, 42113
"""The tags with the GeoKeys, with their numbers, and with GDAL's value of no data."""
MODEL_TYPE, RASTER_TYPE, GEOGRAPHIC_TYPE, PROJECTED_TYPE = 1024, 1025, 2048, 3072
PROJECTION, METHOD, LINEAR_UNITS, CENTRE_LONGITUDE, CENTRE_LATITUDE = 3074, 3075, 3076, 3088, 3089
PIXEL_IS_POINT, USER_DEFINED, ORTHOGRAPHIC_METHOD = 2, 32767, 21
_MODES = {"F": np.float32, "L": np.uint8, "I": np.int32, "I;16": np.uint16, "I;16B": np.uint16}
"""The modes of images with one band."""


def read(path: Path, data: bytes) -> Chart:
    """Read a chart from the bytes of a GeoTIFF; raise AssetError."""
    from PIL import Image, UnidentifiedImageError

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            warnings.filterwarnings("error", message=".*([Cc]orrupt|[Tt]runcated)")
            image = Image.open(io.BytesIO(data), formats=("TIFF",))
            columns, rows = image.size
            check_size(rows, columns, str(path))
            if image.mode not in _MODES:
                raise AssetError(
                    f"{path}: is an image of the mode {image.mode}; expected one band of heights."
                )
            tags: Mapping[int, Any] = dict(image.tag_v2)  # type: ignore[attr-defined]
            values = np.asarray(image, dtype=np.float32)
    except (Image.DecompressionBombError, UnidentifiedImageError, OSError, SyntaxError) as error:
        raise AssetError(f"{path}: is no TIFF that can be read ({error}).") from error
    except (ValueError, TypeError, KeyError, EOFError, OverflowError, UserWarning) as error:
        raise AssetError(f"{path}: is damaged ({error}).") from error
    if TRANSFORM in tags or SCALE not in tags or len(tags.get(TIE_POINT, ())) != 6:
        raise AssetError(
            f"{path}: has no pixel size and tie point; expected a GeoTIFF whose rows run east-west."
        )
    try:
        step_x, step_y = (float(value) for value in tags[SCALE][:2])
        column, row, _, x, y, _ = (float(value) for value in tags[TIE_POINT])
        keys = _read_keys(tags)
    except (TypeError, ValueError, IndexError) as error:
        raise AssetError(f"{path}: has damaged GeoKeys ({error}).") from error
    if not (step_x > 0.0 and step_y > 0.0 and math.isfinite(x) and math.isfinite(y)):
        raise AssetError(f"{path}: the pixel size is {step_x:g} x {step_y:g}; expected above 0.")
    shift = 0.0 if keys.get(RASTER_TYPE) == PIXEL_IS_POINT else 0.5
    return Chart(
        x=x + (shift - column) * step_x,
        y=y - (rows - 1 + shift - row) * step_y,
        step_x=step_x,
        step_y=step_y,
        heights=_with_holes(path, values, tags.get(NO_DATA)),
        system=_system(path, keys),
    )


def _with_holes(path: Path, values: Heights, no_data: object) -> Heights:
    """Return the rows from south to north, with NaN for the value of no data."""
    heights = np.array(values[::-1], np.float32)
    if no_data is not None:
        text = no_data[0] if isinstance(no_data, tuple) else no_data
        try:
            number = float(str(text).strip("\0 "))
        except ValueError as error:
            raise AssetError(
                f"{path}: the value of no data is {text!r}; expected a number."
            ) from error
        heights[heights == np.float32(number)] = np.nan
    return heights


def _read_keys(tags: Mapping[int, Any]) -> dict[int, float]:
    """Return the numbers of the GeoKeys; a text counts as 0."""
    directory, doubles = tags.get(KEYS, ()), tags.get(DOUBLES, ())
    keys: dict[int, float] = {}
    for k in range(4, len(directory) - 3, 4):
        key, place, count, value = directory[k : k + 4]
        if place == 0:
            keys[key] = value
        elif place == DOUBLES and count:
            keys[key] = float(doubles[value])
    return keys


def _system(path: Path, keys: Mapping[int, float]) -> CoordinateSystem:
    if keys.get(MODEL_TYPE) not in (1, 2):
        return LOCAL_SYSTEM
    code = int(keys.get(PROJECTED_TYPE if keys[MODEL_TYPE] == 1 else GEOGRAPHIC_TYPE, USER_DEFINED))
    if code not in (0, USER_DEFINED):
        return parse_system(f"EPSG:{code}")
    if keys.get(METHOD) == ORTHOGRAPHIC_METHOD and keys.get(GEOGRAPHIC_TYPE) == 4326:
        latitude, longitude = keys.get(CENTRE_LATITUDE, 0.0), keys.get(CENTRE_LONGITUDE, 0.0)
        return orthographic(
            Geodetic(latitude=math.radians(latitude), longitude=math.radians(longitude))
        )
    raise AssetError(
        f"{path}: its coordinate system has no EPSG code; expected one, such as EPSG:32631. "
        f"`gdalwarp -t_srs {WGS84}` converts the file."
    )


def write(path: Path, chart: Chart) -> None:
    """Write a chart as a GeoTIFF of 32-bit numbers, compressed by Deflate.

    Raises:
        AssetError: the coordinate system is neither an EPSG code nor the orthographic projection.
    """
    from PIL import Image
    from PIL.TiffImagePlugin import ImageFileDirectory_v2

    ifd = ImageFileDirectory_v2()
    rows = chart.shape[0]
    short_type, double_type, text_type = 3, 12, 2
    directory, doubles = _make_keys(path, chart.system)
    north = float(chart.y + (rows - 1) * chart.step_y)
    for tag, kind, value in (
        (SCALE, double_type, (float(chart.step_x), float(chart.step_y), 0.0)),
        (TIE_POINT, double_type, (0.0, 0.0, 0.0, float(chart.x), north, 0.0)),
        (KEYS, short_type, directory),
        (DOUBLES, double_type, doubles),
        (NO_DATA, text_type, "nan"),
    ):
        if value:
            ifd.tagtype[tag] = kind
            ifd[tag] = value
    image = Image.fromarray(np.ascontiguousarray(chart.heights[::-1], np.float32))
    image.save(path, format="TIFF", tiffinfo=ifd, compression="tiff_adobe_deflate")


def _make_keys(path: Path, system: CoordinateSystem) -> tuple[tuple[int, ...], tuple[float, ...]]:
    """Return the directory of GeoKeys and their numbers."""
    doubles: tuple[float, ...] = ()
    entries = [(RASTER_TYPE, 0, 1, PIXEL_IS_POINT)]
    if system.kind == "geographic":
        entries += [(MODEL_TYPE, 0, 1, 2), (GEOGRAPHIC_TYPE, 0, 1, 4326)]
    elif system.centre is not None:
        doubles = tuple(math.degrees(a) for a in (system.centre.longitude, system.centre.latitude))
        entries += [
            (MODEL_TYPE, 0, 1, 1),
            (GEOGRAPHIC_TYPE, 0, 1, 4326),
            (PROJECTED_TYPE, 0, 1, USER_DEFINED),
            (PROJECTION, 0, 1, USER_DEFINED),
            (METHOD, 0, 1, ORTHOGRAPHIC_METHOD),
            (LINEAR_UNITS, 0, 1, 9001),
            (CENTRE_LONGITUDE, DOUBLES, 1, 0),
            (CENTRE_LATITUDE, DOUBLES, 1, 1),
        ]
    elif system.kind == "other":
        code = system.definition.upper().removeprefix("EPSG:")
        if not code.isdigit():
            raise AssetError(f"{path}: {system.description} has no EPSG code, which GeoTIFF needs.")
        entries += [(MODEL_TYPE, 0, 1, 1), (PROJECTED_TYPE, 0, 1, int(code))]
    header = (1, 1, 0, len(entries))
    return tuple(n for entry in (header, *sorted(entries)) for n in entry), doubles
