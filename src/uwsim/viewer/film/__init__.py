"""Films of recorded trials: an external view, the image of a camera, curves and a clock."""
