"""Accuracy of reported distances, such as a phone's, compared with measured ones."""
# SPDX-License-Identifier: Apache-2.0
