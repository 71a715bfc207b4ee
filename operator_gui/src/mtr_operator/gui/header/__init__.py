"""The bar at the top of the main window."""
# SPDX-License-Identifier: Apache-2.0
