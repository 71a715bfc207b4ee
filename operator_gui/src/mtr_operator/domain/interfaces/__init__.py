"""Optional interfaces of the links and of scenarios, each for one kind of client."""
# SPDX-License-Identifier: Apache-2.0
