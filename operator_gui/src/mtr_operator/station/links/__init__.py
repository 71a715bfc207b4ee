"""The thread of the links: robot and Car between two tests and during one."""
# SPDX-License-Identifier: Apache-2.0
