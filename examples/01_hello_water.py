"""Hello, water: one camera looks down at the floor of a tank while the fog rises.

Prints how much of the light from the floor is left behind the fog, beside the law that the
renderer draws, 1 - exp(-(fog * distance)^2), and writes hello-fog-*.png into the current folder.
"""

from math import exp

from PIL import Image

import uwsim

SCENE = "visibility-scene.xml"
CAMERA = "bowtech1"
FOGS = (0.0, 0.4, 0.8, 1.2)  # [1/m]
PIXEL = (120, 220)  # row, column


def main() -> None:
    # Attenuation is a law of its own; without it the fog stands alone.
    with uwsim.load(SCENE, settings={"oceanState.attenuation": "0 0 0"}) as simulation:
        show(simulation)


def show(simulation: uwsim.Simulation) -> None:
    clear = None
    for fog in FOGS:
        simulation.world.set_fog(fog)
        picture = simulation.image(CAMERA)
        row, column = PIXEL
        # The fog's colour has no red: what red there is comes from the floor.
        red = picture.colour[row - 8 : row + 9, column - 8 : column + 9, 0].mean()
        clear = red if clear is None else clear
        distance = picture.range[row, column]  # [m]
        print(
            f"fog {fog:.1f} 1/m, floor at {distance:.2f} m: "
            f"{red / clear:.2f} left, law {exp(-((fog * distance) ** 2)):.2f}"
        )
        Image.fromarray(picture.colour).save(f"hello-fog-{fog:.1f}.png")


if __name__ == "__main__":
    main()
