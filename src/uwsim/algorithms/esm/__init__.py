"""Efficient second-order minimisation (ESM) and related methods for aligning images.

The functions are computations on images, without topics.
"""
