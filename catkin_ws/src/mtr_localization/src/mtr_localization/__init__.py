"""Localization's tools in Python: offline replay."""
# SPDX-License-Identifier: Apache-2.0
