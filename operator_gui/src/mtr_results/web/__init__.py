"""Web server for the store."""
# SPDX-License-Identifier: Apache-2.0
