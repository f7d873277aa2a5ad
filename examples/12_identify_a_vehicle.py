"""Fit the drag and added mass of a vehicle to a log of its motion and commands.

The log is simulated here: a BlueROV2 receives random steps along all axes, and its motion is
measured with noise. The first guess of four coefficients is wrong by up to a factor of two.
"""

from dataclasses import replace

import numpy as np

from uwsim.identification import IdentifySettings, identify, make_scene, open_vehicle
from uwsim.identification.parameters import apply_values, choose_parameters
from uwsim.identification.simulated_log import Excitation, simulate_log

NAMES = ("added_mass[surge]", "added_mass[yaw]", "quadratic_damping[surge]", "mass")
FACTORS = np.array([2.0, 0.6, 0.5, 1.0])  # of the first guess; the mass is right


def main() -> None:
    scene = make_scene("bluerov2_heavy")
    log = simulate_log(scene, seed=1, excitation=Excitation(duration=30.0))
    truth = open_vehicle(scene)
    parameters = choose_parameters(NAMES, truth)
    values = np.array([parameter.first_guess for parameter in parameters])
    guess = replace(truth, numbers=apply_values(truth, parameters, FACTORS * values).vehicle)

    result = identify([log], guess, IdentifySettings(free_names=NAMES, n_starts=1, n_folds=2))

    for estimate, value in zip(result.uncertainty.estimates, values, strict=True):
        parameter = estimate.parameter
        error = 100.0 * abs(estimate.value / value - 1.0)
        close = "within 2 %" if error < 2.0 else f"{error:.0f} % off"
        print(f"{parameter.name}: first guess {parameter.first_guess:.3g}, now {close}")
    position = [row for row in result.horizons if row.quantity == "position"][-1]
    ratio = position.first_error / position.fitted_error
    word = "more" if ratio > 5.0 else "less"
    print(f"error after {position.horizon:g} s: {word} than 5 times smaller")


if __name__ == "__main__":
    main()
