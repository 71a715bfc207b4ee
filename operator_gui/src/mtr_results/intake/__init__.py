"""Tests in files, read as rows of the store's tables."""
# SPDX-License-Identifier: Apache-2.0
