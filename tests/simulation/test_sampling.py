import numpy as np
import pytest

from uwsim.base.sampling import sample_step


@pytest.mark.parametrize(
    ("rate", "steps"),
    [(30.0, [0, 17, 34, 50, 67]), (10.0, [0, 50, 100]), (500.0, [0, 1, 2, 3]), (3.0, [0, 167])],
)
def test_samples_fall_on_the_first_step_at_or_after_their_time(
    rate: float, steps: list[int]
) -> None:
    assert [sample_step(n, rate, 0.002) for n in range(len(steps))] == steps


def test_a_camera_takes_its_rate_times_the_time_however_long_it_runs() -> None:
    steps = [sample_step(n, 30.0, 0.002) for n in range(30 * 600)]
    assert steps[-1] == 299984
    assert set(np.diff(steps)) == {16, 17}
