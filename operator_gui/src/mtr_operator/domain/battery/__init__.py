"""Charge of the robot's battery: its levels, and what a test does at the critical one."""
# SPDX-License-Identifier: Apache-2.0
