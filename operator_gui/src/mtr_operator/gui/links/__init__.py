"""The window's side of the links: opened, paired, changed."""
# SPDX-License-Identifier: Apache-2.0
