"""Caustics and light shafts: the sun's beam, refracted at the moving surface of the water."""
