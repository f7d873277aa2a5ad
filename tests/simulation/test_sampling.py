import numpy as np
import pytest

from uwsim.base.sampling import Sample, Sampling, gather_sampler, number_addresses, sample_step
from uwsim.bus import Bus
from uwsim.simulation.schedule import Schedule


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


def test_a_sample_that_is_not_needed_is_neither_taken_nor_published() -> None:
    """Also where a reader comes during the step: there is nothing to publish."""
    values, is_read, calls = np.array([3.0]), [False], []
    prepare, can_skip_prepare = (lambda _: None), (lambda _: True)
    sampler = gather_sampler(
        number_addresses(values), prepare=prepare, can_skip_prepare=can_skip_prepare
    )
    sample, schedule = Sample.create(sampler), Schedule(Bus(), 0.002)
    schedule.create_timer(100.0, lambda: is_read.__setitem__(0, True))
    sampling = Sampling(sampler, sample, lambda: is_read[0])
    schedule.create_timer(100.0, lambda: calls.append(sample.numbers.tolist()), sampling=sampling)
    schedule.tick(0)
    assert np.isnan(sample.numbers).all()
    assert not calls
    schedule.tick(5)
    assert calls == [[0.01, 3.0]]
