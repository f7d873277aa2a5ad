"""Fog over a recording: when which image comes, and what the fog does to it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tests.support.bags import IMAGE, INFO, KINDS, sample_pixels, write_bag
from tests.support.fakes import FakeWorld
from tests.support.short_trial import make_plan, rows_of, tank
from uwsim.base.compatibility import COMPATIBILITY
from uwsim.benchmark.ground_truth import TopicTruthSpec
from uwsim.benchmark.measures import EuclideanNorm, EuclideanNormSpec
from uwsim.benchmark.recorded_truth import RecordedTruthSpec
from uwsim.benchmark.updaters import BagFogUpdaterSpec
from uwsim.benchmark.updaters.bag_fog_updater import BagFogUpdater, add_fog
from uwsim.bus import Node
from uwsim.cli import main
from uwsim.errors import AssetError, AssetNotFound, BadSetting, RunFailed, UnknownName
from uwsim.messages import CameraInfo, Float32MultiArray, Image, image, pixels_of, seconds
from uwsim.messages.bag_camera import RecordedFrame
from uwsim.middleware.recording.mcap_file import McapFile
from uwsim.middleware.types import wire_type
from uwsim.rendering.water import Water, apply_water
from uwsim.runs.planning.plan import Plan
from uwsim.runs.trial.level_row import TrialEnd
from uwsim.runs.trial.trial import execute

TIMES = (0.0, 0.1, 0.25)
COLOUR = (0.1, 0.4, 0.7)
DEPTH = 2.0


def spec(folder: Path, **other: object) -> BagFogUpdaterSpec:
    values = {
        "initial_value": 0.0, "final_value": 0.5, "step": 0.5, "interval": 1.0, "bag": "dive.bag",
        "image_topic": IMAGE, "info_topic": INFO, "image_depth": DEPTH,
        "path": str(folder / "b.xml"),
    }  # fmt: skip
    return BagFogUpdaterSpec(**(values | other))  # type: ignore[arg-type]


def images(encoding: str = "rgb8") -> list[tuple[float, np.ndarray]]:
    return [(time, sample_pixels(40 * i, encoding)) for i, time in enumerate(TIMES)]


class Screen:
    """What came on a topic of images, and when."""

    def __init__(self, world: FakeWorld, topic: str = IMAGE) -> None:
        self._world = world
        self.seen: list[tuple[float, Image]] = []
        world.bus.subscribe(topic, Image, lambda said: self.seen.append((world.time, said)))

    @property
    def times(self) -> list[float]:
        return [round(time, 6) for time, _ in self.seen]

    def pixels(self, index: int) -> np.ndarray:
        return pixels_of(self.seen[index][1])


def expected(pixels: np.ndarray, fog: float, colour: tuple[float, ...] = COLOUR) -> np.ndarray:
    """The law of the docstring, value by value."""
    seen = np.exp(-((fog * DEPTH) ** 2))
    end = 255.0 * (np.array(colour) if pixels.ndim == 3 else np.dot(colour, [0.299, 0.587, 0.114]))
    return np.rint(pixels * seen + end * (1.0 - seen)).astype(np.uint8)


def world(**other: object) -> FakeWorld:
    made = FakeWorld(**other)  # type: ignore[arg-type]
    made.fog_colour = COLOUR
    return made


@pytest.fixture
def begun(tmp_path: Path) -> tuple[FakeWorld, Screen, BagFogUpdater]:
    write_bag(tmp_path, "ros1", images())
    stage = world(timestep=0.01)
    updater = spec(tmp_path).bind(stage)
    screen = Screen(stage)
    updater.ramp(0.0)
    updater.apply(0.0)
    yield stage, screen, updater
    updater.close()


def test_images_come_with_the_recorded_spacing_round_after_round(
    begun: tuple[FakeWorld, Screen, BagFogUpdater],
) -> None:
    stage, screen, _ = begun
    stage.advance(100)
    # a round of 0.25 s and the mean spacing, 0.125 s; what was due at 0 comes at the first step
    assert screen.times == [0.01, 0.1, 0.25, 0.38, 0.48, 0.63, 0.75, 0.85, 1.0]
    for i in range(9):
        assert np.array_equal(screen.pixels(i), sample_pixels(40 * (i % 3)))


def test_images_are_stamped_with_the_time_of_publishing_and_info_goes_with_them(
    begun: tuple[FakeWorld, Screen, BagFogUpdater],
) -> None:
    stage, screen, _ = begun
    infos: list[CameraInfo] = []
    stage.bus.subscribe(INFO, CameraInfo, infos.append)
    stage.advance(30)
    assert [seconds(image.header.stamp) for _, image in screen.seen] == pytest.approx(screen.times)
    assert [info.header for info in infos] == [image.header for _, image in screen.seen]
    assert {image.header.frame_id for _, image in screen.seen} == {"bow"}
    assert [info.k[0] for info in infos] == [0.0, 0.0, 0.1]


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("encoding", ["rgb8", "bgr8", "mono8"])
@pytest.mark.parametrize("fog", [0.0, 0.2, 0.5, 3.0])
def test_every_pixel_follows_the_law_of_fog(
    tmp_path: Path, kind: str, encoding: str, fog: float
) -> None:
    path = write_bag(tmp_path, kind, images(encoding), encoding=encoding)
    stage = world(timestep=0.05)
    updater = spec(tmp_path, bag=path.name, initial_value=fog, final_value=fog).bind(stage)
    screen = Screen(stage)
    updater.ramp(fog)
    updater.apply(fog)
    stage.advance(6)
    updater.close()
    order = slice(None, None, -1) if encoding == "bgr8" else slice(None)
    for i, (_, stored) in enumerate(images(encoding)):
        red_first = stored if stored.ndim == 2 else stored[..., order]
        assert np.array_equal(screen.pixels(i), expected(red_first, fog))
        assert screen.seen[i][1].encoding == ("mono8" if stored.ndim == 2 else "rgb8")


def test_the_law_is_that_of_the_renderer() -> None:
    dark = (0.0, 0.0, 0.0)
    water = Water(fog=0.4, fog_colour=COLOUR, colour=dark, attenuation=dark)
    pixels = sample_pixels(3)
    shape = pixels.shape[:2]
    drawn = apply_water(pixels / 255.0, np.full(shape, DEPTH), np.zeros(shape), water)
    seen = float(np.exp(-((0.4 * DEPTH) ** 2)))
    assert add_fog(pixels, seen, COLOUR) == pytest.approx(255.0 * drawn, abs=0.5001)


@pytest.mark.parametrize("encoding", ["rgb8", "bgr8", "mono8"])
def test_the_originals_fog_comes_back_by_name(tmp_path: Path, encoding: str) -> None:
    assert "bag-fog" in COMPATIBILITY
    write_bag(tmp_path, "ros1", images(encoding), encoding=encoding)
    stage = world(timestep=0.05, compatibility=frozenset({"bag-fog"}))
    updater = spec(tmp_path, initial_value=0.3, final_value=0.3).bind(stage)
    screen = Screen(stage)
    updater.apply(0.3)
    stage.advance()
    updater.close()
    stored = sample_pixels(0, encoding)
    if encoding == "mono8":
        assert np.array_equal(screen.pixels(0), stored)
        return
    k = np.exp(-1.442695 * (0.3 * DEPTH) ** 2)
    fog = np.array([0.0, 0.05, 0.3]) * 255  # on channels 0, 1, 2 as they are stored
    law = np.rint(stored * k + (1 - k) * fog).astype(np.uint8)
    assert np.array_equal(screen.pixels(0), law[..., ::-1] if encoding == "bgr8" else law)


def test_the_first_image_stands_until_the_benchmark_has_begun(tmp_path: Path) -> None:
    write_bag(tmp_path, "ros1", images())
    stage = world(timestep=0.01)
    updater = spec(tmp_path).bind(stage)
    screen = Screen(stage)
    updater.ramp(0.0)
    stage.advance(31)
    updater.ramp(0.25)
    stage.advance(13)
    updater.apply(0.5)
    stage.advance(12)
    updater.close()
    assert screen.times == [0.01, 0.11, 0.21, 0.31, 0.41, 0.45, 0.54]
    first = sample_pixels(0)
    for index, fog in ((3, 0.0), (4, 0.25), (5, 0.5)):
        assert np.array_equal(screen.pixels(index), expected(first, fog))
    assert np.array_equal(screen.pixels(6), expected(sample_pixels(40), 0.5))


def test_a_length_may_stand_for_the_density(tmp_path: Path) -> None:
    write_bag(tmp_path, "ros1", images())
    stage = world(timestep=0.05)
    updater = spec(
        tmp_path, quantity="attenuationLength", initial_value=4.0, final_value=2.0, step=-2.0
    ).bind(stage)
    screen = Screen(stage)
    updater.ramp(4.0)
    stage.advance()
    updater.apply(2.0)
    stage.advance()
    updater.close()
    assert np.array_equal(screen.pixels(0), expected(sample_pixels(0), 1 / 4.0))
    assert np.array_equal(screen.pixels(1), expected(sample_pixels(0), 1 / 2.0))


def test_what_nobody_reads_is_not_decoded(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write_bag(tmp_path, "ros1", images())
    stage = world(timestep=0.01)
    updater = spec(tmp_path).bind(stage)
    updater.ramp(0.0)
    updater.apply(0.0)
    monkeypatch.setattr(RecordedFrame, "decode", None)
    stage.advance(20)
    assert updater.streams[0][1] == 0
    updater.close()


def test_a_recording_that_breaks_in_the_middle_is_a_failed_run(tmp_path: Path) -> None:
    frames = [(0.0, sample_pixels(0)), (0.1, sample_pixels(1)), (0.2, sample_pixels(2, "mono8"))]
    write_bag(tmp_path, "ros1", frames)
    stage = world(timestep=0.01)
    updater = spec(tmp_path).bind(stage)
    Screen(stage)
    updater.ramp(0.0)
    updater.apply(0.0)
    with pytest.raises(RunFailed, match=r"The recording broke off: Image 3 of .* and 20 bytes"):
        stage.advance(30)
    updater.close()


def test_what_is_missing_is_found_when_it_is_bound(tmp_path: Path) -> None:
    stage = world()
    with pytest.raises(AssetNotFound, match=r"'dive\.bag' is not next to"):
        spec(tmp_path).bind(stage)
    write_bag(tmp_path, "ros1", images())
    with pytest.raises(UnknownName, match="Did you mean '/camera/image_raw'"):
        spec(tmp_path, image_topic="/camera/image").bind(stage)
    with pytest.raises(AssetError, match="carries sensor_msgs/msg/CameraInfo"):
        spec(tmp_path, image_topic=INFO).bind(stage)
    stage.bus.publisher(IMAGE, Image)
    with pytest.raises(BadSetting, match=f"The scene publishes on '{IMAGE}'; choose another topic"):
        spec(tmp_path).bind(stage)
    spec(tmp_path, image_pub="/other").bind(stage)


BENCHMARK = f"""<benchmark xmlns:u="urn:uwsim:1" u:scene="visibility-scene.xml" u:algorithm="esm">
<measures> <time> <name>t</name> </time> </measures>
<startOn> <type>onInit</type> </startOn> <stopOn> <type>never</type> </stopOn>
<function>t</function>
<sceneUpdater> <bagFogUpdater>
  <initialValue>0</initialValue> <finalValue>0.5</finalValue> <step>0.5</step>
  <interval>0.4</interval>
  <bag>dive.bag</bag>
  <imageTopic>{IMAGE}</imageTopic>
  <infoTopic>{INFO}</infoTopic>
  <imageDepth>2</imageDepth>
</bagFogUpdater> </sceneUpdater> </benchmark>"""


@pytest.mark.parametrize(
    ("was", "now", "line", "said"),
    [
        ("dive.bag", "dve.bag", 8, "'dve.bag' is in none of the folders searched: "),
        (IMAGE, "/camera/image_rw", 9, "Did you mean '/camera/image_raw'?"),
        (f"<imageTopic>{IMAGE}", f"<imageTopic>{INFO}", 9, "carries sensor_msgs/msg/CameraInfo"),
        (INFO, "/camera/inf", 10, "No topic in dive.bag is called '/camera/inf'"),
        ("<imageDepth>", "<imagePub>/uwsim/camera1</imagePub> <imageDepth>", 11, "<imagePub>"),
    ],
)
def test_check_and_bench_say_what_is_wrong_before_anything_is_simulated(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], was: str, now: str, line: int, said: str
) -> None:
    write_bag(tmp_path, "ros1", images())
    file = tmp_path / "b.xml"
    file.write_text(BENCHMARK.replace(was, now))
    assert main(["check", str(file)]) == 2
    printed = capsys.readouterr().out
    assert f"b.xml:{line}: " in printed
    assert said in printed
    assert main(["bench", str(file), "--out", str(tmp_path / "out")]) == 2
    assert said in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


def test_the_same_name_in_a_sound_file_is_no_error(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write_bag(tmp_path, "mcap", images())
    file = tmp_path / "b.xml"
    file.write_text(BENCHMARK.replace("dive.bag", "dive"))
    assert main(["check", str(file)]) == 0, capsys.readouterr().out


class Watches:
    """Keeps every image it gets, with its time."""

    def start(self, node: Node) -> None:
        type(self).seen: list[tuple[float, np.ndarray]] = []  # type: ignore[misc]
        node.subscribe(
            IMAGE, Image, lambda said: self.seen.append((node.now, pixels_of(said).copy()))
        )


UPDATER = BENCHMARK.partition("<sceneUpdater>")[2].partition("</sceneUpdater>")[0]


def a_plan(folder: Path, **other: object) -> Plan:
    write_bag(folder, "ros1", images())
    ocean = tank().ocean_state
    scene = replace(tank(), ocean_state=replace(ocean, fog=replace(ocean.fog, color=COLOUR)))
    return make_plan(folder, Watches, UPDATER, scene=scene, **other)  # type: ignore[arg-type]


def test_in_a_sequence_the_replay_lives_on_and_the_scenes_fog_colour_counts(
    tmp_path: Path,
) -> None:
    rows_of(a_plan(tmp_path))
    watched = [(round(time, 3), pixels) for time, pixels in Watches.seen]
    # at 0 the first image stands; then 0, 0.1, 0.25, 0.375, 0.475, 0.625, 0.75 s of the replay
    assert [time for time, _ in watched] == [0.0, 0.002, 0.1, 0.25, 0.376, 0.476, 0.626, 0.75]
    for index, (time, pixels) in enumerate(watched[1:]):
        fog = 0.0 if time < 0.4 else 0.5
        assert np.array_equal(pixels, expected(sample_pixels(40 * (index % 3)), fog))


def test_an_independent_level_begins_with_the_first_image(tmp_path: Path) -> None:
    plan = a_plan(tmp_path, mode="independent")
    for trial, fog in zip(plan.trials(), (0.0, 0.5), strict=True):
        list(execute(plan, trial))
        level = [(time, pixels) for time, pixels in Watches.seen if time > 2.0001]
        assert [round(time, 3) for time, _ in level] == [2.002, 2.1, 2.25, 2.376]
        for (_, pixels), index in zip(level, (0, 1, 2, 0), strict=True):
            assert np.array_equal(pixels, expected(sample_pixels(40 * index), fog))
        prelude = [pixels for time, pixels in Watches.seen if time <= 1.0]
        assert len(prelude) == 11
        assert all(np.array_equal(pixels, sample_pixels(0)) for pixels in prelude)


def test_the_result_has_the_number_of_images_published_and_their_hash(tmp_path: Path) -> None:
    plan = a_plan(tmp_path)
    (trial,) = plan.trials()
    ends = [next(x for x in execute(plan, trial) if isinstance(x, TrialEnd)) for _ in range(2)]
    assert ends[0].streams == ends[1].streams
    ((topic, n_frames, sha256),) = ends[0].streams
    assert (topic, n_frames, len(sha256)) == (IMAGE, 8, 64)


def test_the_truth_of_each_image_comes_with_it_and_is_hidden_from_the_algorithm(
    tmp_path: Path,
) -> None:
    write_bag(tmp_path, "mcap", images())
    (tmp_path / "corners.csv").write_text("time,u,v\n0,1,10\n0.2,3,30\n0.3,,0\n")
    truth = RecordedTruthSpec(file="corners.csv", topic="truth/corners")
    stage = world(timestep=0.01)
    updater = spec(tmp_path, bag="dive", truth=truth).bind(stage)
    assert stage.bus.hidden_reason("truth/corners") is not None
    screen = Screen(stage)
    found: list[tuple[float, list[float]]] = []
    stage.bus.subscribe(
        "truth/corners",
        Float32MultiArray,
        lambda said: found.append((round(stage.time, 6), said.data.tolist())),
    )
    updater.apply(0.0)
    stage.advance(50)
    updater.close()
    assert [time for time, _ in found] == screen.times
    assert [data for _, data in found[:4]] == [[1.0, 10.0], [2.0, 20.0], [], [1.0, 10.0]]


def scored(folder: Path, csv: str, components: str = "u v") -> EuclideanNorm:
    """Score three images at 0, 0.1 and 0.25 s, and an estimate for each."""
    stage = world(timestep=0.01)
    write_bag(folder, "ros1", images())
    (folder / "corners.csv").write_text(csv)
    truth = RecordedTruthSpec(file="corners.csv", topic="truth/corners")
    updater = spec(folder, truth=truth).bind(stage)
    measure = EuclideanNormSpec(
        name="corners",
        target="estimate",
        value="mean",
        ground_truth=TopicTruthSpec(topic="truth/corners", components=components, unit="px"),
    ).bind(stage)
    stage.advance(1)  # the first image stands until the benchmark begins
    publish = stage.bus.publisher("estimate", Float32MultiArray)
    message = Float32MultiArray(data=np.array([1.0, 10.0], dtype=np.float32))
    stage.bus.subscribe(IMAGE, Image, lambda _: publish(message))
    measure.start()
    updater.apply(0.0)
    for _ in range(30):
        stage.advance(1)
        measure.update()
    updater.close()
    return measure


def test_images_without_a_truth_are_counted_and_leave_a_gap_in_the_log(tmp_path: Path) -> None:
    measure = scored(tmp_path, "time,u,v\n0,1,10\n0.15,4,40\n")
    assert measure.details["frames"] == 2.0
    assert measure.remarks == (
        "1 of 3 images are not scored: 'truth/corners' has none for this image",
    )
    assert measure.log_values == (None, None, None)
    measure.close()


def test_a_truth_of_all_images_leaves_nothing_to_remark(tmp_path: Path) -> None:
    measure = scored(tmp_path, "time,u,v\n0,1,10\n0.25,6,60\n")
    assert measure.remarks == ()
    assert measure.log_values[0] == pytest.approx(np.hypot(5.0, 50.0))
    measure.close()


def test_a_truth_of_another_length_is_named(tmp_path: Path) -> None:
    measure = scored(tmp_path, "time,u,v\n0,1,10\n0.25,6,60\n", components="u")
    assert measure.missing_reason == "the estimate on 'estimate' has 2 numbers, expected 1"
    measure.close()
    (tmp_path / "dive.bag").unlink()
    measure = scored(tmp_path, "time,u\n0,1\n0.25,6\n")
    assert (
        measure.missing_reason == "no truth: the truth on 'truth/corners' has 1 numbers, expected 2"
    )
    measure.close()


@pytest.mark.parametrize("times", [(1.7e9, 1.7e9 + 10), (-5.0, -1.0), (3.0, 4.0)])
def test_a_truth_of_another_time_is_refused(tmp_path: Path, times: tuple[float, float]) -> None:
    write_bag(tmp_path, "ros1", images())
    (tmp_path / "corners.csv").write_text(f"time,u,v\n{times[0]},1,10\n{times[1]},6,60\n")
    truth = RecordedTruthSpec(file="corners.csv", topic="truth/corners")
    with pytest.raises(AssetError, match="are outside the recording: 0 s to 0"):
        spec(tmp_path, truth=truth).bind(world(timestep=0.01))


def test_a_moving_target_in_recorded_images_is_scored(tmp_path: Path) -> None:
    measure = scored(tmp_path, "time,u,v\n0,1,10\n0.25,6,60\n")
    assert measure.unit == "px"
    offsets = [np.hypot(5 * t, 50 * t) / 0.25 for t in TIMES]
    assert measure.details["frames"] == 3.0
    assert measure.value == pytest.approx(np.mean(offsets), rel=1e-5)
    assert measure.details["u.max"] == pytest.approx(5.0, rel=1e-5)
    measure.close()


def write_depth_bag(path: Path, pixels: np.ndarray, depth: np.ndarray, encoding: str) -> None:
    """Record two images, each with a depth image and the info of a pinhole of fx = fy = 4 px."""
    numbers = {"32FC1": depth.astype("<f4"), "16UC1": np.rint(1e3 * depth).astype("<u2")}[encoding]
    file = McapFile(path)
    for i, time in enumerate((0, 100_000_000)):
        height, width = depth.shape
        k = np.array([4.0, 0.0, 2.0, 0.0, 4.0, 1.5, 0.0, 0.0, 1.0])
        step = width * numbers.itemsize
        depth_message = Image(
            height=height, width=width, encoding=encoding, step=step,
            data=np.frombuffer(numbers.tobytes(), np.uint8).copy(),
        )  # fmt: skip
        messages = {
            "/depth": depth_message, INFO: CameraInfo(height=height, width=width, k=k),
            IMAGE: image(pixels + np.uint8(i), time=0.0),
        }  # fmt: skip
        for delay, (topic, message) in enumerate(messages.items()):
            kind = wire_type(type(message))
            assert kind is not None
            file.write(topic, kind, time + delay, message)
    file.close()


@pytest.mark.parametrize("encoding", ["32FC1", "16UC1"])
def test_fog_has_the_range_of_each_pixel_of_a_depth_image(tmp_path: Path, encoding: str) -> None:
    depth = np.linspace(0.5, 6.0, 20).reshape(4, 5)
    depth[2, 2] = 0.0  # not measured: at imageDepth
    pixels = sample_pixels(0)
    write_depth_bag(tmp_path / "dive.mcap", pixels, depth, encoding)
    stage = world(timestep=0.05)
    updater = spec(tmp_path, bag="dive.mcap", depth_topic="/depth", image_depth=DEPTH).bind(stage)
    screen = Screen(stage)
    updater.ramp(0.3)
    stage.advance(1)
    updater.close()
    columns, rows = np.meshgrid(np.arange(5), np.arange(4))
    ranges = depth * np.sqrt(1.0 + ((columns - 2.0) / 4.0) ** 2 + ((rows - 1.5) / 4.0) ** 2)
    ranges[2, 2] = DEPTH
    seen = np.exp(-((0.3 * ranges) ** 2))[..., None]
    exact = pixels * seen + 255.0 * np.array(COLOUR) * (1.0 - seen)
    assert np.abs(screen.pixels(0) - exact).max() <= (0.51 if encoding == "32FC1" else 0.7)


def test_images_in_fog_keep_the_noise_of_their_camera(tmp_path: Path) -> None:
    depth, grey = np.tile(np.linspace(0.5, 8.0, 64), (80, 1)), 128.0
    noise = np.random.default_rng(4).normal(0.0, 0.02 * 255.0, (80, 64, 3))
    pixels = np.rint(grey + noise).astype(np.uint8)
    write_depth_bag(tmp_path / "dive.mcap", pixels, depth, "32FC1")
    stage = world(timestep=0.05)
    updater = spec(tmp_path, bag="dive.mcap", depth_topic="/depth", noise=0.02).bind(stage)
    screen = Screen(stage)
    updater.ramp(0.3)
    stage.advance(1)
    updater.close()
    columns, rows = np.meshgrid(np.arange(64), np.arange(80))
    ranges = depth * np.sqrt(1.0 + ((columns - 2.0) / 4.0) ** 2 + ((rows - 1.5) / 4.0) ** 2)
    seen = np.exp(-((0.3 * ranges) ** 2))[..., None]
    residual = screen.pixels(0) - (grey * seen + 255.0 * np.array(COLOUR) * (1.0 - seen))
    is_unclipped = np.array(COLOUR) > 0.2  # black fog clips noise
    for part in (slice(0, 4), slice(8, 64)):  # near: the recorded noise; far: the added one
        std = residual[:, part][..., is_unclipped].std()
        assert std == pytest.approx(0.02 * 255.0, rel=0.06)


def test_a_depth_image_of_another_size_ends_the_run(tmp_path: Path) -> None:
    write_depth_bag(tmp_path / "dive.mcap", sample_pixels(0), np.ones((3, 5)), "32FC1")
    stage = world(timestep=0.05)
    updater = spec(tmp_path, bag="dive.mcap", depth_topic="/depth").bind(stage)
    Screen(stage)
    updater.ramp(0.3)
    with pytest.raises(RunFailed, match=r"has 5x4 pixels, its depth image 5x3"):
        stage.advance(1)
    updater.close()
