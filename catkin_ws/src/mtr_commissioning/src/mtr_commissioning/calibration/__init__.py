"""Guided calibration of the robot: readings of a person become dated entries of its calibration record."""
# SPDX-License-Identifier: Apache-2.0
