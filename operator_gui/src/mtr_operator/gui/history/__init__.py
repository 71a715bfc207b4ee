"""Tests of before on the screen: the list, and two of them compared."""
# SPDX-License-Identifier: Apache-2.0
