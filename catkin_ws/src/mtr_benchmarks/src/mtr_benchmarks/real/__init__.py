"""Localization on recordings of real robots; the project does not include any."""
# SPDX-License-Identifier: Apache-2.0
