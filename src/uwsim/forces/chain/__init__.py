"""The motion of a tether as a chain of point masses, in compiled code.

`line` has the properties of the material, `assembly` the forces on the nodes and their
derivatives, `banded` the solution of the linear equations, `chain_step` the implicit step,
`ground` the surfaces that the nodes touch, and `reel` the segments that a winch pays out.
"""
