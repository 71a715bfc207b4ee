"""Tests that begin, and those that were begun and not finished."""
# SPDX-License-Identifier: Apache-2.0
