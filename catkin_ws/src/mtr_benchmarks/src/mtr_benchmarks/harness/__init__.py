"""Shared parts of all benchmarks: table rows with limits, output files and lines, and measured processes."""
# SPDX-License-Identifier: Apache-2.0
