"""Statistics of a signal, against numpy."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from uwsim.benchmark.measures import Signal


@given(st.lists(st.floats(-1e3, 1e3), min_size=1, max_size=60))
def test_the_running_statistics_are_those_of_the_samples(samples: list[float]) -> None:
    signal = Signal(("a",))
    for sample in samples:
        signal.add(abs(sample), [sample])
    expected = {
        "a.mean": np.mean(samples), "a.rms": np.sqrt(np.mean(np.square(samples))),
        "a.max": np.max(np.abs(samples)), "a.std": np.std(samples), "a.n": len(samples),
    }  # fmt: skip
    found = {name: signal.details[name] for name in expected}
    assert found == pytest.approx(expected, abs=1e-5, rel=1e-9)
    assert signal.last_sample == (abs(samples[-1]), samples[-1])


def test_without_samples_there_is_nothing_but_their_number() -> None:
    signal = Signal(("a",))
    assert {name: value for name, value in signal.details.items() if value is not None} == {
        "n": 0.0,
        "a.n": 0.0,
    }
    assert signal.last_sample == (None, None)
    assert signal.value("mean") is None


def test_a_small_spread_about_a_large_mean_is_not_lost() -> None:
    signal = Signal(())
    for sample in (1e8, 1e8 + 1.0, 1e8 + 2.0):
        signal.add(sample, ())
    assert signal.details["std"] == pytest.approx(np.sqrt(2 / 3), rel=1e-6)
