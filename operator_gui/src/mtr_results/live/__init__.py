"""Tests in progress, read from the files that the application writes; the application itself is not queried."""
# SPDX-License-Identifier: Apache-2.0
