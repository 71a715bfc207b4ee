"""Wheels, LiDARs, gyro and accelerometer against each other while the robot is driven by hand."""
# SPDX-License-Identifier: Apache-2.0
