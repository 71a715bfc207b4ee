"""Columns of results.csv that no scenario stores itself."""
# SPDX-License-Identifier: Apache-2.0
