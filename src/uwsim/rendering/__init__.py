"""Rendering: images of models seen through water.

`renderer` draws, with the programs in ``shaders/``; `water` has the law of attenuation and fog, as
``shaders/water.glsl`` computes it for each pixel; `frame` hands its numbers to the shaders; `noise`
and `grey` come after the image. The modules are imported where they are used: `renderer` needs
OpenGL, `noise` and `grey` numba, `water` only numpy.
"""
