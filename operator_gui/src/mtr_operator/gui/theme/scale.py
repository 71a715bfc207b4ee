"""Sizes: one scale of spaces in pixels of a 96 dpi screen, one of type in points."""
# SPDX-License-Identifier: Apache-2.0
XS, S, M, L, XL = 4, 8, 16, 24, 40

SMALL_PT = 11.0
TABLE_PT = 12.0
BODY_PT = 13.0
LARGE_PT = 16.0
HEADING_PT = 20.0
TITLE_PT = 27.0

# A finger in a glove, or a mouse on a shaking laptop.
CONTROL_HEIGHT = 44
RADIUS = 8
