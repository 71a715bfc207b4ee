"""A Car that tells more than its locks: its database and profile, and its link on virtual buses."""
# SPDX-License-Identifier: Apache-2.0


from mtr_operator.car_link.can_frame import CanFrame
from mtr_operator.car_link.lock_watch import LockWatch
from mtr_operator.car_link.profile import load_profile
from mtr_operator.domain.robot_status import RobotStatus

STATE_ID, CAUSE_ID, DOORS_ID, OTHER_ID = 0x120, 0x121, 0x122, 0x123
DATABASE = f"""VERSION ""
BU_: GW
BO_ {STATE_ID} State: 2 GW
 SG_ Page M : 7|2@0+ (1,0) [0|3] "" GW
 SG_ Lock m1 : 5|2@0+ (1,0) [0|3] "" GW
 SG_ Lamp m0 : 5|2@0+ (1,0) [0|3] "" GW
BO_ {CAUSE_ID} Cause: 4 GW
 SG_ Why : 7|4@0+ (1,0) [0|15] "" GW
 SG_ Key : 3|4@0+ (1,0) [0|15] "" GW
 SG_ Events : 8|8@1+ (1,0) [0|255] "" GW
 SG_ Alive : 16|4@1+ (1,0) [0|15] "" GW
BO_ {DOORS_ID} Doors: 1 GW
 SG_ Driver : 0|1@1+ (1,0) [0|1] "" GW
 SG_ Passenger : 1|1@1+ (1,0) [0|1] "" GW
VAL_ {STATE_ID} Lock 0 "locked" 1 "unlocked" 2 "driver" 3 "error" ;
BA_DEF_ BO_ "GenMsgCycleTime" INT 0 10000;
BA_DEF_DEF_ "GenMsgCycleTime" 0;
BA_ "GenMsgCycleTime" BO_ {CAUSE_ID} 50;
"""
PROFILE = """database: car.dbc
message: State
signal: Lock
states: {0: locked, 1: unlocked, 2: unlocked_driver, 3: unknown}
cycle_time_s: 0.1
"""
CAUSE = "causes: [{message: Cause, signal: Why, sources: {1: passive_entry, 2: key_button}}]\n"
STAYING = CAUSE.replace("}}]", "}, stays: true}]")
COUNTER = "command_signal: {message: Cause, signal: Events}\n"
ALIVE = "alive_signal: {message: Cause, signal: Alive}\n"
KEY = "key_number: {message: Cause, signal: Key, under_test: 3}\n"
DOORS = "doors: {driver: {message: Doors, signal: Driver}, passenger: {message: Doors, signal: Passenger}}\n"


def written(folder, *lines, profile=PROFILE):
    """Path of a profile of these lines, with its database."""
    (folder / "car.dbc").write_text(DATABASE)
    path = folder / "car.yaml"
    path.write_text(profile + "".join(lines))
    return str(path)


class Bench:
    """Frames every 50 ms of robot time, of the state every 100 ms; the robot's clock is the laptop's."""

    def __init__(self, path):
        self.watch = LockWatch(load_profile(path))
        self.now_s, self.step, self.events = 10.0, 0, []
        self.lock, self.page, self.why, self.key, self.count, self.alive, self.doors = 0, 1, 0, 3, 0, 0, 0
        self.is_alive_counting = True
        self.run(4.0)

    def run(self, seconds):
        """Let time pass."""
        for _ in range(round(seconds / 0.05)):
            self.step += 1
            self.now_s = round(10.0 + 0.05 * self.step, 6)
            self.alive += self.is_alive_counting
            self.send(CAUSE_ID, bytes([self.why << 4 | self.key, self.count, self.alive % 16, 0]))
            self.send(DOORS_ID, bytes([self.doors]))
            if self.step % 2 == 0:
                self.send(STATE_ID, bytes([self.page << 6 | self.lock << 4, 0]))
                status = RobotStatus(self.step, 1, self.now_s, sent_s=self.now_s, steady_s=self.now_s)
                self.watch.status(status, self.now_s)
                self.events += self.watch.release(self.now_s)

    def send(self, can_id, data, bus=""):
        """A frame now."""
        self.watch.frame(CanFrame(can_id, False, data, self.now_s, bus=bus))

    def change(self, lock, why=0, count=1, key=3):
        """The locks move; the cause comes with it and goes again. The event."""
        before = len(self.events)
        self.lock, self.why, self.count, self.key = lock, why, self.count + count, key
        self.run(0.2)
        self.why = 0
        self.run(1.3)
        event, = self.events[before:]
        return event
