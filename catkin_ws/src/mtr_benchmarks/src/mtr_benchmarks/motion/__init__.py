"""Benchmark of the robot's motion: tracking, encounters, tip-over and latency."""
# SPDX-License-Identifier: Apache-2.0
