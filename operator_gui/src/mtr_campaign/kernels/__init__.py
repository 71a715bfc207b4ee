"""Kernels, each of which simulates one test."""
# SPDX-License-Identifier: Apache-2.0
