"""Algorithms that inspect a net for holes.

`hole_detector` finds gaps between twines in images, `net_plane` finds the net in the scans
of a sonar, `hole_chart` collects what was seen, and `net_inspection` has the algorithms.
"""
