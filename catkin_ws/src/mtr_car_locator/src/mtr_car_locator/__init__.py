"""Locates the Car in LiDAR data: its pose in map and its dimensions."""
# SPDX-License-Identifier: Apache-2.0
