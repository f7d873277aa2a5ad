"""Build a scene and a benchmark in Python, run it, and plot its score over the fog.

python examples/scene_from_python_figure.py docs/images/scene-from-python.png       half a minute
"""

import sys
from math import pi
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import uwsim


def build_scene() -> uwsim.Scene:
    """Return a tank with a vehicle that looks down at a black box on its floor."""
    scene = uwsim.Scene()
    scene.sim_params.offsetr = (pi, 0, -pi / 2)  # the frame of the tank: x north, z down
    scene.ocean_state.fog.color = (0, 0.05, 0.3)
    scene.add("object", name="terrain", file="terrain/CIRS/cirs_trident.osg")
    scene["terrain"].set(offsetp=(-1.5, -3, 0), offsetr=(pi, 0, -pi / 2))
    scene.add("object", name="box", file="objects/blackbox_uib_trimesh.osg")
    scene["box"].set(position=(2, 0.35, 4.735), orientation=(0, pi, 0))
    vehicle = scene.add("vehicle", name="rov", file="bluerov2_heavy.urdf")
    vehicle.set(position=(2, 0.35, 3.3))
    camera = vehicle.add("virtualCamera", name="down", relative_to="base_link")
    camera.set(resw=320, resh=240, std=0.02, position=(0, 0, 0.15), orientation=(pi, 0, pi / 2))
    scene.add(
        "VirtualCameraToROSImage",
        camera_name="down",
        image_topic="/uwsim/camera1",
        info_topic="/uwsim/camera1_info",
        rate=30,
    )
    return scene


def build_benchmark() -> uwsim.Benchmark:
    """Return a benchmark of a tracker of the box, whose levels are densities of fog."""
    benchmark = uwsim.read_benchmark("visibility")  # the tracker's topics are those of the file
    benchmark.remove("cornersFace")
    benchmark.remove("centroidFace")
    for name in ("corners", "centroid"):
        benchmark[name].ground_truth.set(camera="down", target="box")
    benchmark.scene_updater.set(final_value=1.2, step=0.1, interval=2)
    return benchmark


def plot(result: uwsim.Result, path: Path) -> None:
    """Plot the corner error at each density of fog: its mean and standard deviation."""
    names = [column.name for column in result.columns]
    rows = [dict(zip(names, row, strict=True)) for row in result.rows]
    figure, axes = plt.subplots(figsize=(6.4, 3.2), layout="constrained")
    fog, means, deviations = (
        np.array([row[name] for row in rows]) for name in ("fog", "corners", "corners.std")
    )
    axes.fill_between(fog, means - deviations, means + deviations, color="#1b6ca8", alpha=0.2)
    axes.plot(fog, means, "o-", color="#1b6ca8")
    axes.set(xlabel="fog density [1/m]", ylabel="corner error [px]", ylim=(0, None))
    axes.grid(alpha=0.3)
    figure.savefig(path, dpi=150)


if __name__ == "__main__":
    scene, benchmark = build_scene(), build_benchmark()
    for diagnostic in (*scene.check(), *benchmark.check(scene)):
        print(diagnostic)
    plot(uwsim.bench(benchmark, scene=scene, algorithm="esm"), Path(sys.argv[1]))
