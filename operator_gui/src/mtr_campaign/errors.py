"""Error of campaigns; its text is a sentence for a person, as in the application."""
# SPDX-License-Identifier: Apache-2.0
from mtr_operator.domain.errors import OperatorError


class CampaignError(OperatorError):
    """The plan or the campaign cannot be executed."""
