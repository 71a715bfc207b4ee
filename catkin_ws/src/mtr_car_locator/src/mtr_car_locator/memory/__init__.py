"""The located Car in a file, with which a locator that is started again goes on."""
# SPDX-License-Identifier: Apache-2.0
