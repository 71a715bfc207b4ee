"""Results database: stores tests of the Operator's application, compares them and writes reports."""
# SPDX-License-Identifier: Apache-2.0
