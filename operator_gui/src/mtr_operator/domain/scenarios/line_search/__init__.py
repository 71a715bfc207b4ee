"""Lines that are measured by search: an attempt where it tells most, until the border's interval is as wanted."""
# SPDX-License-Identifier: Apache-2.0
