"""A set-up with synthetic pictures, to try a calibration without a tank."""
