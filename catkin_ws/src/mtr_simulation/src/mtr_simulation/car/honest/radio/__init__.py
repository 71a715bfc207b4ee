"""What the honest Car's radio does between the key and the Car, one effect a module."""
# SPDX-License-Identifier: Apache-2.0
