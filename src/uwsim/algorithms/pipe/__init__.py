"""Algorithms that follow a pipe, a cable or another line on the bottom.

`guidance` has the law, `observed_line` follows the true line of an observation, `line_detector`
finds a line in images, and `camera_line` follows it.
"""
