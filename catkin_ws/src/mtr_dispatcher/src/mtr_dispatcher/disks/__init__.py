"""The disks that the robot writes to: how much room is enough, and whether one is full."""
# SPDX-License-Identifier: Apache-2.0
