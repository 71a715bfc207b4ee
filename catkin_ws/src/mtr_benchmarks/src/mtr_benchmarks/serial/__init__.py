"""Benchmark of the serial line: round trips to the flashed firmware on an emulated board."""
# SPDX-License-Identifier: Apache-2.0
