"""Runs the robot for hours of its time with random faults, and checks for growing resources and decreasing accuracy."""
# SPDX-License-Identifier: Apache-2.0
