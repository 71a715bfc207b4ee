"""Runs this system and two others on a recorded drive."""
# SPDX-License-Identifier: Apache-2.0
