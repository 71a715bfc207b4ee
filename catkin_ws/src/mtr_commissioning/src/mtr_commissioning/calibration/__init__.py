"""Guided calibration of the robot: a person's readings become dated entries of its calibration record."""
# SPDX-License-Identifier: Apache-2.0
