"""Arm positions of a benchmark that the arm in its scene cannot take, each with its line."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from ..errors import Fault
from ..scene.urdf import RobotSpec
from ..schema import Faults, parse
from .spec import BenchmarkSpec
from .updaters import ArmMoveUpdaterSpec, chain


def arm_notices(
    benchmark: BenchmarkSpec, vehicles: Sequence[str], robots: Mapping[int, RobotSpec]
) -> list[Fault]:
    """Say which joints are not there, and which are held at their limits.

    Args:
        benchmark: what was read from the file without a fault.
        vehicles: names of the scene's vehicles.
        robots: their robots, by number of the vehicle.
    """
    faults = Faults(benchmark.path)
    nodes = parse(Path(benchmark.path)).root.iter("armMoveUpdater")
    specs = [s for s in chain(benchmark.scene_updater) if isinstance(s, ArmMoveUpdaterSpec)]
    for spec, node in zip(specs, nodes, strict=True):
        if spec.target not in vehicles:
            continue
        joints = robots[vehicles.index(spec.target)].movable
        for given, place in zip(spec.arm_position, node.iterfind("armPosition"), strict=True):
            if len(given) > len(joints):
                faults.notice(
                    place,
                    f"<armPosition> has {len(given)} values for {len(joints)} joints "
                    f"({', '.join(joint.name for joint in joints)}); the rest is not used",
                )
            for joint, value, at in zip(joints, given, place.iterfind("joint"), strict=False):
                held = min(max(value, joint.lower), joint.upper)
                if held != value:
                    said = f"joint {joint.name!r} at {value:g} is held at its limit {held:g}"
                    faults.notice(at, said)
    return faults.all()
