import cv2
import numpy as np
import pytest

from scripts.models.stand_ins.blackbox import face
from uwsim.assets import load_model
from uwsim.rendering.water import AMBIENT_SHARE, SUN_COLOURS, SUN_DIRECTIONS


def seen_from_above() -> np.ndarray:
    """Grey levels of the top face as the camera of `visibility` has them, without GPU, (26, 86)."""
    sun = np.array(SUN_DIRECTIONS["clear"])
    light = AMBIENT_SHARE + SUN_COLOURS["clear"][0] * sun[2] / np.linalg.norm(sun)
    small = cv2.resize(face().pixels.astype(np.float32), (86, 26), interpolation=cv2.INTER_AREA)
    grey: np.ndarray = small @ np.array([0.299, 0.587, 0.114]) * light
    return grey


def test_the_top_face_has_the_contrast_that_the_benchmark_asks_for() -> None:
    assert 25.0 < seen_from_above().std() < 30.0


def test_a_tracker_finds_slopes_in_both_directions() -> None:
    grey = seen_from_above()
    across, down = np.gradient(grey, axis=1).std(), np.gradient(grey, axis=0).std()
    assert across > 5.0
    assert down > 5.0
    assert 0.4 < across / down < 2.5


def test_the_markings_do_not_repeat() -> None:
    grey = seen_from_above()
    grey = (grey - grey.mean()) / grey.std()
    for shift in range(6, 80):
        left, right = grey[:, :-shift], grey[:, shift:]
        if left.shape[1] > 25:
            assert (left * right).mean() < 0.6


@pytest.mark.parametrize("name", ["blackbox_uib_trimesh", "blackbox", "blackbox_standard"])
def test_the_marked_faces_look_up_and_down(name: str) -> None:
    model = load_model(f"objects/{name}.osg")
    marked = next(m for m in model.meshes if m.texture is not None and "face" in m.texture.name)
    assert sorted(set(marked.normals[:, 2].round(6).tolist())) == [-1.0, 1.0]
    across = marked.vertices[:, :2]
    body = model.meshes[0].vertices[:, :2]
    assert np.ptp(across, axis=0) == pytest.approx(np.ptp(body, axis=0))


def test_the_standard_box_has_a_handle_to_grasp() -> None:
    box = load_model("objects/blackbox_standard.osg")
    handle = box.meshes[-1].vertices
    assert handle[:, 2].max() == pytest.approx(0.07 + 0.05 + 0.016, abs=2e-3)
    assert np.ptp(handle[:, 1]) == pytest.approx(0.12 + 0.016, abs=2e-3)
    middle = handle[(np.abs(handle[:, 1]) < 0.055) & (handle[:, 2] > 0.11)]
    assert len(middle) > 0
    assert np.ptp(handle[handle[:, 2] > 0.119][:, 0]) == pytest.approx(0.016, abs=2e-3)
    assert box.box.upper[1] == pytest.approx(0.16)
