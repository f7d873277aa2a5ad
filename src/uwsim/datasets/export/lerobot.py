"""LeRobot, version 3: Parquet files of steps, MP4 files of cameras, and ``meta``.

.. code-block:: text

    data/chunk-000/file-000.parquet            steps: observation.state, action, timestamp, ...
    videos/observation.images.NAME/chunk-000/file-000.mp4
    meta/info.json  meta/stats.json  meta/tasks.parquet
    meta/episodes/chunk-000/file-000.parquet

Each recording, or level of a result, is one episode; the episodes follow each other in the files.
The files follow the layout of LeRobot's data sets of codebase version v3.0; they are read back with
pyarrow, not with LeRobot, which needs torch.
"""

from __future__ import annotations

import importlib.util
import json
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np
import numpy.typing as npt

from ...errors import BadSetting, MissingExtra
from ...messages import Image
from ...messages.build import pixels_of
from ...middleware.recording import BagReader
from ...results.atomic_file import write_text
from ...viewer.film.encoder import FfmpegEncoder, as_yuv
from .csv_tables import check_folder, check_topics
from .steps import Episode, Numbers, read_episode

CODEBASE_VERSION = "v3.0"
CHUNK = "chunk-000/file-000"
QUANTILES = (0.01, 0.1, 0.5, 0.9, 0.99)
"""The quantiles in the statistics."""


def check_extras() -> None:
    """Raise MissingExtra unless pyarrow and ffmpeg are installed."""
    for module in ("pyarrow", "imageio_ffmpeg"):
        if importlib.util.find_spec(module) is None:
            raise MissingExtra(
                f"--lerobot needs {module}. Install it with: pip install 'uwsim[export]'."
            )


def export_lerobot(
    recordings: Sequence[Path],
    out: Path,
    *,
    observations: Sequence[str],
    actions: Sequence[str],
    cameras: Sequence[str] = (),
    rate: float = 10.0,
    task: str = "",
) -> list[Episode]:
    """Write a data set with an episode for each recording; return the episodes.

    Args:
        recordings: the recordings, in the order of the episodes.
        out: the new folder.
        observations: the topics of ``observation.state``.
        actions: the topics of ``action``.
        cameras: the topics of images, each of which becomes a film of all episodes.
        rate: the rate of steps [Hz].
        task: the description of the task in words.

    Raises:
        MissingExtra: pyarrow or ffmpeg is not installed.
        UwsimError: a recording, a topic or the folder is invalid, or recordings differ in the
            fields of a topic or in the size of images.
    """
    check_extras()
    check_folder(out)
    episodes = [read_episode(path, observations, actions, rate) for path in recordings]
    _check_fields(recordings, episodes)
    sizes = {}
    for topic in cameras:
        name = f"observation.images.{topic.strip('/').replace('/', '.')}"
        path = out / "videos" / name / f"{CHUNK}.mp4"
        sizes[name] = _write_film(recordings, topic, episodes, path)
    write_lerobot(episodes, out, task or recordings[0].stem, sizes)
    return episodes


def write_lerobot(
    episodes: Sequence[Episode],
    out: Path,
    task: str,
    sizes: Mapping[str, tuple[int, int]] = MappingProxyType({}),
) -> None:
    """Write the steps and ``meta`` of episodes with the same fields.

    Args:
        episodes: the episodes.
        out: the folder.
        task: the description of the task in words.
        sizes: the width and height of each film [px].
    """
    _write_steps(out, episodes)
    _write_meta(out, episodes, sizes, task)


def _check_fields(recordings: Sequence[Path], episodes: Sequence[Episode]) -> None:
    """Raise BadSetting if an episode has other numbers than the first."""
    for path, episode in zip(recordings, episodes, strict=True):
        for names, first_names in (
            (episode.observation_names, episodes[0].observation_names),
            (episode.action_names, episodes[0].action_names),
        ):
            if names != first_names:
                difference = sorted(set(names) ^ set(first_names))
                raise BadSetting(
                    f"{path}: has other numbers than {recordings[0]}: "
                    f"{', '.join(difference[:4]) or 'in another order'}."
                )


def _columns_of(episodes: Sequence[Episode]) -> dict[str, npt.NDArray[Any]]:
    lengths = [len(episode.times) for episode in episodes]
    frame_indices = np.concatenate([np.arange(n, dtype=np.int64) for n in lengths])
    n = sum(lengths)
    return {
        "timestamp": (frame_indices / episodes[0].rate).astype(np.float32),
        "frame_index": frame_indices,
        "episode_index": np.repeat(np.arange(len(lengths), dtype=np.int64), lengths),
        "index": np.arange(n, dtype=np.int64),
        "task_index": np.zeros(n, np.int64),
        **_outcomes_of(episodes),
    }


def _outcomes_of(episodes: Sequence[Episode]) -> dict[str, npt.NDArray[Any]]:
    """Return the columns of rewards, ends and successes; none for recordings."""
    columns: dict[str, list[npt.NDArray[Any]]] = {}
    for episode in episodes:
        if (outcome := episode.outcome) is not None:
            is_last = np.arange(len(episode.times)) == len(episode.times) - 1
            columns.setdefault("next.reward", []).append(outcome.rewards)
            columns.setdefault("next.done", []).append(is_last)
            columns.setdefault("next.success", []).append(is_last & outcome.is_success)
    return {name: np.concatenate(parts) for name, parts in columns.items()}


def _write_steps(out: Path, episodes: Sequence[Episode]) -> None:
    import pyarrow as pa
    import pyarrow.parquet as pq

    path = out / "data" / f"{CHUNK}.parquet"
    path.parent.mkdir(parents=True, exist_ok=True)
    table = {
        "observation.state": _vectors(_observations_of(episodes)),
        "action": _vectors(_actions_of(episodes)),
        **{name: pa.array(values) for name, values in _columns_of(episodes).items()},
    }
    pq.write_table(pa.table(table), path)


def _observations_of(episodes: Sequence[Episode]) -> Numbers:
    return np.concatenate([episode.observations for episode in episodes])


def _actions_of(episodes: Sequence[Episode]) -> Numbers:
    return np.concatenate([episode.actions for episode in episodes])


def _vectors(values: Numbers) -> Any:
    import pyarrow as pa

    return pa.FixedSizeListArray.from_arrays(pa.array(values.reshape(-1)), values.shape[1])


def _write_meta(
    out: Path, episodes: Sequence[Episode], sizes: Mapping[str, tuple[int, int]], task: str
) -> None:
    import pyarrow as pa
    import pyarrow.parquet as pq

    folder = out / "meta" / "episodes" / "chunk-000"
    folder.mkdir(parents=True)
    starts = np.cumsum([0, *(len(episode.times) for episode in episodes)]).tolist()
    rows = [
        _describe_episode(episode, number, starts[number], sizes, task)
        for number, episode in enumerate(episodes)
    ]
    table = {name: [row[name] for row in rows] for name in rows[0]}
    pq.write_table(pa.table(table), folder / "file-000.parquet")
    tasks = pa.table({"task_index": pa.array([0], pa.int64()), "task": [task]})
    pq.write_table(tasks, out / "meta" / "tasks.parquet")
    stats = {
        "observation.state": find_stats(_observations_of(episodes)),
        "action": find_stats(_actions_of(episodes)),
    }
    write_text(out / "meta" / "stats.json", json.dumps(stats, indent=1) + "\n")
    write_text(out / "meta" / "info.json", json.dumps(_info(episodes, sizes), indent=1) + "\n")


def _describe_episode(
    episode: Episode, number: int, start: int, sizes: Mapping[str, tuple[int, int]], task: str
) -> dict[str, Any]:
    """Return the row of an episode, whose first step has the index ``start`` in the data set."""
    end = start + len(episode.times)
    row: dict[str, Any] = {
        "episode_index": number,
        "tasks": [task],
        "length": len(episode.times),
        "data/chunk_index": 0,
        "data/file_index": 0,
        "dataset_from_index": start,
        "dataset_to_index": end,
        "meta/episodes/chunk_index": 0,
        "meta/episodes/file_index": 0,
    }
    for name in sizes:
        row[f"videos/{name}/chunk_index"] = 0
        row[f"videos/{name}/file_index"] = 0
        row[f"videos/{name}/from_timestamp"] = start / episode.rate
        row[f"videos/{name}/to_timestamp"] = end / episode.rate
    for feature, values in (
        ("observation.state", episode.observations),
        ("action", episode.actions),
    ):
        row |= {f"stats/{feature}/{name}": n for name, n in find_stats(values).items()}
    return row


def find_stats(values: Numbers) -> dict[str, list[Any]]:
    """Return minimum, maximum, mean, deviation, count and quantiles of columns, (n, k)."""
    numbers = values.astype(np.float64)
    stats: dict[str, list[Any]] = {
        "min": numbers.min(axis=0).tolist(),
        "max": numbers.max(axis=0).tolist(),
        "mean": numbers.mean(axis=0).tolist(),
        "std": numbers.std(axis=0).tolist(),
        "count": [len(numbers)],
    }
    for share in QUANTILES:
        stats[f"q{round(100 * share):02d}"] = np.quantile(numbers, share, axis=0).tolist()
    return stats


def _info(episodes: Sequence[Episode], sizes: Mapping[str, tuple[int, int]]) -> dict[str, Any]:
    episode = episodes[0]
    features: dict[str, Any] = {
        "observation.state": _feature(episode.observations, episode.observation_names),
        "action": _feature(episode.actions, episode.action_names),
    }
    for name, (width, height) in sizes.items():
        features[name] = {
            "dtype": "video",
            "shape": [height, width, 3],
            "names": ["height", "width", "channels"],
            "info": {
                "video.height": height,
                "video.width": width,
                "video.codec": "h264",
                "video.pix_fmt": "yuv420p",
                "video.is_depth_map": False,
                "video.fps": episode.rate,
                "video.channels": 3,
                "has_audio": False,
            },
        }
    for name, values in _columns_of(episodes).items():
        features[name] = {"dtype": str(values.dtype), "shape": [1], "names": None}
    video_path = "videos/{video_key}/chunk-{chunk_index:03d}/file-{file_index:03d}.mp4"
    return {
        "codebase_version": CODEBASE_VERSION,
        "robot_type": "uwsim",
        "total_episodes": len(episodes),
        "total_frames": sum(len(episode.times) for episode in episodes),
        "total_tasks": 1,
        "chunks_size": 1000,
        "data_files_size_in_mb": 100,
        "video_files_size_in_mb": 200,
        "fps": int(episode.rate) if episode.rate.is_integer() else episode.rate,
        "splits": {"train": f"0:{len(episodes)}"},
        "data_path": "data/chunk-{chunk_index:03d}/file-{file_index:03d}.parquet",
        "video_path": video_path if sizes else None,
        "features": features,
    }


def _feature(values: Numbers, names: Sequence[str]) -> dict[str, Any]:
    return {"dtype": str(values.dtype), "shape": [len(names)], "names": list(names)}


def _write_film(
    recordings: Sequence[Path], topic: str, episodes: Sequence[Episode], path: Path
) -> tuple[int, int]:
    """Write the newest image at each step as a film; return its width and height [px]."""
    encoder: FfmpegEncoder | None = None
    size = (0, 0)
    is_complete = False
    try:
        for recording, episode in zip(recordings, episodes, strict=True):
            for pixels in _images_at_steps(recording, topic, episode):
                new_size = (pixels.shape[1] // 2 * 2, pixels.shape[0] // 2 * 2)
                if encoder is None:
                    size = new_size
                    encoder = FfmpegEncoder(path, size, episode.rate, ())
                if new_size != size:
                    raise BadSetting(
                        f"{recording}: images of {topic} have {new_size[0]}x{new_size[1]} px, and "
                        f"{size[0]}x{size[1]} px before; a film has one size."
                    )
                encoder.add(as_yuv(np.ascontiguousarray(pixels[: size[1], : size[0]])))
        is_complete = True
    finally:
        if encoder is not None:
            encoder.close(keeps_file=is_complete)
    return size


def _images_at_steps(
    recording: Path, topic: str, episode: Episode
) -> Iterator[npt.NDArray[np.uint8]]:
    """Yield the newest image at each step, (h, w, 3); before the first, the first."""
    with BagReader(recording) as reader:
        check_topics(reader, [topic])
        if reader.topics[topic] is not Image:
            raise BadSetting(f"--camera {topic}: has no images of type sensor_msgs/Image.")
        index, pixels = 0, None
        for time, _, message in reader.messages([topic]):
            while (
                pixels is not None and index < len(episode.times) and (episode.times[index] < time)
            ):
                yield pixels
                index += 1
            image = pixels_of(message)
            pixels = image if image.ndim == 3 else np.repeat(image[..., None], 3, axis=2)
        while pixels is not None and index < len(episode.times):
            yield pixels
            index += 1
