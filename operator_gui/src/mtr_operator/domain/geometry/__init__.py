"""Poses, rays around the Car, and their arrangement in the scenarios."""
# SPDX-License-Identifier: Apache-2.0
