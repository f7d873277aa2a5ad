r"""tether: a cable between a body and a point of the world or another body, with a winch.

.. code-block:: xml

    <u:tether>
      <name>tether</name>
      <from> <body>bluerov2</body> <position> <x>-0.2</x> <y>0</y> <z>-0.1</z> </position> </from>
      <to> <position> <x>0</x> <y>0</y> <z>0</z> </position> </to>
      <length>60</length> <segments>40</segments>
      <breakLoad>1550</breakLoad>
      <winch> <maxLength>100</maxLength> <maxSpeed>0.5</maxSpeed> </winch>
    </u:tether>

``docs/tethers.md`` has the equations, the sources and the validation.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ..base.geometry import ZERO, Array, Triple
from ..base.numerics.linear import length
from ..base.record import Record
from ..schema import MAX_DISTANCE, Spec, element
from ..world import GRAVITY, Attachment, ForceWorld
from .chain.chain_step import advance_chain
from .chain.ground import PERIOD, lift_nodes, update_planes
from .chain.initial_shape import arc_between
from .chain.line import HELD_MASS, Ends, Line, Nodes, NodeSurroundings
from .chain.reel import change_length
from .force import DrawnSegments, Force, ForceSpec

MAX_SEGMENTS = 1000
"""The largest number of segments of a tether, paid out or not."""
MAX_LENGTH = 20_000.0
"""The greatest length of a tether [m]."""
MAX_SPEED = 20.0
"""The greatest speed of a winch [m/s]."""
MAX_FORCE = 1e9
"""The greatest stiffness and load [N]."""
MAX_COEFFICIENT = 100.0
"""The greatest coefficient of drag, added mass and friction [1]."""
MAX_JUMP = 0.5
"""The distance that an end moves in a step beyond which its body has been placed elsewhere [m]."""
YELLOW = (0.95, 0.72, 0.05)
"""The colour of a tether, red, green and blue [0..1]."""


@dataclass(frozen=True, kw_only=True)
class TetherEndSpec(Spec):
    """An end of a ``<u:tether>``: a point of a body, or of the world."""

    body: str | None = element(default=None, refers_to="body")
    """The body that carries the end: a vehicle (its base), ``vehicle/link``, or an object; without
    it the end is fixed in the world."""
    position: Triple = element(default=ZERO, minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE)
    """The position of the end in the frame of the body, or in the frame of the scene file [m]."""


@dataclass(frozen=True, kw_only=True)
class WinchSpec(Spec):
    """The ``<winch>`` of a ``<u:tether>``, at its end ``<to>``."""

    min_length: float = element(default=1.0, exclusive_minimum=0.0, maximum=MAX_LENGTH)
    """The length at which the winch stops hauling in [m]."""
    max_length: float = element(exclusive_minimum=0.0, maximum=MAX_LENGTH)
    """The length at which the winch stops paying out [m]."""
    max_speed: float = element(default=0.5, exclusive_minimum=0.0, maximum=MAX_SPEED)
    """The greatest speed of the winch [m/s]; a faster command is limited to it."""
    speed: float = element(default=0.0, minimum=-MAX_SPEED, maximum=MAX_SPEED)
    """The speed of the winch until the first command; positive when it pays out [m/s]."""


@dataclass(frozen=True, kw_only=True)
class TetherSpec(ForceSpec):
    """A ``<u:tether>``; its defaults are those of a neutrally buoyant tether of a small vehicle."""

    start: TetherEndSpec = element("from")
    """The first end."""
    end: TetherEndSpec = element("to")
    """The other end, where the winch is."""
    length: float = element(exclusive_minimum=0.0, maximum=MAX_LENGTH)
    """The length without tension at the beginning [m]."""
    segments: int = element(default=40, minimum=1, maximum=MAX_SEGMENTS)
    """The number of segments of this length."""
    diameter: float = element(default=0.0076, minimum=1e-4, maximum=1.0)
    """The diameter [m]."""
    density: float | None = element(default=None, exclusive_minimum=0.0, maximum=20_000.0)
    """The mass per volume [kg/m3]; without it the tether is neutrally buoyant at its lower end."""
    weight_in_water: float | None = element(default=None, minimum=-1e5, maximum=1e5)
    """The weight less the buoyancy of a length, instead of a density [N/m]."""
    axial_stiffness: float = element(default=5e4, exclusive_minimum=0.0, maximum=MAX_FORCE)
    """The tension by the strain, EA [N]."""
    axial_damping: float = element(default=100.0, minimum=0.0, maximum=MAX_FORCE)
    """The tension by the rate of the strain [N s]."""
    bending_stiffness: float = element(default=0.0, minimum=0.0, maximum=MAX_FORCE)
    """The bending moment by the curvature, EI [N m2]."""
    normal_drag: float = element(default=1.2, minimum=0.0, maximum=MAX_COEFFICIENT)
    """The drag coefficient across the tether, on the area of its side view [1]."""
    tangential_drag: float = element(default=0.008, minimum=0.0, maximum=MAX_COEFFICIENT)
    """The drag coefficient along the tether, on the area of its skin [1]."""
    added_mass: float = element(default=1.0, minimum=0.0, maximum=MAX_COEFFICIENT)
    """The added mass across the tether, in displaced masses [1]."""
    contact_stiffness: float = element(default=1e4, minimum=0.0, maximum=1e9)
    """The force of the ground on a length, by its depth in the ground [N/m2]; 0: no contact."""
    contact_damping: float = element(default=100.0, minimum=0.0, maximum=1e9)
    """The force of the ground on a length, by its speed into the ground [N s/m2]."""
    friction: float = element(default=0.5, minimum=0.0, maximum=MAX_COEFFICIENT)
    """The friction coefficient on the ground [1]."""
    break_load: float | None = element(default=None, exclusive_minimum=0.0, maximum=MAX_FORCE)
    """The tension at which a segment breaks [N]; without it the tether does not break."""
    winch: WinchSpec | None = None
    """The winch at the end ``<to>``; without it the length is constant."""
    colour: Triple = element(default=YELLOW, parts="rgb", minimum=0.0, maximum=1.0)
    """The colour in images [0..1]."""

    def errors(self) -> Iterator[str]:
        """Yield errors of elements that contradict each other."""
        if self.density is not None and self.weight_in_water is not None:
            yield "<density> and <weightInWater> are both given; remove one of them"
        if self.start.body is None and self.end.body is None and self.winch is not None:
            yield "<winch> has a tether whose ends are both fixed; expected a <body> at one end"
        if self.winch is None:
            return
        if not self.winch.min_length <= self.length <= self.winch.max_length:
            yield (
                f"<length> is {self.length:g}; expected a length from <minLength> "
                f"{self.winch.min_length:g} to <maxLength> {self.winch.max_length:g}"
            )
        elif self.n_segments > MAX_SEGMENTS:
            yield (
                f"<maxLength> is {self.winch.max_length:g}, {self.n_segments} segments of "
                f"{self.unit_length:g} m; expected at most {MAX_SEGMENTS} segments"
            )

    @property
    def unit_length(self) -> float:
        """The unstretched length of a segment [m]."""
        return self.length / self.segments

    @property
    def n_segments(self) -> int:
        """The number of segments at the greatest length."""
        if self.winch is None:
            return self.segments
        return max(self.segments, math.ceil(self.winch.max_length / self.unit_length - 1e-9))

    @property
    def drawn_segments(self) -> DrawnSegments:
        """The cylinders that show the tether."""
        return DrawnSegments(self.n_segments, self.unit_length, 0.5 * self.diameter, self.colour)

    def bind(self, world: ForceWorld) -> Tether:
        """Find the bodies at its ends; raise UnknownName if one is missing."""
        return Tether(self, world)


@dataclass(slots=True)
class TetherState(Record):
    """The state of a tether. The rows of segments that are on the drum have no meaning."""

    positions: Array
    """The positions of the nodes in W, (n + 1, 3) [m]."""
    velocities: Array
    """The velocities of the nodes in W, (n + 1, 3) [m/s]."""
    lengths: Array
    """The unstretched lengths of the segments, (n,) [m]."""
    tensions: Array
    """The tensions of the segments, (n,) [N]."""
    planes: Array
    """The planes of the ground near the nodes; see `chain.line.NodeSurroundings`, (n + 1, 5)."""
    n_segments: int
    """The number of segments that are paid out."""
    speed: float
    """The commanded speed of the winch [m/s]."""
    n_steps: int = 0
    """The number of steps so far."""
    broken_segment: int = -1
    """The index of the broken segment; -1: none."""
    break_time: float = 0.0
    """The time at which it broke [s]."""
    break_tension: float = 0.0
    """The tension at which it broke [N]."""


class Tether(Force):
    """A chain of point masses between two ends, with the equations of `chain`.

    Its motion is solved at the beginning of each step, together with that of the bodies at its
    ends; the forces on the bodies are those at the end of the step.

    Not modelled: torsion, hysteresis of the material, vortex-induced vibration, the inertia of
    accelerated water (Froude-Krylov), and a moment at the ends, which are hinges.
    """

    def __init__(self, spec: TetherSpec, world: ForceWorld) -> None:
        self._spec, self._world = spec, world
        self._ends = tuple(
            None if end.body is None else world.attach(end.body, end.position)
            for end in (spec.start, spec.end)
        )
        self._fixed_positions = tuple(
            world.world_from_localized.transform(np.array([end.position]))[0]
            for end in (spec.start, spec.end)
        )
        self._vehicle = next((end.vehicle for end in self._ends if end is not None), "")
        self._rays = world.rays
        solid = [name == "" for name in world.rays.vehicles]
        self._are_solid = np.array(solid, np.uint8)
        self._stride = max(1, round(PERIOD / world.timestep))
        self._segments = world.segments(spec.name)
        self.state: TetherState = self._initial_state()
        """The state: nodes, lengths, tensions, winch."""
        self._line = self._describe_line()
        self._place_segments()

    @property
    def name(self) -> str:
        """The name of the tether."""
        return self._spec.name

    @property
    def length(self) -> float:
        """The unstretched length that is paid out [m]."""
        total = 0.0
        for segment_length in self.state.lengths[: self.state.n_segments].tolist():
            total += segment_length
        return total

    @property
    def winch_speed(self) -> float:
        """The speed at which the winch pays out now [m/s]."""
        winch, state = self._spec.winch, self.state
        if winch is None or state.broken_segment >= 0:
            return 0.0
        speed = min(max(state.speed, -winch.max_speed), winch.max_speed)
        step = self._world.timestep
        margins = (winch.max_length - self.length) / step, (winch.min_length - self.length) / step
        return max(min(speed, max(margins[0], 0.0)), min(margins[1], 0.0))

    @property
    def has_winch(self) -> bool:
        """True if the tether has a winch, whose speed can be set."""
        return self._spec.winch is not None

    def set_winch_speed(self, speed: float) -> None:
        """Set the speed of the winch [m/s], positive to pay out; its limits apply."""
        self.state.speed = speed

    @property
    def end_tensions(self) -> tuple[float, float]:
        """The tensions of the first and of the last segment [N]."""
        tensions = self.state.tensions
        return float(tensions[0]), float(tensions[self.state.n_segments - 1])

    @property
    def break_report(self) -> str | None:
        """A sentence about the break of the tether; None before."""
        state = self.state
        if state.broken_segment < 0:
            return None
        return (
            f"The tether {self.name!r} broke at {state.break_time:.6g} s: {state.break_tension:.6g}"
            f" N at segment {state.broken_segment + 1} of {state.n_segments}."
        )

    def wrenches(self, time: float) -> Iterator[tuple[Attachment, Array]]:
        """Advance the tether by a step; yield the force on each body at its ends, in W."""
        state, step = self.state, self._world.timestep
        speed = self.winch_speed
        if speed != 0.0:
            state.n_segments = change_length(
                state.positions,
                state.velocities,
                state.lengths,
                state.n_segments,
                self._spec.unit_length,
                speed * step,
            )
        n = state.n_segments
        ends = self._find_ends()
        positions, velocities = state.positions[: n + 1], state.velocities[: n + 1]
        if self._line.contact_stiffness > 0.0:
            self._rays.prepare()
            update_planes(
                self._rays.functions,
                self._are_solid,
                positions,
                state.n_steps % self._stride,
                self._stride,
                state.planes,
            )
        water = NodeSurroundings(
            self._world.water_velocity(positions, time, self._vehicle),
            self._world.water_density(positions),
            state.planes[: n + 1],
        )
        nodes = Nodes(positions, velocities, state.lengths[:n], state.broken_segment)
        forces = advance_chain(self._line, step, nodes, water, ends, state.tensions[:n])
        state.n_steps += 1
        self._break_if_overloaded(time + step)
        self._place_segments()
        for end, force in zip(self._ends, forces, strict=True):
            if end is not None:
                yield end, np.array([*force.tolist(), 0.0, 0.0, 0.0])

    def _break_if_overloaded(self, time: float) -> None:
        state, limit = self.state, self._spec.break_load
        if limit is None or state.broken_segment >= 0:
            return
        tensions = state.tensions[: state.n_segments]
        segment = int(np.argmax(tensions))
        if tensions[segment] > limit:
            state.broken_segment, state.break_time = segment, time
            state.break_tension = float(tensions[segment])
            state.tensions[segment] = 0.0

    def _find_ends(self) -> Ends:
        """Set the ends to the positions of their bodies; return the masses and velocities.

        A body that has been placed elsewhere since the last step has its tether laid anew.
        """
        state, has_jumped = self.state, False
        ends = Ends(np.zeros((2, 3, 3)), np.zeros((2, 3)))
        for side, (end, fixed) in enumerate(zip(self._ends, self._fixed_positions, strict=True)):
            mass = None if end is None else end.mass()
            ends.masses[side] = HELD_MASS * np.eye(3) if mass is None else mass
            if end is not None:
                ends.velocities[side] = end.motion().velocity
            position = fixed if end is None else end.world_from_body.position
            node = state.positions[side * state.n_segments]
            has_jumped = has_jumped or length(position - node) > MAX_JUMP
            node[:] = position
        if has_jumped:
            self._lay(state)
        return ends

    def _place_segments(self) -> None:
        state = self.state
        self._segments.place(state.positions[: state.n_segments + 1], state.broken_segment)

    def _initial_state(self) -> TetherState:
        """Return the state at rest, between the present positions of the ends."""
        spec, n = self._spec, self._spec.n_segments
        start, end = (
            fixed if body is None else body.world_from_body.position
            for body, fixed in zip(self._ends, self._fixed_positions, strict=True)
        )
        state = TetherState(
            positions=np.tile(end, (n + 1, 1)),
            velocities=np.zeros((n + 1, 3)),
            lengths=np.full(n, spec.unit_length),
            tensions=np.zeros(n),
            planes=np.zeros((n + 1, 5)),
            n_segments=spec.segments,
            speed=0.0 if spec.winch is None else spec.winch.speed,
        )
        state.positions[0] = start
        self._lay(state)
        return state

    def _lay(self, state: TetherState) -> None:
        """Lay the tether at rest between its ends: straight or in an arc, above the ground."""
        n = state.n_segments
        positions = state.positions[: n + 1]
        start, end = positions[0].copy(), positions[n].copy()
        places = np.concatenate([[0.0], np.cumsum(state.lengths[:n])])
        positions[:] = arc_between(start, end, float(places[-1]), places / places[-1])
        state.velocities[:], state.planes[:] = 0.0, 0.0
        self._rays.prepare()
        top, radius = max(float(start[2]), float(end[2])), 0.5 * self._spec.diameter
        lift_nodes(self._rays.functions, self._are_solid, top, radius, positions)

    def _describe_line(self) -> Line:
        spec = self._spec
        area = 0.25 * math.pi * spec.diameter**2
        lowest_height = min(float(self.state.positions[:, 2].min()), self._world.surface_height)
        water = float(self._world.water_density(np.array([[0.0, 0.0, lowest_height]]))[0])
        mass = (water if spec.density is None else spec.density) * area
        if spec.weight_in_water is not None:
            mass += spec.weight_in_water / GRAVITY
        return Line(
            mass=max(mass, 1e-6),
            area=area,
            diameter=spec.diameter,
            axial_stiffness=spec.axial_stiffness,
            axial_damping=spec.axial_damping,
            bending_stiffness=spec.bending_stiffness,
            normal_drag=spec.normal_drag,
            tangential_drag=spec.tangential_drag,
            added_mass=spec.added_mass,
            contact_stiffness=spec.contact_stiffness,
            contact_damping=spec.contact_damping,
            friction=spec.friction,
        )
