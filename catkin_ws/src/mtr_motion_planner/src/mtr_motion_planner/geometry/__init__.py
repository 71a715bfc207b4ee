"""Circles, routes and curves, and the areas that they have to avoid."""
# SPDX-License-Identifier: Apache-2.0
