"""Repeated observation of the Car: detection of motion since its measurement."""
# SPDX-License-Identifier: Apache-2.0
