"""The store in a browser."""
# SPDX-License-Identifier: Apache-2.0
