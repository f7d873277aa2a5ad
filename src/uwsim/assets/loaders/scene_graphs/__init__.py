"""Readers of scene graphs in text: VRML 97, X3D, and OpenSceneGraph's .osg and .osgt files.

Each reader makes a tree of `node.Node`; `vrml_shapes` and `osg_shapes` make triangles of it.
"""
