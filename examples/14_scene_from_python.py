"""Build a scene and its benchmark in Python, run them, and write them as files.

A BlueROV2 is above a box in a tank. A tracker follows the box in clear water and in fog.
"""

import tempfile
from math import pi
from pathlib import Path

import uwsim


def main() -> None:
    scene = make_scene()
    benchmark = make_benchmark()
    problems = [*scene.check(), *benchmark.check(scene)]
    print("errors:", sum(problem.severity == "error" for problem in problems))
    result = uwsim.bench(benchmark, scene=scene, algorithm="esm", levels={"fog": [0.0, 0.9]})
    clear_error, foggy_error = result.values("corners")
    print(f"the error is larger in fog: {clear_error < foggy_error}")
    scene["rov/down"].resw = 160  # [px]
    with tempfile.TemporaryDirectory() as folder:
        path = scene.write(Path(folder) / "tank.xml")
        print(f"{path.name} reads back to the same scene: {uwsim.read_scene(path) == scene}")


def make_scene() -> uwsim.Scene:
    """Return a tank with a box and a vehicle whose camera looks down at it."""
    scene = uwsim.Scene()
    scene.sim_params.offsetr = (pi, 0, -pi / 2)  # the frame of the file: x north, z down
    scene.ocean_state.fog.color = (0, 0.05, 0.3)
    tank = scene.add("object", name="terrain", file="terrain/CIRS/cirs_trident.osg")
    tank.set(offsetp=(-1.5, -3, 0), offsetr=(pi, 0, -pi / 2))
    box = scene.add("object", name="box", file="objects/blackbox_uib_trimesh.osg")
    box.set(position=(2, 0.35, 4.735), orientation=(0, pi, 0))
    rov = scene.add("vehicle", name="rov", file="bluerov2_heavy.urdf", position=(2, 0.35, 3.3))
    camera = rov.add("virtualCamera", name="down", relative_to="base_link", std=0.02)
    camera.set(resw=320, resh=240, position=(0, 0, 0.15), orientation=(pi, 0, pi / 2))
    topics = {"image_topic": "/uwsim/camera1", "info_topic": "/uwsim/camera1_info"}
    scene.add("VirtualCameraToROSImage", camera_name="down", rate=30, **topics)
    return scene


def make_benchmark() -> uwsim.Benchmark:
    """Return the benchmark `visibility` for this camera and box, without the measures of a face."""
    benchmark = uwsim.read_benchmark("visibility")
    for name in ("cornersFace", "centroidFace"):
        benchmark.remove(name)
    for name in ("corners", "centroid"):
        benchmark[name].ground_truth.set(camera="down", target="box")
    benchmark.scene_updater.set(final_value=1.2, step=0.1, interval=2)
    return benchmark


if __name__ == "__main__":
    main()
