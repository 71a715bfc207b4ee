"""Windows of the Operator's application, the only place for Qt; today a test is run from the command line."""
# SPDX-License-Identifier: Apache-2.0
