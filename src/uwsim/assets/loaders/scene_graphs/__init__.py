"""Readers of scene graphs in text: VRML 97 and X3D.

Each reader makes a tree of `node.Node`; `vrml_shapes` makes triangles of it.
"""
