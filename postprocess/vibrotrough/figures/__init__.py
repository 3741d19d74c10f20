"""Figures of campaigns, of maps of the theory and of calibrations; `draw` is the program's `plot`."""
