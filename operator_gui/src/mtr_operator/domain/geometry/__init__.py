"""Poses, rays around the Car, and how the scenarios lay them out."""
# SPDX-License-Identifier: Apache-2.0
