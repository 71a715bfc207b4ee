"""Predefined studies, each with a plan and a picture of the results."""
# SPDX-License-Identifier: Apache-2.0
