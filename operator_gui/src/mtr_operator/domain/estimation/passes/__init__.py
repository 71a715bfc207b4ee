"""Autolock: static detection boundary of the key and the Car's reaction time, from passes of a moving key."""
# SPDX-License-Identifier: Apache-2.0
