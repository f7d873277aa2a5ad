"""What is read and cannot be played yet says so, before anything is simulated."""

from __future__ import annotations

import pytest

from fakes import FakeBody, FakeWorld
from uwsim.benchmark.measures import (
    MeasureSpec,
    PathFollowingSpec,
    Reconstruction3DSpec,
)
from uwsim.benchmark.not_simulated import NotSimulatedYet


@pytest.mark.parametrize(
    ("spec", "element"),
    [
        (PathFollowingSpec(name="p", target="b"), "pathFollowing"),
        (Reconstruction3DSpec(name="r", target="b", topic="t", from_="b"), "reconstruction3D"),
    ],
)
def test_binding_it_is_a_clean_error(spec: MeasureSpec, element: str) -> None:
    with pytest.raises(NotSimulatedYet, match=f"<{element}> is read, not simulated yet"):
        spec.bind(FakeWorld({"b": FakeBody()}))
