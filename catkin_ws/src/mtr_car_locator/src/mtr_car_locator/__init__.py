"""Finds the Car in the LiDAR data: its pose in map and its dimensions."""
# SPDX-License-Identifier: Apache-2.0
