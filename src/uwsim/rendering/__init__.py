"""The rendering room: models in, images through water out.

The modules are imported where they are used: `renderer` needs OpenGL, `noise` and `grey` numba,
`water` only numpy.
"""
