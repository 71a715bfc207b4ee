"""The way round the Car, and the order to localization to map it."""
# SPDX-License-Identifier: Apache-2.0
