"""Clocks of the robot, the CAN adapter and the laptop: maps between them, and detection of clock steps."""
# SPDX-License-Identifier: Apache-2.0
