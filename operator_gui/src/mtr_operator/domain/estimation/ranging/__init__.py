"""What distances that somebody else reports are worth beside measured ones."""
# SPDX-License-Identifier: Apache-2.0
