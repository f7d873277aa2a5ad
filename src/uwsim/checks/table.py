"""The tables of all rules, one for each kind of file, in the order in which they are applied."""

from __future__ import annotations

from functools import partial

from ..autopilots.ardupilot.frames import Frame
from . import benchmarks, robots
from .autopilot import ardupilot
from .model import (
    bottom,
    dynamics,
    file_locations,
    meshes,
    objects,
    starts,
    steps,
    thrust,
    vehicles,
    wave_lengths,
)
from .rule import Need, Rule
from .scene import (
    angles,
    ardupilot_wiring,
    comms,
    forces,
    given_motions,
    mavlink_links,
    models,
    named_bodies,
    names,
    not_simulated,
    px4_motors,
    shared_names,
    shared_ports,
    streams,
    topic_links,
    topic_types,
    unused_values,
    water,
    waves,
)
from .scene import sensor_directions as directions
from .subjects import CheckedBenchmark, CheckedRobot, CheckedScene

ROBOT_RULES: tuple[Rule[CheckedRobot], ...] = (Rule(robots.mesh_files, Need.SPEC),)
"""Rules about a robot file."""

VEHICLE_NUMBERS = partial(
    vehicles.vehicle_numbers,
    hull_checks={"size": vehicles.describe_size},
    vehicle_checks={
        "buoyancy": vehicles.describe_buoyancy,
        "balance": vehicles.describe_balance,
        "places": vehicles.describe_positions,
        "strength": vehicles.describe_strength,
        "inertia": vehicles.describe_inertia,
        "drag": vehicles.describe_drag,
        "friction": vehicles.describe_friction,
        "thrust": thrust.describe_thrust,
    },
)
"""Checks of each vehicle's numbers, by the name that suppresses them in ``<u:accept>``."""
OBJECT_NUMBERS = partial(
    objects.object_numbers,
    checks={"places": objects.describe_centre, "buoyancy": objects.describe_volume},
)
"""Checks of each loose object's numbers, by the name that suppresses them in ``<u:accept>``."""

SCENE_RULES: tuple[Rule[CheckedScene], ...] = (
    Rule(file_locations.file_locations, Need.DOCUMENT, in_check=False, in_runs=True),
    Rule(robots.macro_warnings, Need.DOCUMENT, in_runs=True),
    Rule(robots.robot_locations, Need.SPEC),
    Rule(names.unknown_links, Need.SPEC, in_runs=True),
    Rule(names.unknown_sources, Need.SPEC, in_runs=True),
    Rule(names.shared_sources, Need.SPEC, in_runs=True),
    Rule(shared_names.shared_object_names, Need.SPEC, in_runs=True),
    Rule(shared_names.shared_part_names, Need.SPEC, in_runs=True),
    Rule(shared_names.shared_topics, Need.SPEC, in_runs=True),
    Rule(names.joint_values, Need.SPEC),
    Rule(comms.communication, Need.SPEC),
    Rule(names.excess_lamps, Need.SPEC),
    Rule(names.passable_objects, Need.SPEC),
    Rule(ardupilot_wiring.check_wiring, Need.SPEC),
    Rule(px4_motors.check_motors, Need.SPEC),
    Rule(mavlink_links.check_links, Need.SPEC),
    Rule(streams.check_streams, Need.SPEC, in_runs=True),
    Rule(topic_links.check_topic_links, Need.SPEC, in_runs=True),
    Rule(shared_ports.shared_ports, Need.SPEC),
    Rule(topic_types.device_topic_types, Need.SPEC),
    Rule(names.passable_vehicles, Need.SPEC),
    Rule(names.loose_scenery, Need.SPEC),
    Rule(directions.directions, Need.SPEC),
    Rule(directions.shared_camera_names, Need.SPEC),
    Rule(directions.polished_cameras, Need.SPEC),
    Rule(angles.angles_in_degrees, Need.SPEC, in_runs=True),
    Rule(water.unstable_water, Need.SPEC),
    Rule(water.slow_currents, Need.SPEC),
    Rule(water.unused_fog, Need.SPEC, in_runs=True),
    Rule(unused_values.unused_values, Need.SPEC, in_runs=True),
    Rule(waves.flat_seas, Need.SPEC, in_runs=True),
    Rule(waves.breaking_waves, Need.SPEC, in_runs=True),
    Rule(forces.forces_on_bodies, Need.SPEC, in_runs=True),
    Rule(named_bodies.bodies_of_sensors, Need.SPEC, in_runs=True),
    Rule(given_motions.given_motions, Need.SPEC),
    Rule(models.projectors, Need.SPEC),
    Rule(models.model_files, Need.SPEC),
    Rule(not_simulated.not_simulated, Need.SPEC),
    Rule(partial(robots.robot_files, rules=ROBOT_RULES), Need.FILES),
    Rule(water.invalid_water, Need.FILES),
    Rule(given_motions.pose_tables, Need.FILES),
    Rule(robots.unused_arguments, Need.FILES, in_check=False, in_runs=True),
    Rule(dynamics.hydrodynamic_names, Need.VALID),
    Rule(dynamics.object_shapes, Need.VALID),
    Rule(VEHICLE_NUMBERS, Need.MODEL, in_runs=True),
    Rule(bottom.velocity_logs, Need.MODEL, in_runs=True),
    Rule(starts.start_poses, Need.MODEL, in_runs=True),
    Rule(wave_lengths.long_vehicles, Need.MODEL, in_runs=True),
    Rule(OBJECT_NUMBERS, Need.MODEL, in_runs=True),
    Rule(steps.thin_objects, Need.MODEL, in_runs=True),
    Rule(meshes.fixed_meshes, Need.MODEL, in_runs=True),
    Rule(dynamics.missing_floors, Need.VALID),
)
"""Rules about a scene file, and about a scene that is about to run."""


def ardupilot_rules(frame: Frame | None) -> tuple[Rule[CheckedScene], ...]:
    """Return the rules about vehicles that ArduPilot steers, which only a request applies.

    Args:
        frame: the frame of ArduSub, or the steering of ArduRover; None for the one that fits best.
    """
    return (
        Rule(ardupilot.presence, Need.MODEL),
        Rule(ardupilot.body_axes, Need.MODEL),
        Rule(partial(ardupilot.thruster_layout, frame=frame), Need.MODEL),
        Rule(ardupilot.navigation, Need.MODEL),
        Rule(ardupilot.start_depth, Need.MODEL),
        Rule(ardupilot.exchange_rate, Need.MODEL),
        Rule(ardupilot.buoyancy, Need.MODEL),
    )


BENCHMARK_RULES: tuple[Rule[CheckedBenchmark], ...] = (
    Rule(benchmarks.unknown_algorithm, Need.SPEC),
    Rule(benchmarks.names_in_scene, Need.MODEL),
    Rule(benchmarks.arm_positions, Need.MODEL),
    Rule(benchmarks.recorded_truths, Need.MODEL),
    Rule(benchmarks.breaking_levels, Need.MODEL),
    Rule(benchmarks.scene_settings, Need.MODEL),
)
"""Rules about a benchmark file."""
