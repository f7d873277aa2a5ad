"""Efficient second-order minimisation (ESM) and its relatives: the pure core."""
