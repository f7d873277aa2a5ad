"""Films: what is seen is what was, chapters and size are those asked for, twice the same bytes."""

import re
import shutil
import subprocess
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory
from PIL import Image

import uwsim
from tests.simulation.test_lamp import LAMP, night
from tests.support.stored_rows import stored_row
from uwsim.assets.find import find
from uwsim.base.geometry import Intrinsics, Pose
from uwsim.cli import main
from uwsim.rendering.grey import grey_truncated
from uwsim.rendering.physical.moving_surface import MovingSurface
from uwsim.results.journal import recorded_trials, track_path
from uwsim.results.motion import Signal
from uwsim.scene.reader import read_scene
from uwsim.simulation.tracked_state import TrackedState
from uwsim.simulation.views import find_focus
from uwsim.viewer.film.curves import select_curves, short_name
from uwsim.viewer.film.film import Film, FilmSpec, save_film
from uwsim.viewer.film.trial_scene import TrialScene
from uwsim.viewer.recorded import Curve, RecordedLevel, RecordedTrial, _level


@pytest.fixture
def small(trial: RecordedTrial) -> Iterator[Film]:
    film = Film(trial, FilmSpec(size=(240, 180)))
    yield film
    film.close()


def test_a_recorded_trial_has_its_levels_and_the_samples_of_its_measures(
    result: Path, trial: RecordedTrial
) -> None:
    assert recorded_trials(result) == (0,)
    assert trial.title == "short, esm, seed 3"
    assert [level.label for level in trial.levels] == ["fog 0", "fog 0.4", "fog 0.8"]
    curve = trial.levels[1].curves[0]
    assert (curve.measure, curve.unit) == ("corners", "px")
    assert curve.times[0] == pytest.approx(trial.levels[1].start_time, abs=0.051)


def test_lamps_are_as_bright_as_they_were(trial: RecordedTrial) -> None:
    track, brightness = trial.track, np.linspace(0.0, 1.0, trial.track.n_frames)
    dimmed = replace(
        track,
        signals=(*track.signals, Signal(name="lamp/headlight", step=0.01)),
        values=np.column_stack([track.values, brightness]),
    )
    scene = TrialScene(replace(trial, scene=night(LAMP), track=dimmed))
    (lamp,) = scene.simulation.world.scenery.mounted_lamps
    for frame in (0, 5, track.n_frames - 1):
        scene.show_time((frame + 0.01) / track.rate)
        assert lamp.intensity == pytest.approx(brightness[frame] * LAMP.intensity)
    scene.close()


def test_physical_water_is_as_turbid_as_it_was(trial: RecordedTrial) -> None:
    track, levels = trial.track, np.linspace(0.5, 2.0, trial.track.n_frames)
    signals = (Signal(name="beam_attenuation"), Signal(name="exposure_level", step=0.001))
    turbid = replace(
        track,
        signals=(*track.signals, *signals),
        values=np.column_stack([track.values, levels, levels - 1.0]),
    )
    path = find("visibility-physical-scene.xml")
    assert path is not None
    scene = TrialScene(replace(trial, scene=read_scene(path), track=turbid))
    for frame in (0, 5, track.n_frames - 1):
        scene.show_time((frame + 0.01) / track.rate)
        water = scene.simulation.world.scenery.state.water.physical_water
        assert water is not None
        assert water.beam_attenuation == pytest.approx((levels[frame],) * 3)
        assert water.exposure == pytest.approx(2.0 ** (levels[frame] - 1.0))
        assert water.medium.single_scattering_albedo == pytest.approx(0.85)
    scene.close()


def test_waves_are_those_of_the_time_and_the_sea_state(
    trial: RecordedTrial, tmp_path: Path
) -> None:
    track = trial.track
    heights = np.linspace(0.5, 2.0, track.n_frames)
    drift = np.column_stack([heights, np.zeros((track.n_frames, 2))])
    signals = (
        Signal(name="wave_scale"),
        *(Signal(name=f"particles/{axis}") for axis in "xyz"),
        *(Signal(name=f"particle_velocity/{axis}") for axis in "xyz"),
    )
    recorded = replace(
        track,
        signals=(*track.signals, *signals),
        values=np.column_stack([track.values, heights, drift, np.ones((track.n_frames, 3))]),
    )
    path = find("pier-waves-scene.xml")
    assert path is not None
    snow = (
        "<u:particles><u:marineSnow><u:concentration>10</u:concentration></u:marineSnow>"
        "</u:particles></u:water>"
    )
    file = tmp_path / "sea.xml"
    file.write_text(path.read_text().replace("</u:water>", snow))
    scene = TrialScene(replace(trial, scene=read_scene(file), track=recorded))
    scenery = scene.simulation.world.scenery
    pose, intrinsics = (
        Pose(np.array([30.0, 0.0, 4.0]), np.eye(3)),
        Intrinsics.from_fovy(64, 48, 1.0),
    )
    images = []
    for frame in (0, 5):
        time = (frame + 0.5) / track.rate
        scene.show_time(time)
        assert scenery.particles is not None
        displacement = scenery.particles.find_drift().displacement
        assert displacement == pytest.approx(
            (heights[frame] + 0.5 / track.rate, *(0.5 / track.rate,) * 2)
        )
        images.append(scenery.render_view(pose, intrinsics, targets={"colour"}).colour)
        surface = MovingSurface(
            time=time,
            waves=scene.simulation.world.water.waves,
            wave_scale=float(heights[frame]),
            seed=trial.seed,
        )
        scenery.set_surface(lambda surface=surface: surface)  # type: ignore[misc]
        expected = scenery.render_view(pose, intrinsics, targets={"colour"}).colour
        assert np.array_equal(images[-1], expected)
    assert not np.array_equal(images[0], images[1])
    scene.close()


def test_the_motion_of_physical_water_has_attenuation_and_exposure() -> None:
    with uwsim.load("visibility-physical-scene") as simulation:
        state = TrackedState(simulation.world)
        values = dict(
            zip([s.name for s in state.signals], state.row()[-len(state.signals) :], strict=True)
        )
        assert values["beam_attenuation"] == pytest.approx(0.4)
        water = simulation.world.scenery.state.water.physical_water
        assert water is not None
        assert 2.0 ** values["exposure_level"] == pytest.approx(water.exposure)


def level_with(*curves: Curve, details: tuple[Curve, ...] = ()) -> RecordedLevel:
    return RecordedLevel(
        label="",
        status="ok",
        reason="",
        start_time=0.0,
        end_time=1.0,
        values={},
        curves=curves,
        details=details,
    )


def curve(name: str, value: float = 1.0) -> Curve:
    return Curve(measure=name, unit="m", times=np.zeros(1), values=np.full(1, value))


def test_the_further_columns_of_a_log_are_curves_with_their_units(trial: RecordedTrial) -> None:
    row = stored_row(
        measures={"success": (1.0, "1")},
        logs={"success": [[0.0, 0.0, 0.1, None], [0.5, 1.0, 0.3, 2.0]]},
        log_headers={"success": ("value", "height [m]", "phase [1]")},
    )
    level = _level(row, replace(trial.track.levels[0], start_time=2.0))
    assert [(one.measure, one.unit) for one in level.details] == [
        ("success.height", "m"),
        ("success.phase", "1"),
    ]
    height, phase = level.details
    assert height.times.tolist() == [2.0, 2.5]
    assert height.values.tolist() == [0.1, 0.3]
    assert np.isnan(phase.values[0])
    assert phase.values[1] == 2.0


def test_a_measure_alone_is_drawn_with_the_further_columns_of_its_log() -> None:
    details = (curve("a.x"), curve("a.nothing", np.nan), curve("a.y"))
    alone, two = level_with(curve("a"), details=details), level_with(curve("a"), curve("b"))
    assert [one.measure for one in select_curves(alone, ())] == ["a", "a.x", "a.y"]
    assert [one.measure for one in select_curves(two, ())] == ["a", "b"]
    assert [one.measure for one in select_curves(alone, ("a.y", "a"))] == ["a.y", "a"]


@pytest.mark.parametrize("size", [(480, 360), (640, 480), (360, 480)])
@pytest.mark.parametrize("view", ["orbit", "camera"])
def test_title_curves_and_inset_hide_nothing_of_the_view(
    trial: RecordedTrial, size: tuple[int, int], view: str
) -> None:
    film = Film(trial, FilmSpec(size=size, view=view))  # type: ignore[arg-type]
    try:
        frame = film.draw(0.5)
        seen = film._view_image(0.5)
        height, width = seen.shape[:2]
        top = int(film._head_height)
        assert width == size[0]
        assert height > 0.5 * size[1]
        assert np.array_equal(frame[top : top + height], seen)
        if view == "orbit":
            corners = film._path.pose(0.5).inverse().transform(film_corners(film))
            rows = film._path.intrinsics.project(corners)[:, 1]
            assert 0.0 < rows.min() < rows.max() < height
    finally:
        film.close()


def film_corners(film: Film) -> np.ndarray[Any, Any]:
    """Corners of what the view is about, in W, (8, 3)."""
    return np.asarray(find_focus(film._scene.simulation).corners)


def test_curves_of_one_measure_are_named_without_it() -> None:
    details = [curve("success.height"), curve("success.phase")]
    assert short_name("success.height", [curve("success"), *details]) == "height"
    assert short_name("success", [curve("success"), *details]) == "success"
    assert short_name("success.height", [curve("time"), *details]) == "success.height"


def test_bodies_are_put_where_they_were_and_cameras_go_with_them(trial: RecordedTrial) -> None:
    number = trial.track.bodies.index("girona500/base_link")
    poses = trial.track.poses.copy()
    poses[30:, number, 0] += 1.0
    scene = TrialScene(replace(trial, track=replace(trial.track, poses=poses)))
    try:
        world = scene.simulation.world
        scene.show_time(0.7)
        np.testing.assert_allclose(world.engine.poses.vehicle(0).position, poses[21, number, :3])
        assert world.scenery.state.water.fog == pytest.approx(0.4)
        before = world.sensors.camera("bowtech1").world_from_camera.position
        scene.show_time(1.0)
        now = world.sensors.camera("bowtech1").world_from_camera.position
        np.testing.assert_allclose(now - before, [1.0, 0.0, 0.0], atol=1e-3)
    finally:
        scene.close()


def test_levels_are_chapters(small: Film) -> None:
    assert [(c.title, round(c.start, 3), round(c.end, 3)) for c in small.chapters()] == [
        ("fog 0", 0.0, 0.4),
        ("fog 0.4", 0.4, 0.8),
        ("fog 0.8", 0.8, 1.2),
    ]


def test_the_inset_is_the_image_of_the_camera(small: Film, trial: RecordedTrial) -> None:
    frame = small.draw(0.6)
    assert frame.shape == (180, 240, 3)
    assert small._inset_size is not None
    width, height = small._inset_size
    top = small._strip_top + 12
    inset = frame[top : top + height, 240 - width - 12 : 240 - 12]
    scene = TrialScene(trial)
    try:
        scene.show_time(0.6)
        camera = scene.simulation.world.sensors.camera("bowtech1")
        lens = camera.intrinsics.with_size(width, height)
        seen = scene.simulation.world.scenery.render_clean(camera.world_from_camera, lens)
        assert seen.colour is not None
        off = np.abs(inset.astype(int) - seen.colour.astype(int)).max(axis=2) > 2
        assert off.mean() < 0.25  # the corners that are drawn into it
    finally:
        scene.close()


def test_a_grey_camera_is_grey_in_the_inset_and_as_the_view(
    small: Film, trial: RecordedTrial, monkeypatch: pytest.MonkeyPatch
) -> None:
    camera = small._scene.simulation.world.sensors.camera("bowtech1")
    coloured = small._camera_image("bowtech1", (72, 54), 0.6)
    monkeypatch.setattr(camera, "is_grey", True)
    grey = small._camera_image("bowtech1", (72, 54), 0.6)
    plain = (grey[..., 0] == grey[..., 1]) & (grey[..., 1] == grey[..., 2])
    assert plain.mean() > 0.8  # all but the quadrangles of truth and estimate
    expected = grey_truncated(np.ascontiguousarray(coloured))
    np.testing.assert_array_equal(grey[plain][:, 0], expected[plain])
    assert (coloured.max(axis=2) != coloured.min(axis=2)).mean() > 0.5


@pytest.mark.parametrize("view", ["chase", "fixed", "camera"])
def test_every_view_shows_something(trial: RecordedTrial, view: str) -> None:
    film = Film(trial, FilmSpec(size=(160, 160), view=view, inset=False, has_curves=False))  # type: ignore[arg-type]
    try:
        assert film.draw(0.5)[40:120].std() > 10.0
    finally:
        film.close()


def test_a_smooth_view_is_the_mean_of_a_larger_one(trial: RecordedTrial) -> None:
    plain = {"inset": False, "has_curves": False, "view": "fixed"}
    frames = []
    for size, samples in (((160, 496), 2), ((320, 992), 1)):  # letters of 11 and 22 pixels
        film = Film(trial, FilmSpec(size=size, samples=samples, **plain))  # type: ignore[arg-type]
        frames.append(film.draw(0.5).astype(float))
        film.close()
    means = frames[1].reshape(496, 2, 160, 2, 3).mean(axis=(1, 3))
    rows = slice(40, 480)  # without what is written over it
    off = np.abs(frames[0][rows] - means[rows]).max(axis=2)
    assert (off > 1.0).mean() < 0.01  # pixels at edges


@pytest.mark.slow
def test_a_webp_is_written_twice_with_the_same_bytes(
    result: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    one, two = tmp_path / "one.webp", tmp_path / "two.webp"
    options = ["--size", "160x160", "--fps", "5"]
    for out in (one, two):
        assert main(["replay", str(result), "-o", str(out), *options]) == 0
    assert "6 images, 1.2 s, 160x160; written: " in capsys.readouterr().out
    assert one.read_bytes() == two.read_bytes()
    with Image.open(one) as image:
        assert (image.n_frames, image.size) == (6, (160, 160))  # type: ignore[attr-defined]
    assert main(["replay", str(result), "-o", str(one)]) == 2
    assert "exists; --overwrite replaces it" in capsys.readouterr().err


@pytest.mark.parametrize("suffix", [".mp4", pytest.param(".webm", marks=pytest.mark.slow)])
def test_a_film_has_its_frames_its_chapters_and_the_same_bytes_twice(
    trial: RecordedTrial, tmp_path: Path, suffix: str
) -> None:
    ffmpeg = pytest.importorskip("imageio_ffmpeg", reason="the extra film").get_ffmpeg_exe()
    paths = [tmp_path / f"{name}{suffix}" for name in ("one", "two")]
    for path in paths:
        film = Film(trial, FilmSpec(size=(160, 160), rate=10.0))
        save_film(film, path)
        film.close()
    assert paths[0].read_bytes() == paths[1].read_bytes()
    command = [ffmpeg, "-i", str(paths[0]), "-map", "0:v", "-f", "null", "-stats", "-"]
    said = subprocess.run(command, capture_output=True, text=True, timeout=120).stderr
    assert re.search(r"frame= *12\b", said)
    assert said.partition("Output #0")[0].count("Chapter #") == 3
    assert "fog 0.8" in said
    assert sorted(path.name for path in tmp_path.iterdir()) == [f"one{suffix}", f"two{suffix}"]


@pytest.mark.parametrize("suffix", [".mp4", ".webm", ".webp"])
@pytest.mark.parametrize("n_drawn", [0, 1, 6])
def test_an_interrupted_film_keeps_its_finished_part(
    trial: RecordedTrial, tmp_path: Path, suffix: str, n_drawn: int
) -> None:
    ffmpeg = pytest.importorskip("imageio_ffmpeg", reason="the extra film").get_ffmpeg_exe()
    path = tmp_path / f"film{suffix}"
    film = Film(trial, FilmSpec(size=(160, 160), rate=10.0))
    drawn = 0

    def interrupt() -> None:
        nonlocal drawn
        drawn += 1
        if drawn > n_drawn:
            raise KeyboardInterrupt

    film.draw, draw = lambda time: (interrupt(), draw(time))[1], film.draw  # type: ignore[method-assign]
    with pytest.raises(KeyboardInterrupt):
        save_film(film, path)
    film.close()
    assert [each.name for each in tmp_path.iterdir()] == ([path.name] if n_drawn else [])
    if not n_drawn:
        return
    if suffix == ".webp":
        with Image.open(path) as image:
            assert getattr(image, "n_frames", 1) == n_drawn
        return
    command = [ffmpeg, "-i", str(path), "-map", "0:v", "-f", "null", "-stats", "-"]
    report = subprocess.run(command, capture_output=True, text=True, timeout=120).stderr
    assert re.search(rf"frame= *{n_drawn}\b", report)
    n_chapters = 1 if n_drawn < 5 else 2  # a level has four images
    assert report.partition("Output #0")[0].count("Chapter #") == n_chapters


def test_what_cannot_be_filmed_is_said_in_a_line(
    result: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = str(tmp_path / "x.webp")
    for arguments, said in [
        (["-o", str(tmp_path / "x.avi")], "expected one of .mp4, .webm, .webp, .html, .mcap"),
        (["-o", out, "--trial", "7"], "no motion of trial 7; expected one of 0"),
        (["-o", out, "--view", "orbitt"], "Did you mean 'orbit'?"),
        (["-o", out, "--size", "161x160"], "expected even numbers"),
        (["-o", out, "--size", "16000x160"], "from 160 to 7680"),
        (["-o", out, "--begin", "9"], "has no image from 9 s"),
        (["-o", out, "--curve", "corner"], "Did you mean 'corners'?"),
        (["-o", out, "--camera", "bowtech"], "No virtual camera is called 'bowtech'"),
    ]:
        assert main(["replay", str(result), *arguments]) == 2
        error = capsys.readouterr().err
        assert said in error
        assert error.count("\n") == 1
    old = tmp_path / "old"
    shutil.copytree(result, old)
    track_path(old, 0).unlink()
    assert main(["replay", str(old), "-o", out]) == 2
    assert "has no motion" in capsys.readouterr().err
    assert not Path(out).exists()


def test_a_recording_for_3d_panels_has_frames_shapes_and_measures(
    result: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    one, two = tmp_path / "one.mcap", tmp_path / "two.mcap"
    for out in (one, two):
        assert main(["replay", str(result), "-o", str(out)]) == 0
    assert one.read_bytes() == two.read_bytes()
    assert main(["replay", str(result), "-o", str(one)]) == 2
    assert "exists; --overwrite replaces it" in capsys.readouterr().err
    found: dict[str, list[Any]] = {}
    with one.open("rb") as stream:
        reader = make_reader(stream, decoder_factories=[DecoderFactory()])
        for _, channel, _, message in reader.iter_decoded_messages():
            found.setdefault(channel.topic, []).append(message)
    assert len(found["/tf"]) == 37  # 1.2 s at 30 Hz
    frames = {each.child_frame_id for each in found["/tf"][0].transforms}
    assert "girona500/base_link" in frames
    (scene,) = found["/scene"]
    assert {each.header.frame_id for each in scene.markers} <= {*frames, "world"}
    assert all(len(each.points) % 3 == 0 and each.points for each in scene.markers)
    assert [each.data for each in found["/level"]] == ["fog 0", "fog 0.4", "fog 0.8"]
    assert "<robot" in found["/robot_description"][0].data
    assert found["/measures/corners"]
