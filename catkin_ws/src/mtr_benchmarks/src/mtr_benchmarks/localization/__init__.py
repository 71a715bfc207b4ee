"""Benchmark of localization and Car locator on the simulator's core: drives with sensor data and truth, and figures."""
# SPDX-License-Identifier: Apache-2.0
