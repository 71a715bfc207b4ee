"""Sensors of the robot: readings of its true state, with errors."""
# SPDX-License-Identifier: Apache-2.0
