"""Honest Car: fading, polling, random misses, key sleep and bus cycles as in real cars."""
# SPDX-License-Identifier: Apache-2.0
