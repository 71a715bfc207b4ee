"""A robot that exists only as numbers, behind the fake and the substitute."""
# SPDX-License-Identifier: Apache-2.0
