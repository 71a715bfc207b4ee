"""Commands for profiles of cars."""
# SPDX-License-Identifier: Apache-2.0
