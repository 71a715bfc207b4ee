"""Comparison of wheels, LiDARs, gyro and accelerometer while the robot is driven by hand."""
# SPDX-License-Identifier: Apache-2.0
