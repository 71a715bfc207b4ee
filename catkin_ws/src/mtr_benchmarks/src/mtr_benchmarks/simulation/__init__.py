"""Benchmark of the simulation's speed: physics and sensors alone, and the whole stack."""
# SPDX-License-Identifier: Apache-2.0
