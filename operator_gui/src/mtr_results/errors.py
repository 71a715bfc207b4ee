"""Errors of the store; each text is a sentence for a person, as those of the application.

StoreError
├── StoreAway        nobody answers, or it is locked or full: tests wait in the spool
└── OtherContents    a test is there already, with other contents
"""
# SPDX-License-Identifier: Apache-2.0
from mtr_operator.domain.errors import OperatorError


class StoreError(OperatorError):
    """The store cannot do what was asked for."""


class StoreAway(StoreError):
    """The store cannot be reached or written now; later it may be."""


class OtherContents(StoreError):
    """Something else is known under the name of this test."""
