"""Service mode in a Status."""
# SPDX-License-Identifier: Apache-2.0
import math

from mtr_proto import robot_link_pb2 as link

from ..service.mode import ServiceState
from .texts import problem_messages


def add_service(message: link.ServiceMode, state: ServiceState) -> None:
    """Fill the state."""
    message.active, message.id = state.is_active, state.id
    message.problems.extend(problem_messages(state.problem))
    if not math.isnan(state.robot_agrees_s):
        message.robot_agrees_s = max(state.robot_agrees_s, 0.0)
    if not math.isnan(state.operator_agrees_s):
        message.operator_agrees_s = max(state.operator_agrees_s, 0.0)
