"""Benchmark of the published uncertainty of a Car's ends against their errors."""
# SPDX-License-Identifier: Apache-2.0
