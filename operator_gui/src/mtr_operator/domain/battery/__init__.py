"""Charge of the robot's battery: its levels, and the retreat at the critical one."""
# SPDX-License-Identifier: Apache-2.0
