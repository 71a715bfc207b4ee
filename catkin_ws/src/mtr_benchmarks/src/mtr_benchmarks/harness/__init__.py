"""What all benchmarks share: rows of a table with limits, their files and lines, and processes that are measured."""
# SPDX-License-Identifier: Apache-2.0
