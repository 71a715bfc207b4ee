"""Benchmarks of single parts that need no ROS master: one module each, with a function that returns its figures."""
# SPDX-License-Identifier: Apache-2.0
