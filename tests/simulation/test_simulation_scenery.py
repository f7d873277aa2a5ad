from pathlib import Path

import numpy as np
import pytest

from uwsim.scene.urdf import VisualSpec
from uwsim.simulation.scenery import visual_model


@pytest.mark.parametrize(
    ("kind", "extent"),
    [("box", (1.0, 2.0, 3.0)), ("cylinder", (0.4, 0.4, 3.0)), ("sphere", (0.5, 0.5, 0.5))],
)
def test_a_shape_of_a_urdf_is_as_large_as_the_urdf_says(
    kind: str, extent: tuple[float, float, float]
) -> None:
    box = visual_model(VisualSpec(kind=kind, size=extent), Path(), ()).box
    assert np.subtract(box.upper, box.lower) == pytest.approx(extent, rel=0.02)
