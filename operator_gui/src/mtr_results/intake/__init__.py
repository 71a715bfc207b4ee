"""Conversion of test files to rows of the store."""
# SPDX-License-Identifier: Apache-2.0
