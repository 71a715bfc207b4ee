"""The thesis' integration test: the Remote key reaches a height within 10 % and stays there for 5 s."""
# SPDX-License-Identifier: Apache-2.0
