"""Radio between the key and the honest Car, one effect per module."""
# SPDX-License-Identifier: Apache-2.0
