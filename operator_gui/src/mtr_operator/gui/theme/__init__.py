"""Colours, sizes and style sheet."""
# SPDX-License-Identifier: Apache-2.0
