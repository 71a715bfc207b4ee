"""Checks of this computer's readiness for tests."""
# SPDX-License-Identifier: Apache-2.0
