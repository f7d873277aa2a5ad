"""The table of all rules about files, by the kind of file, in the order of their reports."""

from __future__ import annotations

from functools import partial

from . import benchmarks, robots
from .model import bottom, meshes, objects, places, simulated, starts, steps, thrust, vehicles
from .rule import Need, Rule
from .scene import angles, comms, forces, looks, models, names, not_simulated, shared_names, water
from .subjects import CheckedBenchmark, CheckedRobot, CheckedScene

ROBOT_RULES: tuple[Rule[CheckedRobot], ...] = (Rule(robots.mesh_files, Need.SPEC),)
"""Rules about a robot file."""

VEHICLE_NUMBERS = partial(
    vehicles.vehicle_numbers,
    of_hull={"size": vehicles.size_said},
    of_simulated={
        "buoyancy": vehicles.buoyancy_said,
        "balance": vehicles.balance_said,
        "places": vehicles.places_said,
        "strength": vehicles.strength_said,
        "inertia": vehicles.inertia_said,
        "drag": vehicles.drag_said,
        "friction": vehicles.friction_said,
        "thrust": thrust.thrust_said,
    },
)
"""Rules about one vehicle after another, by what its ``<u:accept>`` names."""
OBJECT_NUMBERS = partial(
    objects.object_numbers, checks={"places": objects.centre_said, "buoyancy": objects.volume_said}
)
"""Rules about one loose object after another, by what its ``<u:accept>`` names."""

SCENE_RULES: tuple[Rule[CheckedScene], ...] = (
    Rule(places.places_of_files, Need.DOCUMENT, in_check=False, in_runs=True),
    Rule(robots.macro_warnings, Need.DOCUMENT, in_runs=True),
    Rule(robots.robot_places, Need.SPEC),
    Rule(names.unknown_links, Need.SPEC, in_runs=True),
    Rule(names.unknown_sources, Need.SPEC, in_runs=True),
    Rule(names.shared_sources, Need.SPEC, in_runs=True),
    Rule(shared_names.shared_object_names, Need.SPEC, in_runs=True),
    Rule(shared_names.shared_part_names, Need.SPEC, in_runs=True),
    Rule(shared_names.shared_topics, Need.SPEC, in_runs=True),
    Rule(names.joint_values, Need.SPEC),
    Rule(comms.communication, Need.SPEC),
    Rule(names.lamps_beyond_the_last, Need.SPEC),
    Rule(names.passable_objects, Need.SPEC),
    Rule(names.passable_vehicles, Need.SPEC),
    Rule(names.loose_scenery, Need.SPEC),
    Rule(looks.directions, Need.SPEC),
    Rule(looks.shared_camera_names, Need.SPEC),
    Rule(looks.polished_cameras, Need.SPEC),
    Rule(angles.angles_in_degrees, Need.SPEC, in_runs=True),
    Rule(water.unstable_water, Need.SPEC),
    Rule(water.slow_currents, Need.SPEC),
    Rule(forces.forces_on_bodies, Need.SPEC, in_runs=True),
    Rule(models.projectors, Need.SPEC),
    Rule(models.model_files, Need.SPEC),
    Rule(not_simulated.not_simulated, Need.SPEC),
    Rule(partial(robots.robot_files, rules=ROBOT_RULES), Need.FILES),
    Rule(robots.unused_arguments, Need.FILES, in_check=False, in_runs=True),
    Rule(simulated.hydrodynamic_names, Need.VALID),
    Rule(simulated.object_shapes, Need.VALID),
    Rule(VEHICLE_NUMBERS, Need.MODEL, in_runs=True),
    Rule(bottom.velocity_logs, Need.MODEL, in_runs=True),
    Rule(starts.start_poses, Need.MODEL, in_runs=True),
    Rule(OBJECT_NUMBERS, Need.MODEL, in_runs=True),
    Rule(steps.thin_objects, Need.MODEL, in_runs=True),
    Rule(meshes.fixed_meshes, Need.MODEL, in_runs=True),
    Rule(simulated.missing_floors, Need.VALID),
)
"""Rules about a scene file, and about a scene that is about to run."""

BENCHMARK_RULES: tuple[Rule[CheckedBenchmark], ...] = (
    Rule(benchmarks.unknown_algorithm, Need.SPEC),
    Rule(benchmarks.names_in_scene, Need.MODEL),
    Rule(benchmarks.arm_positions, Need.MODEL),
    Rule(benchmarks.recorded_truths, Need.MODEL),
)
"""Rules about a benchmark file."""
