"""Efficient second-order minimisation (ESM) and related methods, independent of the bus."""
