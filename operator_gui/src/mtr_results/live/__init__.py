"""Tests that are being measured, from the files that the application writes anyway: nothing is asked of it."""
# SPDX-License-Identifier: Apache-2.0
