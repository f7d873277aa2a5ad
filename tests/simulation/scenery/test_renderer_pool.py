"""One renderer for several simulations: what they see must not depend on who drew before."""

from dataclasses import replace
from importlib import resources
from pathlib import Path

import numpy as np

from tests.support.opened import open_scene
from uwsim.scene.reader import read_scene
from uwsim.scene.spec import SceneSpec
from uwsim.simulation import RendererPool

SCENES = Path(str(resources.files("uwsim"))) / "data" / "scenes"


def images(scene: SceneSpec, pool: RendererPool | None) -> list[np.ndarray]:
    simulation = open_scene(scene, seed=3, pool=pool)
    camera = simulation.world.sensors.camera("bowtech1")
    exact = simulation.world.scenery.render_clean(camera.world_from_camera, camera.intrinsics)
    assert exact.colour is not None
    assert exact.range is not None
    assert exact.ids is not None
    seen = [camera.capture(), exact.colour, exact.range, exact.ids]
    simulation.close()
    return [array.copy() for array in seen]


def test_images_are_the_same_whoever_had_the_renderer_before() -> None:
    scene = read_scene(SCENES / "visibility-scene.xml")
    other = replace(read_scene(SCENES / "currents-scene.xml").nominal_scene, objects=())
    pool = RendererPool()
    images(other, pool)
    first, second = images(scene, pool), images(scene, pool)
    for ours, again, alone in zip(first, second, images(scene, None), strict=True):
        np.testing.assert_array_equal(ours, alone)
        np.testing.assert_array_equal(again, alone)
    pool.close()


def test_two_simulations_at_once_do_not_see_each_other() -> None:
    scene = read_scene(SCENES / "visibility-scene.xml")
    pool = RendererPool()
    emptier = open_scene(replace(scene, objects=scene.objects[:1]), pool=pool)
    whole = open_scene(scene, pool=pool)
    camera = emptier.world.sensors.camera("bowtech1")
    with_all = whole.world.scenery.render_clean(camera.world_from_camera, camera.intrinsics).ids
    with_one = emptier.world.scenery.render_clean(camera.world_from_camera, camera.intrinsics).ids
    assert with_all is not None
    assert with_one is not None
    assert set(np.unique(with_one)) < set(np.unique(with_all))
    for simulation in (emptier, whole):
        simulation.close()
    first, second = pool.acquire(), pool.acquire()
    assert first is not second
    for renderer in (first, second):
        pool.release(renderer)
    pool.close()


def test_a_second_simulation_in_a_studio_gets_the_same_renderer() -> None:
    pool = RendererPool()
    first = pool.acquire()
    pool.release(first)
    assert pool.acquire() is first
    first.close()
