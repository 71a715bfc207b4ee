"""Access to the link: keys, roles, pairing and rates."""
# SPDX-License-Identifier: Apache-2.0
