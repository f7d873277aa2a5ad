r"""powerProfile, logProfile, layers: steady currents that depend on depth.

.. code-block:: xml

    <u:powerProfile>
      <u:velocity> <x>0.4</x> <y>0</y> <z>0</z> </u:velocity> <u:depth>20</u:depth>
    </u:powerProfile>
    <u:logProfile>
      <u:velocity> <x>0.4</x> <y>0</y> <z>0</z> </u:velocity> <u:depth>20</u:depth>
      <u:roughness>0.001</u:roughness>
    </u:logProfile>
    <u:layers>
      <u:layer>
        <u:depth>0</u:depth> <u:velocity> <x>0.5</x> <y>0</y> <z>0</z> </u:velocity>
      </u:layer>
      <u:layer>
        <u:depth>5</u:depth> <u:velocity> <x>0.1</x> <y>0.1</y> <z>0</z> </u:velocity>
      </u:layer>
    </u:layers>

Depths are below the still surface, along the vertical of the world frame W; velocities are in the
localized world frame L. The depth of the ground is the number in the file; the terrain of the scene
has no influence on it.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..base.geometry import Array, Triple
from ..base.numerics.calls import address_of
from ..base.numerics.jit import njit
from ..base.numerics.memory import carray, pointer, view_doubles
from ..errors import BadSetting
from ..schema import Spec, element
from .compiled import CompiledCurrent
from .current import MAX_SPEED, CurrentSpec, SceneContext
from .flow_function import QUERY, FlowFunction, Record, write_no_acceleration

KARMAN = 0.41
"""Von Karman's constant [1]."""


@dataclass(frozen=True, kw_only=True)
class PowerProfileSpec(CurrentSpec):
    """A ``<u:powerProfile>``: the speed grows with a power of the height above ground."""

    velocity: Triple = element(namespaced=True, minimum=-MAX_SPEED, maximum=MAX_SPEED)
    """The velocity of the water at the surface, in L [m/s]."""
    depth: float = element(namespaced=True, exclusive_minimum=0)
    """The depth of the ground below the still surface [m]."""
    exponent: float = element(namespaced=True, default=1.0 / 7.0, exclusive_minimum=0)
    """The exponent of the power law [1]."""

    def bind(self, context: SceneContext) -> PowerProfile:
        """Create the current with the surface height and the vertical of the scene."""
        return PowerProfile(self, context)


@dataclass(frozen=True, kw_only=True)
class LogProfileSpec(CurrentSpec):
    """A ``<u:logProfile>``: the speed grows with the logarithm of the height above ground."""

    velocity: Triple = element(namespaced=True, minimum=-MAX_SPEED, maximum=MAX_SPEED)
    """The velocity of the water at the surface, in L [m/s]."""
    depth: float = element(namespaced=True, exclusive_minimum=0)
    """The depth of the ground below the still surface [m]."""
    roughness: float = element(namespaced=True, default=0.001, exclusive_minimum=0)
    """The roughness length z0 of the seabed: mud 0.0002, gravel 0.005 [m]."""

    def bind(self, context: SceneContext) -> LogProfile:
        """Create the current with the surface height and the vertical of the scene.

        Raises:
            BadSetting: the depth is not greater than the roughness.
        """
        if self.depth <= self.roughness:
            raise BadSetting(
                f"<u:logProfile> has depth {self.depth:g} m and roughness {self.roughness:g} m; "
                "expected a depth above the roughness."
            )
        return LogProfile(self, context)


@dataclass(frozen=True, kw_only=True)
class LayerSpec(Spec):
    """A ``<u:layer>``: the velocity of the water at one depth."""

    depth: float = element(namespaced=True)
    """The depth below the still surface [m]."""
    velocity: Triple = element(namespaced=True, minimum=-MAX_SPEED, maximum=MAX_SPEED)
    """The velocity of the water at that depth, in L [m/s]."""


@dataclass(frozen=True, kw_only=True)
class LayersSpec(CurrentSpec):
    """A ``<u:layers>``: velocities at given depths, linear between them."""

    layers: tuple[LayerSpec, ...] = element("layer", namespaced=True)
    """The layers, from the top down."""

    def bind(self, context: SceneContext) -> Layers:
        """Create the current with the surface height and the vertical of the scene.

        Raises:
            BadSetting: a layer is not below the layer before it.
        """
        depths = [layer.depth for layer in self.layers]
        for upper_depth, lower_depth in itertools.pairwise(depths):
            if lower_depth <= upper_depth:
                raise BadSetting(
                    f"A <u:layer> of depth {lower_depth:g} m follows one of {upper_depth:g} m; "
                    "expected them from the top down, each depth once."
                )
        return Layers(self, context)


DEPTH_AXIS = np.dtype([("surface", np.float64), ("upward", np.float64, 3), ("origin", np.float64)])
"""The height of the still water in W [m], the z axis of W in L, and the height of L's origin in W
[m]; see `depth_of`."""
GROUND_PROFILE = np.dtype(
    [
        ("depth_axis", DEPTH_AXIS),
        ("velocity", np.float64, 3),  # the velocity at the surface, in L [m/s]
        ("depth", np.float64),  # the depth of the ground [m]
        ("exponent", np.float64),  # the exponent of the power law [1]
        ("roughness", np.float64),  # the roughness length of the logarithmic law [m]
        ("log_depth", np.float64),  # the logarithm of depth over roughness [1]
    ],
    align=True,
)
"""The parameters of `flow_power` and `flow_log`."""
LAYERS = np.dtype(
    [("depth_axis", DEPTH_AXIS), ("layers", np.int64), ("n_layers", np.int64)], align=True
)
"""The parameters of `flow_layers`; ``layers`` is the address of the depth [m] and velocity in L
[m/s] of each layer, (n, 4)."""


class Profile(CompiledCurrent):
    """A steady current that depends only on depth."""

    @property
    def is_steady(self) -> bool:
        """True if the velocity is constant in time; it always is."""
        return True


class PowerProfile(Profile):
    r"""A current whose speed follows the power law over the height above ground.

    .. math:: v(d) = v_0 \left(\frac{h - d}{h}\right)^{p}

    at the depth d in water of depth h, with the velocity :math:`v_0` at the surface and the
    exponent p, 1/7 by default (Soulsby, Dynamics of Marine Sands, 1997, for tidal flow). Above the
    surface the velocity is :math:`v_0`, below the ground it is 0. Not modelled: a direction that
    turns with depth, variation in time.
    """

    def __init__(self, spec: PowerProfileSpec, context: SceneContext) -> None:
        row = _ground_profile(context, spec.velocity, spec.depth)
        row["exponent"] = spec.exponent
        self._flow = FlowFunction(function=flow_power, parameters=row)


class LogProfile(Profile):
    r"""A current whose speed follows the law of the wall over the height above ground.

    .. math:: v(d) = v_0 \frac{\ln((h - d)/z_0)}{\ln(h/z_0)} \quad
        \left(u = \frac{u_*}{0.41} \ln \frac{h - d}{z_0}\right)

    at the depth d in water of depth h, with the velocity :math:`v_0` at the surface and the
    roughness length :math:`z_0` (Soulsby, Dynamics of Marine Sands, 1997). Above the surface the
    velocity is :math:`v_0`, at heights below :math:`z_0` it is 0. The law holds near the ground and
    is commonly used up to the surface. Not modelled: a direction that turns with depth,
    stratification, variation in time.
    """

    def __init__(self, spec: LogProfileSpec, context: SceneContext) -> None:
        row = _ground_profile(context, spec.velocity, spec.depth)
        row["roughness"] = spec.roughness
        row["log_depth"] = math.log(spec.depth / spec.roughness)
        self._flow = FlowFunction(function=flow_log, parameters=row)


class Layers(Profile):
    """A current interpolated linearly between given depths, constant above and below them.

    Not modelled: mixing, internal waves, variation in time.
    """

    def __init__(self, spec: LayersSpec, context: SceneContext) -> None:
        layers = np.array([(layer.depth, *layer.velocity) for layer in spec.layers])  # (k, 4)
        row = np.zeros(1, LAYERS)
        row["depth_axis"] = _depth_axis(context)
        row["layers"], row["n_layers"] = address_of(layers), len(layers)
        self._flow = FlowFunction(function=flow_layers, parameters=row, memory_owners=(layers,))


def _depth_axis(context: SceneContext) -> npt.NDArray[np.void]:
    """Return the record of `DEPTH_AXIS` of a scene, (1,)."""
    row, pose = np.zeros(1, DEPTH_AXIS), context.world_from_localized
    row["surface"], row["upward"], row["origin"] = (
        context.surface_height,
        pose.rotation[2],
        pose.position[2],
    )
    return row


def _ground_profile(context: SceneContext, velocity: Triple, depth: float) -> npt.NDArray[np.void]:
    row = np.zeros(1, GROUND_PROFILE)
    row["depth_axis"], row["velocity"], row["depth"] = _depth_axis(context), velocity, depth
    return row


@njit
def depth_of(depth_axis: Record, points: Array, i: int) -> float:
    """Return the depth of point i below the still surface [m]; negative above it.

    Args:
        depth_axis: a record of `DEPTH_AXIS`.
        points: the coordinates of n points in L, one after the other, (3 n,) [m].
        i: the index of the point.
    """
    up = depth_axis.upward
    height = 0.0 + points[3 * i] * up[0] + points[3 * i + 1] * up[1] + points[3 * i + 2] * up[2]
    depth: float = depth_axis.surface - (height + depth_axis.origin)
    return depth


@njit
def clamp(value: float, minimum: float, maximum: float) -> float:
    """Limit a number to a range; NaN remains NaN."""
    return minimum if value < minimum else maximum if value > maximum else value


def flow_power(parameters_address: int, query_address: int, time: float) -> None:
    """Evaluate a query of a power profile; see `uwsim.currents.flow_function`."""
    current = carray(pointer(parameters_address), (1,), GROUND_PROFILE)[0]
    query = carray(pointer(query_address), (1,), QUERY)[0]
    points, velocities = (
        view_doubles(query.points, 3 * query.n),
        view_doubles(query.velocity, 3 * query.n),
    )
    depth, share = math.nan, 0.0
    for i in range(query.n):
        point_depth = depth_of(current.depth_axis, points, i)
        if point_depth != depth:  # neighbouring points often have the same depth
            depth = point_depth
            share = math.pow(clamp(1.0 - depth / current.depth, 0.0, 1.0), current.exponent)
        for k in range(3):
            velocities[3 * i + k] = share * current.velocity[k]
    write_no_acceleration(query)


def flow_log(parameters_address: int, query_address: int, time: float) -> None:
    """Evaluate a query of a logarithmic profile; see `uwsim.currents.flow_function`."""
    current = carray(pointer(parameters_address), (1,), GROUND_PROFILE)[0]
    query = carray(pointer(query_address), (1,), QUERY)[0]
    points, velocities = (
        view_doubles(query.points, 3 * query.n),
        view_doubles(query.velocity, 3 * query.n),
    )
    depth, share = math.nan, 0.0
    for i in range(query.n):
        point_depth = depth_of(current.depth_axis, points, i)
        if point_depth != depth:
            depth = point_depth
            height = clamp(current.depth - depth, current.roughness, current.depth)
            share = math.log(height / current.roughness) / current.log_depth
        for k in range(3):
            velocities[3 * i + k] = share * current.velocity[k]
    write_no_acceleration(query)


def flow_layers(parameters_address: int, query_address: int, time: float) -> None:
    """Evaluate a query of layers; see `uwsim.currents.flow_function`."""
    current = carray(pointer(parameters_address), (1,), LAYERS)[0]
    query = carray(pointer(query_address), (1,), QUERY)[0]
    points, velocities = (
        view_doubles(query.points, 3 * query.n),
        view_doubles(query.velocity, 3 * query.n),
    )
    layers = view_doubles(current.layers, 4 * current.n_layers).reshape((current.n_layers, 4))
    for i in range(query.n):
        depth = depth_of(current.depth_axis, points, i)
        lower = 0  # the first layer below the point
        while lower < len(layers) and layers[lower, 0] <= depth:
            lower += 1
        upper, lower_layer = max(0, lower - 1), min(lower, len(layers) - 1)
        for k in range(3):
            velocity = layers[upper, 1 + k]
            velocities[3 * i + k] = velocity
            if upper < lower_layer and depth != layers[upper, 0]:
                slope = (layers[lower_layer, 1 + k] - velocity) / (
                    layers[lower_layer, 0] - layers[upper, 0]
                )
                velocities[3 * i + k] = slope * (depth - layers[upper, 0]) + velocity
    write_no_acceleration(query)
