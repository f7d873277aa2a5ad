"""All cheats of ``scripts/cheat_trials`` on a short benchmark."""

from __future__ import annotations

from pathlib import Path

import pytest

from cheat_trials import CHEATS, GAINS, by_name, faults, trial


@pytest.mark.slow
def test_no_cheat_gains_but_those_within_their_own_process(tmp_path: Path) -> None:
    results = by_name(trial(tmp_path, CHEATS, seed=2, length=1.0))
    assert faults(results) == []
    for cheat in GAINS:
        assert results[cheat.__name__].values("total") == pytest.approx((0.0, 0.0), abs=0.1)
