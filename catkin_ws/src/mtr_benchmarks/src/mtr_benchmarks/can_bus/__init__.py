"""Benchmark of the application's link to the Car's bus."""
# SPDX-License-Identifier: Apache-2.0
