"""Checks, calibration and release of a robot before its tests."""
