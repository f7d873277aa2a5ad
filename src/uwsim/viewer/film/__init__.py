"""Films of recorded trials: an outside view, the image of a camera, curves and a clock."""
