"""Render the camera that looks down at the floor of a tank, in increasing fog.

The program prints the measured share of the floor's light that passes through the fog, next to the
model of the renderer, exp(-(fog * distance)^2). It writes hello-fog-*.png to the working directory.
"""

from math import exp

from PIL import Image

import uwsim

SCENE = "visibility-scene.xml"
CAMERA = "bowtech1"
FOGS = (0.0, 0.4, 0.8, 1.2)  # [1/m]
PIXEL = (120, 220)  # row, column


def main() -> None:
    # Switch off attenuation, which is modelled separately, to see the effect of fog alone.
    with uwsim.load(SCENE, settings={"oceanState.attenuation": "0 0 0"}) as simulation:
        show(simulation)


def show(simulation: uwsim.Simulation) -> None:
    clear_red = None
    for fog in FOGS:
        simulation.set_fog(fog)
        image = simulation.image(CAMERA)
        row, column = PIXEL
        # The fog's colour has no red, so all red light comes from the floor.
        red = image.colour[row - 8 : row + 9, column - 8 : column + 9, 0].mean()
        clear_red = red if clear_red is None else clear_red
        distance = image.range[row, column]  # [m]
        print(
            f"fog {fog:.1f} 1/m, floor at {distance:.2f} m: "
            f"{red / clear_red:.2f} left, model {exp(-((fog * distance) ** 2)):.2f}"
        )
        Image.fromarray(image.colour).save(f"hello-fog-{fog:.1f}.png")


if __name__ == "__main__":
    main()
