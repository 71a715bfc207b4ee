"""Benchmark of the preflight's checks in motion: right and wrong robots, driven manually in the simulation."""
# SPDX-License-Identifier: Apache-2.0
