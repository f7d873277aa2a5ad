"""An executor on Ray: the same bytes from a cluster of two, one of whose workers is killed."""

import importlib.util
import os
import signal
import socket
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.runs.executors.test_executor import killing_its_worker
from tests.support.short_benchmark import bench_of, fingerprint, run, write_benchmark
from uwsim.errors import BadSetting, MissingExtra
from uwsim.runs.executors.ray import RayExecutor, RayWorker, address
from uwsim.runs.executors.worker import LevelEnded, TrialEnded, TrialFailed

needs_ray = pytest.mark.skipif(
    importlib.util.find_spec("ray") is None,
    reason="Ray is not installed: pip install uwsim[ray]",
)
SCRIPT = """
import sys
from pathlib import Path
from tests.support.short_benchmark import bench_of
from tests.runs.executors.test_executor import killing_its_worker
from uwsim.runs.executors.executor import run_all
from uwsim.runs.executors.ray import RayExecutor

folder = Path(sys.argv[1])
benches = [
    bench_of(folder / "short.xml", folder / "esm", repeat=2),
    bench_of(folder / "short.xml", folder / "mortal", **killing_its_worker(folder)),
]
levels = []
run_all(benches, RayExecutor(cpus=2), on_level=lambda: levels.append(1))
print(len(levels), "levels,", sum(bench.n_lost for bench in benches), "lost")
"""


@pytest.fixture(autouse=True)
def interrupts() -> Iterator[None]:
    """A worker blocks Ctrl-C for good: here it is not the end of its process."""
    before = signal.pthread_sigmask(signal.SIG_BLOCK, ())
    yield
    signal.pthread_sigmask(signal.SIG_SETMASK, before)


def leftovers(home: Path) -> set[str]:
    """What Ray could have left in its usual places."""
    found = [*Path("/tmp").glob("uwsim-ray-*"), *Path("/tmp").glob("ray/*"), home / ".ray"]
    return {str(path) for path in found if path.exists()}


@needs_ray
@pytest.mark.slow
def test_a_cluster_of_two_that_loses_a_worker_gives_the_same_bytes(
    tmp_path: Path, home: Path
) -> None:
    benchmark = write_benchmark(tmp_path, "0.2")
    before = leftovers(home)
    environment = {name: v for name, v in os.environ.items() if not name.startswith("RAY_")}
    done = subprocess.run(
        [sys.executable, "-c", SCRIPT, str(tmp_path)],
        env=environment | {"PYTHONPATH": os.pathsep.join(sys.path)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stdout, done.stderr) == (0, "9 levels, 1 lost\n", "")
    assert (tmp_path / "immortal").exists()
    run(benchmark, tmp_path / "esm-here", repeat=2)
    run(benchmark, tmp_path / "mortal-here", **killing_its_worker(tmp_path))
    for name in ("esm", "mortal"):
        assert fingerprint(tmp_path / name) == fingerprint(tmp_path / f"{name}-here")
    assert leftovers(home) == before


def test_a_worker_sends_home_all_that_is_kept(tmp_path: Path) -> None:
    bench = bench_of(write_benchmark(tmp_path, "0.2"), tmp_path / "a", mode="independent")
    trial = bench.plan.trials()[1]
    level, end = RayWorker().execute(bench, trial, bench.head(trial))
    assert isinstance(level, LevelEnded)
    assert isinstance(end, TrialEnded)
    [(name, png)] = level.images
    assert name == "pictures/00001-bowtech1.png"
    assert png.startswith(b"\x89PNG")
    assert not (tmp_path / "a").exists()


def test_a_worker_with_other_files_versions_or_renderer_refuses_to_play(tmp_path: Path) -> None:
    bench = bench_of(write_benchmark(tmp_path, "0.2"), tmp_path / "a")
    trial = bench.plan.trials()[0]
    head = bench.head(trial)
    head["run"]["renderer"] = "a graphics card"
    head["inputs"]["scene"][1] = "sha256:0"
    [failed] = RayWorker().execute(bench, trial, head)
    assert isinstance(failed, TrialFailed)
    assert "inputs.scene is ['visibility-scene.xml', 'sha256:" in str(failed.error)
    assert "not 'a graphics card'" in str(failed.error)


def test_without_ray_it_says_how_to_install_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("RAY_ADDRESS", raising=False)
    monkeypatch.setenv("RAY_AUTH_MODE", "token")
    monkeypatch.setitem(sys.modules, "ray", None)
    with pytest.raises(MissingExtra, match=r"pip install uwsim\[ray\]"):
        RayExecutor()


@pytest.mark.parametrize("given", [None, "", "local"])
def test_without_an_address_the_cluster_is_our_own(
    given: str | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("RAY_ADDRESS", raising=False)
    if given is not None:
        monkeypatch.setenv("RAY_ADDRESS", given)
    assert address() is None


@pytest.mark.parametrize("given", ["nonsense", "ray://127.0.0.1:10001", "127.0.0.1:", "a:b"])
def test_what_is_no_address_is_refused(given: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("RAY_ADDRESS", given)
    with pytest.raises(BadSetting, match="expected HOST:PORT"):
        address()


def test_an_address_where_nobody_answers_is_refused_at_once(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    with socket.socket() as closed:
        closed.bind(("127.0.0.1", 0))
        port = closed.getsockname()[1]
        monkeypatch.setenv("RAY_ADDRESS", f"127.0.0.1:{port}")
        with pytest.raises(BadSetting, match="there is no answer"):
            address()
        closed.listen()
        assert address() == f"127.0.0.1:{port}"
