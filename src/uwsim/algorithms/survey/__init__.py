"""Algorithms that survey an area of the bottom: along parallel tracks, with a multibeam sonar.

`tracks` plans and follows the tracks, `bottom_map` collects the soundings, `bottom_survey` has the
algorithms, which differ in how they know where the vehicle is.
"""
