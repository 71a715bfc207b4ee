"""Checks before the robot moves, item by item."""
# SPDX-License-Identifier: Apache-2.0
