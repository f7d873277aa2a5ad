"""A camera in a bag: what is read of it, and what is refused."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest

from tests.support.bags import IMAGE, INFO, KINDS, sample_pixels, write_bag
from uwsim.errors import AssetError, UnknownName
from uwsim.messages import Time
from uwsim.messages.bag_camera import Recording, camera_info

TIMES = (0.0, 0.1, 0.25)


def open_bag(path: Path, image: str = IMAGE, info: str = INFO) -> Recording:
    return Recording(path, image, info)


@pytest.mark.parametrize("kind", KINDS)
def test_images_come_in_their_order_with_the_time_recorded(tmp_path: Path, kind: str) -> None:
    path = write_bag(tmp_path, kind, [(time, sample_pixels(i)) for i, time in enumerate(TIMES)])
    recording = open_bag(path)
    assert recording.gap == 100_000_000
    for _ in range(2):  # it can be gone through again
        frames = list(recording.frames())
        assert [frame.time for frame in frames] == [0, 100_000_000, 250_000_000]
        for i, frame in enumerate(frames):
            actual = frame.decode()
            assert np.array_equal(actual.pixels, sample_pixels(i))
            assert (actual.frame_id, actual.is_blue_first) == ("bow", False)
    recording.close()


@pytest.mark.parametrize("kind", KINDS)
def test_an_image_has_the_newest_info_by_then_and_the_first_before_it(
    tmp_path: Path, kind: str
) -> None:
    recording = open_bag(write_bag(tmp_path, kind, [(time, sample_pixels(0)) for time in TIMES]))
    stamp = Time(sec=3, nanosec=5)
    infos = [camera_info(frame.info, stamp=stamp, frame_id="bow") for frame in recording.frames()]
    recording.close()
    assert [info.k[0] for info in infos] == [0.0, 0.0, 0.1]
    assert infos[0].header.stamp == stamp
    assert infos[0].header.frame_id == "bow"
    assert infos[0].d.tolist() == [0.1, 0.0]
    assert infos[0].p.tolist() == list(range(12))
    assert (infos[0].width, infos[0].height, infos[0].distortion_model) == (5, 4, "plumb_bob")


@pytest.mark.parametrize("file", ["dive_0.mcap", "dive.mcap"])
def test_a_storage_file_is_read_without_its_folder(tmp_path: Path, file: str) -> None:
    folder = write_bag(tmp_path, "mcap", [(time, sample_pixels(0)) for time in TIMES])
    actual = next(folder.glob("*.mcap"))
    new_path = actual.rename(tmp_path / file)
    recording = open_bag(new_path)
    assert len(list(recording.frames())) == 3
    recording.close()


@pytest.mark.parametrize(
    ("encoding", "order"),
    [
        ("rgb8", [0, 1, 2]),
        ("bgr8", [2, 1, 0]),
        ("8UC3", [2, 1, 0]),
        ("rgba8", [0, 1, 2]),
        ("bgra8", [2, 1, 0]),
        ("mono8", None),
        ("8UC1", None),
    ],
)
@pytest.mark.parametrize("padding", [0, 3])
def test_every_encoding_is_turned_to_red_first_or_grey(
    tmp_path: Path, encoding: str, order: list[int] | None, padding: int
) -> None:
    template = {"8UC1": "mono8", "8UC3": "bgr8"}.get(encoding, encoding)
    pixels = sample_pixels(9, template)
    path = write_bag(
        tmp_path,
        "mcap",
        [(0.0, pixels), (0.1, pixels)],
        encoding=encoding,
        padding=padding,
    )
    recording = open_bag(path)
    actual = recording.first_frame.decode()
    recording.close()
    assert np.array_equal(actual.pixels, pixels if order is None else pixels[..., order])
    assert actual.is_blue_first is (order == [2, 1, 0])


@pytest.mark.parametrize("kind", ["ros1", "mcap"])
@pytest.mark.parametrize("grey", [False, True])
def test_compressed_images_are_unpacked(tmp_path: Path, kind: str, grey: bool) -> None:
    pixels = sample_pixels(9, "mono8" if grey else "bgr8")  # imencode takes blue first
    path = write_bag(
        tmp_path,
        kind,
        [(0.0, pixels), (0.1, pixels)],
        image_type="sensor_msgs/msg/CompressedImage",
    )
    recording = open_bag(path)
    actual = recording.first_frame.decode().pixels
    recording.close()
    assert np.array_equal(actual, pixels if grey else pixels[..., ::-1])


@pytest.mark.parametrize("kind", KINDS)
def test_a_topic_that_is_not_there_names_the_nearest(tmp_path: Path, kind: str) -> None:
    path = write_bag(tmp_path, kind, [(time, sample_pixels(0)) for time in TIMES])
    with pytest.raises(UnknownName, match=r"Did you mean '/camera/image_raw'"):
        open_bag(path, image="/camera/image_rw")
    with pytest.raises(UnknownName, match=r"Did you mean '/camera/camera_info'"):
        open_bag(path, info="/camera/camera_inf")


def test_a_topic_of_another_type_is_refused(tmp_path: Path) -> None:
    path = write_bag(
        tmp_path,
        "ros1",
        [(time, sample_pixels(0)) for time in TIMES],
        image_type="std_msgs/msg/String",
    )
    with pytest.raises(AssetError, match="carries std_msgs/msg/String; expected sensor_msgs"):
        open_bag(path)
    with pytest.raises(AssetError, match="carries sensor_msgs/msg/CameraInfo; expected"):
        open_bag(path, image=INFO)


@pytest.mark.parametrize("times", [(), (0.0,), (0.5, 0.5)])
def test_a_recording_without_spacing_is_refused(tmp_path: Path, times: tuple[float, ...]) -> None:
    path = write_bag(tmp_path, "ros1", [(time, sample_pixels(0)) for time in times])
    with pytest.raises(AssetError, match=r"no two images at different times|has no messages"):
        open_bag(path)


def test_a_camera_without_any_info_is_refused(tmp_path: Path) -> None:
    path = write_bag(tmp_path, "mcap", [(t, sample_pixels(0)) for t in TIMES], with_info=False)
    with pytest.raises(AssetError, match="'/camera/camera_info' of dive has no messages"):
        open_bag(path)


def test_an_encoding_that_is_not_read_is_refused_with_those_that_are(tmp_path: Path) -> None:
    path = write_bag(
        tmp_path, "mcap", [(t, sample_pixels(0)) for t in TIMES], encoding="bayer_rggb8"
    )
    with pytest.raises(AssetError, match=r"Image 1 of .* as 'bayer_rggb8'; expected one of mono"):
        open_bag(path)


def test_pixels_that_do_not_fit_the_size_are_refused(tmp_path: Path) -> None:
    path = write_bag(
        tmp_path, "mcap", [(t, sample_pixels(0, "mono8")) for t in TIMES], encoding="rgb8"
    )
    with pytest.raises(
        AssetError, match="header for 5x4 pixels of 3 bytes in rows of 5, and 20 bytes"
    ):
        open_bag(path)


@pytest.mark.parametrize("name", ["dive.bag", "dive.mcap", "dive.db3"])
@pytest.mark.parametrize("content", [b"", b"no bag at all", b"#ROSBAG V2.0\n" + b"\x00" * 40])
def test_a_file_that_is_no_bag_is_one_clean_error(
    tmp_path: Path, name: str, content: bytes
) -> None:
    path = tmp_path / name
    path.write_bytes(content)
    with pytest.raises(AssetError, match=f"{name} cannot be read as a recording: .+") as excinfo:
        open_bag(path)
    assert "\n" not in str(excinfo.value)


def test_a_bag_that_was_cut_off_is_one_clean_error(tmp_path: Path) -> None:
    data = write_bag(
        tmp_path, "ros1", [(0.1 * i, sample_pixels(i)) for i in range(20)]
    ).read_bytes()
    for length in range(20, len(data), len(data) // 12):
        path = tmp_path / f"cut{length}.bag"
        path.write_bytes(data[:length])
        with pytest.raises(AssetError, match="cannot be read as a recording"):
            open_bag(path)


def test_a_recordings_folder_holds_its_own_files_alone(tmp_path: Path) -> None:
    folder = write_bag(tmp_path, "mcap", [(time, sample_pixels(0)) for time in TIMES])
    storage = next(folder.glob("*.mcap"))
    other_folder = storage.rename(tmp_path / "elsewhere.mcap")
    storage.symlink_to(other_folder)
    with pytest.raises(AssetError, match=r"dive/.*\.mcap leads out of the recording's folder"):
        open_bag(folder)
    storage.unlink()
    os.mkfifo(storage)
    with pytest.raises(AssetError, match=r"dive/.*\.mcap is not a regular file"):
        open_bag(folder)
