"""A laboratory's memory: tests of the Operator's application in a store, compared with each other and reported."""
# SPDX-License-Identifier: Apache-2.0
