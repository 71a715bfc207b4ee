"""Error of campaigns; its text is a sentence for a person, as those of the application."""
# SPDX-License-Identifier: Apache-2.0
from mtr_operator.domain.errors import OperatorError


class CampaignError(OperatorError):
    """The plan or the campaign cannot do what is asked for."""
