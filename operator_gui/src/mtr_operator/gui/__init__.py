"""Windows of the Operator's application, the only place for Qt."""
# SPDX-License-Identifier: Apache-2.0
