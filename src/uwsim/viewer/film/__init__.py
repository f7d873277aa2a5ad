"""Films of recorded trials: a view from outside, a camera's image, curves and a clock."""
