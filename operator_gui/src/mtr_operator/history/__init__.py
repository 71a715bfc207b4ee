"""Tests that were measured before: found, searched, and compared with each other."""
# SPDX-License-Identifier: Apache-2.0
