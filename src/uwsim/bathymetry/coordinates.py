r"""Coordinate systems of charts, and their relation to a scene's frame W.

W has its origin at the ``<nedOrigin>`` of the scene, x east and y north in the plane that is
tangent to the ellipsoid of WGS84 (`uwsim.base.geodesy`). A point of a chart with latitude and
longitude is projected to this plane along the vertical of the origin. This is the ellipsoidal
orthographic projection (EPSG method 9840), which GPS and DVL positions of the scene use too. At
10 km from the origin, distances are shorter by 1.2e-6. Heights are not projected: the sea surface
of a scene is a plane, so that the drop of the ellipsoid (8 m at 10 km) is left out.

Charts in latitude and longitude of WGS84 and in the orthographic projection are converted here;
pyproj converts those in any other system.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from ..base.geodesy import FLATTENING, SEMI_MAJOR_AXIS, Geodetic
from ..base.geometry import Array
from ..base.numerics.jit import njit
from ..errors import AssetError, MissingExtra

WGS84 = "EPSG:4326"
"""The code of latitude and longitude on WGS84."""
SAME_ANGLE = 1e-12
"""The difference of latitude and longitude below which two positions are the same [rad]: 6 um."""
_ORTHOGRAPHIC = re.compile(r"\+proj=ortho\b")
_WGS84_NAMES = re.compile(r'^\s*(GEOGCS|GEOGCRS)\s*\[\s*"(WGS[ _]?84|GCS_WGS_1984)"', re.IGNORECASE)


@dataclass(frozen=True)
class CoordinateSystem:
    """The coordinate system of a chart."""

    kind: Literal["local", "geographic", "orthographic", "other"]
    """Metres east and north of the scene's origin; degrees of longitude and latitude on WGS84;
    metres of the orthographic projection about `centre`; or the system of `definition`."""
    definition: str = ""
    """The definition of the system for pyproj: a code such as ``EPSG:32631``, or a WKT."""
    centre: Geodetic | None = None
    """The centre of the orthographic projection."""

    @property
    def description(self) -> str:
        """The system in words."""
        if self.kind == "local":
            return "metres east and north of the scene's origin"
        if self.kind == "geographic":
            return f"longitude and latitude ({WGS84})"
        if self.centre is not None:
            latitude, longitude = (
                math.degrees(angle) for angle in (self.centre.latitude, self.centre.longitude)
            )
            return f"metres about {latitude:.6f}, {longitude:.6f} (orthographic, WGS84)"
        return self.definition if len(self.definition) < 40 else _name_of(self.definition)


LOCAL_SYSTEM = CoordinateSystem("local")


def orthographic(centre: Geodetic) -> CoordinateSystem:
    """Return the orthographic projection about a position."""
    latitude, longitude = (math.degrees(a) for a in (centre.latitude, centre.longitude))
    text = f"+proj=ortho +lat_0={latitude!r} +lon_0={longitude!r} +ellps=WGS84 +units=m"
    return CoordinateSystem("orthographic", text, centre)


def parse_system(text: str) -> CoordinateSystem:
    """Return the coordinate system of a definition: a code, a PROJ text, a WKT; empty: local."""
    text = text.strip()
    if not text:
        return LOCAL_SYSTEM
    if text.upper() == WGS84 or _WGS84_NAMES.match(text):
        return CoordinateSystem("geographic", WGS84)
    if _ORTHOGRAPHIC.search(text):
        numbers = dict(re.findall(r"\+(lat_0|lon_0)=([-+.\deE]+)", text))
        try:
            latitude, longitude = (float(numbers.get(key, "0")) for key in ("lat_0", "lon_0"))
        except ValueError:
            return CoordinateSystem("other", text)
        return orthographic(
            Geodetic(latitude=math.radians(latitude), longitude=math.radians(longitude))
        )
    return CoordinateSystem("other", text)


def wkt_of(system: CoordinateSystem) -> str:
    """Return the WKT of a ``.prj`` file; empty for local coordinates, which have none."""
    datum = (
        'GEOGCS["GCS_WGS_1984",DATUM["D_WGS_1984",SPHEROID["WGS_1984",6378137.0,298.257223563]],'
        'PRIMEM["Greenwich",0.0],UNIT["Degree",0.0174532925199433]]'
    )
    if system.kind == "geographic":
        return datum
    if system.centre is not None:
        latitude, longitude = (
            math.degrees(a) for a in (system.centre.latitude, system.centre.longitude)
        )
        return (
            f'PROJCS["Orthographic",{datum},PROJECTION["Orthographic"],'
            f'PARAMETER["Latitude_Of_Center",{latitude!r}],'
            f'PARAMETER["Longitude_Of_Center",{longitude!r}],'
            'PARAMETER["False_Easting",0.0],PARAMETER["False_Northing",0.0],UNIT["Meter",1.0]]'
        )
    return system.definition if system.kind == "other" else ""


def parse_wkt(text: str) -> CoordinateSystem:
    """Return the coordinate system of the text of a ``.prj`` file."""
    if 'PROJECTION["Orthographic"]' in text:
        numbers = dict(re.findall(r'"(L\w+_Of_Center)",\s*([-+.\deE]+)', text, re.IGNORECASE))
        latitude, longitude = (
            float(numbers.get(f"{name}_Of_Center", "0")) for name in ("Latitude", "Longitude")
        )
        return orthographic(
            Geodetic(latitude=math.radians(latitude), longitude=math.radians(longitude))
        )
    return parse_system(text)


class Projection:
    """The relation of a chart's coordinates to W.

    Args:
        system: the coordinate system of the chart.
        origin: the position on Earth of the origin of W; None for a chart in local coordinates.
        source: the file of the chart, for errors.

    Raises:
        AssetError: the system is unknown to pyproj.
        MissingExtra: pyproj is needed and not installed.
    """

    def __init__(self, system: CoordinateSystem, origin: Geodetic | None, source: str) -> None:
        self._system, self._origin = system, origin
        self._transformer = None if system.kind != "other" else _transformer(system, source)

    @property
    def is_identity(self) -> bool:
        """True if the chart's coordinates are x and y of W."""
        centre, origin = self._system.centre, self._origin
        if centre is None or origin is None:
            return self._system.kind == "local"
        offset = abs(centre.latitude - origin.latitude) + abs(centre.longitude - origin.longitude)
        return offset < SAME_ANGLE

    def to_local(self, x: Array, y: Array) -> tuple[Array, Array]:
        """Convert the chart's coordinates to x and y of W, (n,) each [m]."""
        if self.is_identity:
            return x, y
        assert self._origin is not None
        latitude, longitude = self._to_geodetic(x, y)
        return project(latitude, longitude, self._origin.latitude, self._origin.longitude)

    def from_local(self, x: Array, y: Array) -> tuple[Array, Array]:
        """Convert x and y of W, (n,) each [m], to the chart's coordinates."""
        if self.is_identity:
            return x, y
        assert self._origin is not None
        latitude, longitude = unproject(x, y, self._origin.latitude, self._origin.longitude)
        if self._system.centre is not None:
            centre = self._system.centre
            return project(latitude, longitude, centre.latitude, centre.longitude)
        degrees = longitude * (180.0 / math.pi), latitude * (180.0 / math.pi)
        if self._transformer is None:
            return degrees
        from_degrees: tuple[Array, Array] = self._transformer.transform(*degrees)
        return from_degrees

    def geodetic_centre(self, x: float, y: float) -> Geodetic:
        """Return the position on Earth of a point of the chart."""
        latitude, longitude = self._to_geodetic(np.array([x]), np.array([y]))
        return Geodetic(latitude=float(latitude[0]), longitude=float(longitude[0]))

    def _to_geodetic(self, x: Array, y: Array) -> tuple[Array, Array]:
        """Return latitude and longitude [rad] of the chart's coordinates."""
        if self._system.centre is not None:
            centre = self._system.centre
            return unproject(x, y, centre.latitude, centre.longitude)
        if self._transformer is not None:
            x, y = self._transformer.transform(x, y, direction="INVERSE")
        return y * (math.pi / 180.0), x * (math.pi / 180.0)


def _transformer(system: CoordinateSystem, source: str) -> Any:
    """Return the transformer of pyproj from longitude and latitude to a system."""
    try:
        import pyproj
    except ImportError as error:
        raise MissingExtra(
            f"{source}: coordinates in {system.description} need pyproj: "
            "pip install 'uwsim[charts]'."
        ) from error
    try:
        return pyproj.Transformer.from_crs(WGS84, system.definition, always_xy=True)
    except pyproj.exceptions.ProjError as error:
        raise AssetError(
            f"{source}: {system.definition[:60]!r} is no coordinate system; expected a code such "
            "as EPSG:32631, or a WKT."
        ) from error


def _name_of(wkt: str) -> str:
    """Return the name in a WKT."""
    match = re.search(r'"([^"]{1,60})"', wkt)
    return match[1] if match else wkt[:40]


@njit
def project(
    latitude: Array, longitude: Array, latitude_0: float, longitude_0: float
) -> tuple[Array, Array]:
    """Return x (east) and y (north) of positions on the ellipsoid, (n,) each [m].

    Args:
        latitude: the geodetic latitudes, (n,) [rad].
        longitude: the longitudes, (n,) [rad].
        latitude_0: the latitude of the origin [rad].
        longitude_0: the longitude of the origin [rad].
    """
    e2 = FLATTENING * (2.0 - FLATTENING)
    s_0, c_0 = math.sin(latitude_0), math.cos(latitude_0)
    nu_0 = SEMI_MAJOR_AXIS / math.sqrt(1.0 - e2 * s_0 * s_0)
    x, y = np.empty(len(latitude)), np.empty(len(latitude))
    for n in range(len(latitude)):
        s, c = math.sin(latitude[n]), math.cos(latitude[n])
        difference = longitude[n] - longitude_0
        nu = SEMI_MAJOR_AXIS / math.sqrt(1.0 - e2 * s * s)
        x[n] = nu * c * math.sin(difference)
        y[n] = nu * (s * c_0 - c * s_0 * math.cos(difference)) + e2 * (nu_0 * s_0 - nu * s) * c_0
    return x, y


@njit
def unproject(x: Array, y: Array, latitude_0: float, longitude_0: float) -> tuple[Array, Array]:
    """Return latitude and longitude [rad] of points of the tangent plane, (n,) each.

    The line through a point along the vertical of the origin meets the ellipsoid where a quadratic
    equation has its smaller root. This is the inverse of `project`.
    """
    e2 = FLATTENING * (2.0 - FLATTENING)
    s_0, c_0 = math.sin(latitude_0), math.cos(latitude_0)
    nu_0 = SEMI_MAJOR_AXIS / math.sqrt(1.0 - e2 * s_0 * s_0)
    q = 1.0 / (1.0 - e2)
    latitude, longitude = np.empty(len(x)), np.empty(len(x))
    for n in range(len(x)):
        # earth-centred coordinates in the meridian of the origin: along it, across it, polar
        radial, eastward = nu_0 * c_0 - s_0 * y[n], x[n]
        polar = (1.0 - e2) * nu_0 * s_0 + c_0 * y[n]
        a = c_0 * c_0 + q * s_0 * s_0
        half_b = -(radial * c_0 + q * polar * s_0)
        c = (
            radial * radial
            + eastward * eastward
            + q * polar * polar
            - SEMI_MAJOR_AXIS * SEMI_MAJOR_AXIS
        )
        root = math.sqrt(max(half_b * half_b - a * c, 0.0))
        depth = c / (root - half_b)
        radial, polar = radial - depth * c_0, polar - depth * s_0
        axis_distance = math.sqrt(radial * radial + eastward * eastward)
        latitude[n] = math.atan2(polar, axis_distance * (1.0 - e2))
        longitude[n] = longitude_0 + math.atan2(eastward, radial)
    return latitude, longitude
