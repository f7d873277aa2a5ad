"""Exports of a recording: CSV, LeRobot and Minari, read back."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import cv2
import numpy as np
import pytest

import uwsim
from uwsim.bus import Bus
from uwsim.cli import main
from uwsim.datasets.export.csv_tables import export_csv
from uwsim.datasets.export.lerobot import export_lerobot
from uwsim.datasets.export.message_numbers import read_numbers
from uwsim.datasets.export.steps import read_episode
from uwsim.errors import BadSetting, UnknownName
from uwsim.messages import Image, JointState, Odometry, String, TwistStamped, image
from uwsim.middleware.recording import Recorder

STATE, COMMAND, CAMERA = "/odom", "/command", "/camera"


@pytest.fixture(scope="module")
def recording(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Odometry x = t at 20 Hz, a command of surge 2 t and a grey t at 10 Hz, for 1 s; a text."""
    path = tmp_path_factory.mktemp("recording") / "swim.mcap"
    bus, now = Bus(), [0.0]
    odometry, command = bus.publisher(STATE, Odometry), bus.publisher(COMMAND, TwistStamped)
    camera, text = bus.publisher(CAMERA, Image), bus.publisher("/name", String)
    with Recorder(bus, path) as recorder:
        recorder.start(lambda: now[0])
        text(String(data="swim"))
        for index in range(21):
            now[0] = 0.05 * index
            state = Odometry()
            state.pose.pose.position.x = now[0]
            odometry(state)
            if index % 2 == 0:
                twist = TwistStamped()
                twist.twist.linear.x = 2.0 * now[0]
                command(twist)
                pixels = np.full((48, 64, 3), 10 * index, np.uint8)
                camera(image(pixels, time=now[0], frame_id="camera"))
            bus.deliver()
    return path


def test_numbers_have_the_path_of_their_field() -> None:
    numbers = read_numbers(JointState(name=["slew"], position=[0.25]))
    assert numbers == {"position.0": 0.25}
    assert list(read_numbers(Odometry()))[:3] == [
        "pose.pose.position.x",
        "pose.pose.position.y",
        "pose.pose.position.z",
    ]


def test_a_table_has_the_time_and_the_numbers_of_each_message(
    recording: Path, tmp_path: Path
) -> None:
    n_rows = export_csv(recording, tmp_path / "tables")
    assert n_rows[STATE] == 21
    assert n_rows[COMMAND] == 11
    assert "/name" not in n_rows
    with (tmp_path / "tables/odom.csv").open() as stream:
        rows = list(csv.DictReader(stream))
    assert [float(row["pose.pose.position.x"]) for row in rows] == [
        pytest.approx(float(row["time"]), abs=1e-9) for row in rows
    ]


def test_a_step_has_the_newest_message_of_each_topic(recording: Path) -> None:
    episode = read_episode(recording, [STATE], [COMMAND], 20.0)
    assert len(episode.times) == 21
    assert episode.observation_names[0] == "/odom/pose.pose.position.x"
    surge = episode.actions[:, list(episode.action_names).index("/command/twist.linear.x")]
    assert episode.observations[:, 0] == pytest.approx(0.05 * np.arange(21), abs=1e-6)
    assert surge == pytest.approx(0.2 * (np.arange(21) // 2), abs=1e-6)


def test_lerobot_files_are_read_back(recording: Path, tmp_path: Path) -> None:
    pq = pytest.importorskip("pyarrow.parquet")
    pytest.importorskip("imageio_ffmpeg")
    out = tmp_path / "set"
    export_lerobot(
        [recording],
        out,
        observations=[STATE],
        actions=[COMMAND],
        cameras=[CAMERA],
        rate=10.0,
        task="swim ahead",
    )
    info = json.loads((out / "meta/info.json").read_text())
    assert info["codebase_version"] == "v3.0"
    assert info["total_frames"] == 11
    path = out / info["data_path"].format(chunk_index=0, file_index=0)
    table = pq.read_table(path).to_pydict()
    assert set(table) | {"observation.images.camera"} == set(info["features"])
    assert [row[0] for row in table["observation.state"]] == pytest.approx(
        (0.1 * np.arange(11)).tolist(), abs=1e-6
    )
    for name in ("observation.state", "action"):
        shape = info["features"][name]["shape"]
        assert [len(table[name][0])] == shape == [len(info["features"][name]["names"])]
    stats = json.loads((out / "meta/stats.json").read_text())
    assert stats["observation.state"]["mean"][0] == pytest.approx(0.5, abs=1e-6)
    episode = pq.read_table(out / "meta/episodes/chunk-000/file-000.parquet").to_pylist()[0]
    assert episode["length"] == 11
    assert episode["tasks"] == ["swim ahead"]
    video = info["video_path"].format(
        video_key="observation.images.camera", chunk_index=0, file_index=0
    )
    film = cv2.VideoCapture(str(out / video))
    frames = [film.read()[1] for _ in range(11)]
    film.release()
    assert frames[0].shape == (48, 64, 3)
    greys = [frame.mean() for frame in frames]
    assert greys == pytest.approx(20.0 * np.arange(11), abs=6.0)


def test_two_recordings_are_two_episodes(
    recording: Path, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    pq = pytest.importorskip("pyarrow.parquet")
    pytest.importorskip("imageio_ffmpeg")
    out = tmp_path / "set"
    topics = ["--observation", STATE, "--action", COMMAND, "--camera", CAMERA]
    command = ["export", str(recording), str(recording), "--lerobot", *topics, "-o", str(out)]
    assert main(command) == 0
    assert "2 episodes of 22 steps" in capfd.readouterr().out
    info = json.loads((out / "meta/info.json").read_text())
    assert (info["total_episodes"], info["total_frames"]) == (2, 22)
    assert info["splits"] == {"train": "0:2"}
    table = pq.read_table(out / "data/chunk-000/file-000.parquet").to_pydict()
    assert table["index"] == list(range(22))
    assert table["episode_index"] == [0] * 11 + [1] * 11
    assert table["frame_index"] == [*range(11), *range(11)]
    assert table["observation.state"][:11] == table["observation.state"][11:]
    rows = pq.read_table(out / "meta/episodes/chunk-000/file-000.parquet").to_pylist()
    assert [(row["dataset_from_index"], row["dataset_to_index"]) for row in rows] == [
        (0, 11),
        (11, 22),
    ]
    name = "videos/observation.images.camera"
    assert rows[1][f"{name}/from_timestamp"] == rows[0][f"{name}/to_timestamp"] == 1.1
    film = cv2.VideoCapture(str(out / name / "chunk-000/file-000.mp4"))
    assert int(film.get(cv2.CAP_PROP_FRAME_COUNT)) == 22
    film.release()
    assert main([*command[:3], "--csv", "-o", str(tmp_path / "t")]) == 2
    assert "only --lerobot takes more than one" in capfd.readouterr().err


def test_minari_reads_the_episode(
    recording: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    minari = pytest.importorskip("minari")
    from uwsim.datasets.export.minari import export_minari

    out = tmp_path / "set"
    identifier, _ = export_minari(
        recording, out, observations=[STATE], actions=[COMMAND], rate=10.0
    )
    monkeypatch.setenv("MINARI_DATASETS_PATH", str(out))
    dataset = minari.load_dataset(identifier)
    assert dataset.total_episodes == 1
    episode = dataset[0]
    assert episode.observations.shape[0] == 11
    assert episode.actions.shape[0] == 10
    assert episode.observations[:, 0] == pytest.approx(0.1 * np.arange(11), abs=1e-6)


def test_wrong_topics_and_folders_are_named(recording: Path, tmp_path: Path) -> None:
    with pytest.raises(UnknownName, match="/odom"):
        export_csv(recording, tmp_path / "a", ["/odum"])
    (tmp_path / "file").write_text("")
    with pytest.raises(BadSetting, match="empty folder"):
        export_csv(recording, tmp_path)
    with pytest.raises(BadSetting, match="has no numbers"):
        read_episode(recording, ["/name"], [COMMAND], 10.0)
    with pytest.raises(BadSetting, match="--rate"):
        read_episode(recording, [STATE], [COMMAND], 0.0)
    with pytest.raises(BadSetting, match="--action"):
        read_episode(recording, [STATE], [], 1.0)


def test_the_command_exports_and_refuses_two_formats(
    recording: Path, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    assert main(["export", str(recording), "--csv", "-o", str(tmp_path / "t")]) == 0
    assert "3 tables with" in capfd.readouterr().out
    assert main(["export", str(recording), "--csv", "--minari"]) == 2
    assert "Choose one of" in capfd.readouterr().err
    assert main(["export", str(tmp_path / "none.mcap"), "--csv", "-o", str(tmp_path / "u")]) != 0


def test_rows_of_a_result_are_a_table(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    result = uwsim.bench(
        "visibility", levels={"fog": [0.0]}, algorithm="frozen", out=tmp_path / "one.result"
    )
    assert main(["export", str(tmp_path / "one.result"), "--csv", "-o", str(tmp_path / "t")]) == 0
    with (tmp_path / "t/rows.csv").open() as stream:
        (row,) = csv.DictReader(stream)
    labels = [column.label for column in result.columns]
    assert list(row) == labels
    texts = ["" if cell is None else str(cell) for cell in result.rows[0]]
    assert list(row.values()) == texts
    assert main(["export", str(tmp_path / "one.result"), "--minari"]) == 2
    assert "has no <u:environment>" in capfd.readouterr().err
