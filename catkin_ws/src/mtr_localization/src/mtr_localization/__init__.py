"""Python tools of localization: offline replay."""
# SPDX-License-Identifier: Apache-2.0
