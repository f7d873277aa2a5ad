"""Lamps in motion tracks: those that nobody dims are stored as on or off."""

from __future__ import annotations

import numpy as np

from uwsim.results.motion import Signal, read_track, track_bytes
from uwsim.results.motion.motion_track import quantise, steps_of
from uwsim.runs.trial.motion_recorder import compact_lamps

SIGNALS = (
    Signal(name="fog"),
    Signal(name="lamp/bow", step=0.01),
    Signal(name="lamp/stern", step=0.01),
)


def test_a_lamp_that_is_never_dimmed_is_stored_as_before_it_could_be() -> None:
    values = np.array([[0.4, 1.0, 1.0], [0.4, 1.0, 0.37], [0.4, 0.0, 0.0]])
    table = quantise(values, steps_of(0, SIGNALS))
    signals = compact_lamps(SIGNALS, table)
    assert [signal.step for signal in signals] == [1e-4, 1.0, 0.01]
    assert table[:, 1].tolist() == [1, 1, 0]
    track = read_track(track_bytes((), signals, table, ()))
    np.testing.assert_allclose(track.values, values, atol=1e-12)
