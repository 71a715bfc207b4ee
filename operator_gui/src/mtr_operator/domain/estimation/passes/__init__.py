"""Autolock: where a standing key is noticed, and how late, from passes of a moving one."""
# SPDX-License-Identifier: Apache-2.0
