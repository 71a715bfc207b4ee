"""Benchmark of the preflight's checks in motion: right and wrong robots, driven by hand in the simulation."""
# SPDX-License-Identifier: Apache-2.0
