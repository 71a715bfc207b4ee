"""Drives the complete robot toward a wall and a pole while one of its LiDARs fails."""
# SPDX-License-Identifier: Apache-2.0
