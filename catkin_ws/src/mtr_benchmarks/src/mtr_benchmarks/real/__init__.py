"""Localization on recordings of real robots, where there are any: the project has none of them."""
# SPDX-License-Identifier: Apache-2.0
