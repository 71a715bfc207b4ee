"""Errors of the store; each text is a sentence for a person, as in the application.

StoreError
├── StoreAway        unreachable, locked or full: tests wait in the spool
└── OtherContents    the store has this test with other contents
"""
# SPDX-License-Identifier: Apache-2.0
from mtr_operator.domain.errors import OperatorError


class StoreError(OperatorError):
    """The store cannot execute the request."""


class StoreAway(StoreError):
    """The store cannot be reached or written at present; it may be later."""


class OtherContents(StoreError):
    """The store has other contents under the key of this test."""
