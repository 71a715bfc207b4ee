"""The store: opened, written, read, and what waits for it."""
# SPDX-License-Identifier: Apache-2.0
