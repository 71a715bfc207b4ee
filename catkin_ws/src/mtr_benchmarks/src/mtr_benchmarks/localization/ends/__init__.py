"""Whether the published ends of a Car are as uncertain as they are wrong."""
# SPDX-License-Identifier: Apache-2.0
