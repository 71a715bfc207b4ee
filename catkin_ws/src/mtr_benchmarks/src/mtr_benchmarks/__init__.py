"""Benchmarks of localization, motion, simulation and the serial line."""
# SPDX-License-Identifier: Apache-2.0
