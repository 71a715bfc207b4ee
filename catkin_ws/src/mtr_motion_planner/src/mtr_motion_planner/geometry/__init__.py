"""Circles, routes and curves, and what they have to stay away from."""
# SPDX-License-Identifier: Apache-2.0
