"""A dispatcher with an adjustable steady clock, for tests of the link."""
# SPDX-License-Identifier: Apache-2.0
from mtr_dispatcher.core import Dispatcher
from mtr_dispatcher.parameters import Parameters
from mtr_dispatcher.status.builder import Identity
from mtr_dispatcher.status.inputs import Inputs
from mtr_proto import robot_link_pb2 as link

START_S = 100.0


class Link:
    """A dispatcher with a steady clock that the test sets; offset_s: the robot's clock minus the steady one."""

    def __init__(self, offset_s=1000.0):
        self.core = Dispatcher(Parameters(), Identity(7, "1.2.3", 0.25, 0.0))
        self.steady_s, self.offset_s = START_S, offset_s

    def status(self, **known):
        data = self.core.status(Inputs(self.steady_s + self.offset_s, steady_s=self.steady_s, **known))
        return link.Status.FromString(data)

    def command(self, answered, number=1, session_id=5, **content):
        data = link.Command(session_id=session_id, id=number, seen_status_id=answered.id,
                            seen_robot_time_s=answered.sent_time_s, **content).SerializeToString()
        return self.core.receive(data, self.steady_s)[0]

    def moves(self):
        return not self.core.desired(self.steady_s).stop_reason
