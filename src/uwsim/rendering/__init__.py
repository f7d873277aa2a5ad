"""Rendering: images of models seen through water.

The modules are imported where they are used: `renderer` needs OpenGL, `noise` and `grey` numba,
`water` only numpy.
"""
