"""Rendering: images of models seen through water.

`renderer` draws images with the programs in ``shaders/``. `water` defines the model of attenuation
and fog, which ``shaders/water.glsl`` computes for each pixel; `frame` passes its parameters to the
shaders. `noise` and `grey` process a rendered image. Import the modules where they are used:
`renderer` needs OpenGL, `noise` and `grey` need numba, `water` only numpy.
"""
