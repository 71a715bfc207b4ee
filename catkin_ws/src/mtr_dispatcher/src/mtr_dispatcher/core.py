"""The dispatcher without ROS and sockets: bytes and messages in, desired state and Status out."""
# SPDX-License-Identifier: Apache-2.0
import itertools
from dataclasses import replace
from typing import List, Optional, Tuple

from mtr_core.problems import Problem

from . import problems
from .access.gate import ANYBODY, Sender
from .area.keeper import AreaKeeper
from .area.order import corners_from
from .command import Command
from .command_codec import UndecodableError, decode
from .parameters import Parameters
from .sent_statuses import SentStatuses
from .service.mode import ServiceMode
from .session import REJECTIONS, CommandResult, ControlSession, SessionState
from .status.area import AreaReport
from .status.builder import Confirmations, Identity, Report, status_bytes
from .status.car_map import CarMap
from .status.emergency import EmergencyStop
from .status.inputs import Inputs, PoseFields
from .status.interventions import Interventions
from .status.log_buffer import LogBuffer
from .status.notices import ERROR, WARNING, ForeignApplications, Notice, RecentNotices, standing_notices

# Value of DriveStatus.source.
PLANNER = "planner"
# Commands of an application that is gone do not enter service mode.
ENDED = (CommandResult.OUTDATED, CommandResult.ENDED)


class Dispatcher:
    """Judges Commands, determines the desired state, and writes Status.

    Attributes:
        session: control of the robot by one application.
        log: the robot's warnings.
        status_id: newest Status that was written, 0 before the first.
        rejected_messages: undecodable, oversized, expired, refused, foreign or forbidden messages since the start.
        areas: the test area in force.
        service: service mode.
        controller: owner of the key whose Commands count, for texts; empty on a link without keys.
    """

    def __init__(self, parameters: Parameters, identity: Identity, areas: Optional[AreaKeeper] = None,
                 service: Optional[ServiceMode] = None):
        """areas, service: the node passes those that remember; by default the robot starts without an area and outside
        service mode.
        """
        self.service = service or ServiceMode(parameters.service_release_s)
        self.areas = areas or AreaKeeper(not parameters.simulated, corners_from(parameters.test_area_xy))
        self._parameters, self._identity = parameters, identity
        self.session = ControlSession(parameters)
        self.log = LogBuffer()
        self.status_id = 0
        self.rejected_messages = 0
        self.controller = ""
        self._recent, self._foreign = RecentNotices(), ForeignApplications()
        self._sent, self._interventions, self._car_map = SentStatuses(), Interventions(), CarMap()

    def receive(self, data: bytes, now_s: float, sender: Sender = ANYBODY) -> Tuple[Optional[CommandResult], str]:
        """Process one message of the link at a time of the steady clock.

        Returns its result, or None if it is not a Command, and a sentence for the log, which may be empty.
        """
        if sender.refusal:
            return CommandResult.FORBIDDEN, self._reject(Notice("key_refused", WARNING, sender.refusal), now_s)
        try:
            command = decode(data)
        except UndecodableError as error:
            self._reject(Notice("bad_message", WARNING, error.problem), now_s)
            return None, str(error)
        if self.session.owner_of(command.session_id) not in (None, sender.key):
            # Each Status contains the session id, which every paired key can read.
            impostor = Notice("key_refused", WARNING, problems.SESSION_OF_ANOTHER(name=sender.name))
            return CommandResult.FORBIDDEN, self._reject(impostor, now_s)
        before = self.session.session_id
        answered_s = self._sent.answered_s((command.seen_status_id, command.seen_robot_time_s))
        result = self.session.take(command, now_s, answered_s, sender.key)
        if self.session.session_id in (0, command.session_id):
            # The key may have been renamed since its session began.
            self.controller = sender.name if self.session.session_id else ""
        if result in (CommandResult.TAKEN, CommandResult.REPEATED):
            self.areas.take(command.session_id, command.area)
        self._order_service(command, result, now_s)
        if result is CommandResult.FOREIGN:
            self.rejected_messages += 1
            return result, self._foreign.received(self.session.session_id, command.session_id, now_s).text
        if result in REJECTIONS:
            return result, self._reject(self._rejection(result, command), now_s)
        return result, self._event(result, command, before, sender)

    def refused_connections(self, count: int, now_s: float) -> str:
        """Notify the Operator of the connections refused since the start, and return the sentence for the log."""
        notice = Notice("connections_refused", WARNING, problems.CONNECTIONS_REFUSED(count=count))
        self._recent.add(notice, now_s)
        return notice.problem.text

    def connections_cut_off(self, count: int, now_s: float) -> str:
        """Notify the Operator of the connections cut off since the start, and return the sentence for the log."""
        notice = Notice("connections_cut_off", WARNING, problems.CONNECTIONS_CUT_OFF(count=count))
        self._recent.add(notice, now_s)
        return notice.problem.text

    def desired(self, now_s: float) -> SessionState:
        """Return the desired state at now_s of the steady clock."""
        return replace(self.session.desired(now_s), service=self.service.problem)

    def area_problem(self, pose: Optional[PoseFields]) -> Problem:
        """Return why the robot neither maps nor tests because of its test area, for the newest pose."""
        self.areas.observe(pose)
        return self.areas.problem(pose)

    def status(self, inputs: Inputs) -> bytes:
        """Return the next Status."""
        self.status_id += 1
        is_one_map = self._car_map.is_map_of(inputs.pose, inputs.car)
        self._sent.add(self.status_id, inputs.now_s, inputs.steady_s)
        self.session.note_speed(_planned_mps(inputs), inputs.steady_s)
        self._update_service(inputs)
        desired = self.desired(inputs.steady_s)
        standing = standing_notices(desired, inputs, self._parameters)
        return status_bytes(self._identity, Report(
            self.status_id, inputs, self._interventions.update(inputs), self._confirmations(desired, inputs),
            self.rejected_messages, self.controller, self.log.due(),
            itertools.chain(standing, self._foreign.notices(desired.session_id, inputs.steady_s),
                            self._recent.at(inputs.steady_s)),
            self._parameters.lockstep_operator, is_one_map, self._parameters.simulated,
            AreaReport(self.areas, self.area_problem(inputs.pose), desired.session_id, is_one_map),
            self.service.state_at(inputs.steady_s)))

    def confirmed(self, inputs: Inputs) -> List[object]:
        """Return the values that a Status would confirm now; a change makes a Status due at once."""
        mode, peripherals, check = inputs.mode, inputs.peripherals, inputs.check
        return [self.session.session_id, self.session.command.id,
                mode and (mode.mode, mode.waypoint_id, mode.waypoint_result, mode.map_car_id, mode.hold_id),
                inputs.emergency_stop, self.areas.area, self.service.agreements,
                check and (check.id, check.state),
                peripherals and [(press.session_id, press.id) for press in peripherals.presses]]

    def _order_service(self, command: Command, result: CommandResult, now_s: float) -> None:
        """Anybody who may send Commands can enter service mode; only the application in control agrees to leave it."""
        if command.enter_service and result not in ENDED:
            self.service.enter(problems.SERVICE_BY_OPERATOR())
        elif command.leave_service_id and result in (CommandResult.TAKEN, CommandResult.REPEATED):
            self.service.agree_by_operator(command.session_id, command.leave_service_id, now_s)

    def _update_service(self, inputs: Inputs) -> None:
        is_alive = self.session.link_alive(inputs.steady_s)
        self.service.update(inputs.steady_s, self.session.session_id if is_alive else 0,
                            inputs.emergency_stop is EmergencyStop.ENGAGED)

    def _confirmations(self, desired: SessionState, fresh: Inputs) -> Confirmations:
        mapped = fresh.mode.map_car_id if fresh.mode is not None else 0
        checked = fresh.check.id if fresh.check is not None else 0
        return Confirmations(desired.session_id, desired.command.id,
                             self.session.map_orders.id_of(desired.session_id, mapped),
                             self.session.check_orders.id_of(desired.session_id, checked))

    def _reject(self, notice: Notice, now_s: float) -> str:
        self.rejected_messages += 1
        if notice.code != "command_refused":
            self._recent.add(notice, now_s)
        return notice.problem.text

    def _rejection(self, result: CommandResult, command: Command) -> Notice:
        if result is CommandResult.EXPIRED:
            return Notice("command_expired", WARNING, problems.EXPIRED(id=command.id))
        return Notice("command_refused", ERROR, problems.REFUSED(id=command.id, cause=self.session.refusal))

    def _event(self, result: CommandResult, command: Command, session_before: int, sender: Sender) -> str:
        owner = f" of {sender.name}" if sender.name else ""
        if result is CommandResult.ENDED:
            return f"Application {command.session_id:x}{owner} ended its session."
        if self.session.session_id != session_before:
            return f"Application {command.session_id:x}{owner} controls the robot now."
        # The log shows later which Commands the robot executed, and for whom.
        return f"Command {command.id}{owner} was taken." if owner and result is CommandResult.TAKEN else ""


def _planned_mps(inputs: Inputs) -> float:
    """Return the speed without manual control, m/s; 0 if drive control is silent."""
    drive = inputs.drive
    return abs(drive.linear_mps) if drive is not None and drive.source == PLANNER else 0.0
