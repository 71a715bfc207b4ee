"""Sentences of the application's domain and links, with {} for what varies."""
# SPDX-License-Identifier: Apache-2.0
from PyQt5.QtCore import QT_TRANSLATE_NOOP

from ..events import sentences as events
from . import cars, figures, handle, identity, keeping, learn, limits, pairing, passes
from .bus import can, logs
from .keys import phone, relay
from .safety import area, service, supervision

SENTENCES = (
    QT_TRANSLATE_NOOP("Sentence", "A test is being measured: stop it first, then open or begin another one."),
    QT_TRANSLATE_NOOP("Sentence", "wait for robot and Car"),
    QT_TRANSLATE_NOOP("Sentence", "move the key to {} cm"),
    QT_TRANSLATE_NOOP("Sentence", "map the Car"),
    QT_TRANSLATE_NOOP("Sentence", "the robot stands still"),
    QT_TRANSLATE_NOOP("Sentence", "the robot does not confirm that it stands still; without an application it stops"
                                  " by itself"),
    QT_TRANSLATE_NOOP("Sentence", "axis {} ({}): go to the start"),
    QT_TRANSLATE_NOOP("Sentence", "approach until the Car unlocks"),
    QT_TRANSLATE_NOOP("Sentence", "retreat until the Car locks"),
    QT_TRANSLATE_NOOP("Sentence", "radial {} ({}): go to the start"),
    QT_TRANSLATE_NOOP("Sentence", "zone {} ({})"),
    QT_TRANSLATE_NOOP("Sentence", "press at {} m"),
    QT_TRANSLATE_NOOP("Sentence", "{} presses on each radial reach an interval of {} m where the Car's range ends "
                                  "within {} m; interval_m asks for {} m: allow {} presses (attempts_limit), or ask "
                                  "for {} m."),
    QT_TRANSLATE_NOOP("Sentence", "{} presses on each radial reach an interval of {} m where the Car's range ends "
                                  "within {} m; interval_m asks for {} m: ask for {} m."),
    QT_TRANSLATE_NOOP("Sentence", "move the key so that it does not sleep"),
    QT_TRANSLATE_NOOP("Sentence", "The key has answered nowhere on {} radials one after the other; see whether it "
                                  "sleeps, whether its battery is empty and whether it is the Car's key, then continue "
                                  "the test, or begin one with a smaller minimum_distance_m."),
    QT_TRANSLATE_NOOP("Sentence", "The key has answered nowhere in {} zones one after the other; see whether it "
                                  "sleeps, whether its battery is empty and whether it is the Car's key, then continue "
                                  "the test, or begin one with a smaller minimum_distance_m."),
    QT_TRANSLATE_NOOP("Sentence", "No press worked in this zone, not at its nearest places either: the key sleeps, its "
                                  "battery is empty, or the Car's range ends nearer; then decrease "
                                  "minimum_distance_m."),
    QT_TRANSLATE_NOOP("Sentence", "{} presses in each zone reach an interval of the coverage of {} %; coverage_percent "
                                  "asks for {} %: allow {} presses (presses_limit), or ask for {} %."),
    QT_TRANSLATE_NOOP("Sentence", "{} presses in each zone reach an interval of the coverage of {} %; coverage_percent "
                                  "asks for {} %: ask for {} %."),
    QT_TRANSLATE_NOOP("Sentence", "Parameter minimum_distance_m leaves {} m up to the first press at {} m; the method "
                                  "adaptive needs {} m."),
    QT_TRANSLATE_NOOP("Sentence", "Parameter {} is {}; allowed is {} or {}."),
    QT_TRANSLATE_NOOP("Sentence", "The Car's lock state is unknown: {}"),
    QT_TRANSLATE_NOOP("Sentence", "The bus does not carry it."),
    QT_TRANSLATE_NOOP("Sentence", "The Car fell silent: {}"),
    QT_TRANSLATE_NOOP("Sentence", "The robot did not start within {} s. {}"),
    QT_TRANSLATE_NOOP("Sentence", "The robot did not start within {} s."),
    QT_TRANSLATE_NOOP("Sentence", "The robot did not find the Car within {} s. {}"),
    QT_TRANSLATE_NOOP("Sentence", "The robot did not find the Car within {} s."),
    QT_TRANSLATE_NOOP("Sentence", "The robot is controlled by another application; end that one, then start again."),
    QT_TRANSLATE_NOOP("Sentence", "No test begins, because the robot's preflight found: {} Mend it, then run "
                                  "`rosrun mtr_commissioning preflight` on the robot again."),
    QT_TRANSLATE_NOOP("Sentence", "The robot's battery is nearly empty ({} %); charge it, then begin the test."),
    QT_TRANSLATE_NOOP("Sentence", "The robot does not report the charge of its battery; check the topic of its battery,"
                                  " then begin the test."),
    QT_TRANSLATE_NOOP("Sentence", "The robot's battery is critical; charge the robot, then continue."),
    QT_TRANSLATE_NOOP("Sentence", "the battery is critical: lower the key"),
    QT_TRANSLATE_NOOP("Sentence", "return to the start place"),
    QT_TRANSLATE_NOOP("Sentence", "the robot stays here: its start place is not known"),
    QT_TRANSLATE_NOOP("Sentence", "the robot stays here: {}"),
    QT_TRANSLATE_NOOP("Sentence", "The robot has no hand-held emergency stop, so no test begins. Start it with its "
                                  "controller (controller:=true)."),
    QT_TRANSLATE_NOOP("Sentence", "The Remote key did not reach the height of {} cm within {} s; it is at {} cm."),
    QT_TRANSLATE_NOOP("Sentence", "The robot refused the waypoint: {}"),
    QT_TRANSLATE_NOOP("Sentence", "The robot did not reach the waypoint within {} s. {}"),
    QT_TRANSLATE_NOOP("Sentence", "The robot did not reach the waypoint within {} s."),
    QT_TRANSLATE_NOOP("Sentence", "The button could not be pressed: {}"),
    QT_TRANSLATE_NOOP("Sentence", "The robot did not confirm a button press within {} s."),
    QT_TRANSLATE_NOOP("Sentence", "No poses of the robot enclose the instant {} s."),
    QT_TRANSLATE_NOOP("Sentence", "The robot's pose is unknown for {} s around the instant {} s."),
    QT_TRANSLATE_NOOP("Sentence", "The progress file holds {} {}; this test has {}."),
    QT_TRANSLATE_NOOP("Sentence", "The Car was still unlocked {} s after the robot had reached the starting "
                                  "distance of {} m; lock it with its key, or increase maximum_distance_m if it "
                                  "locks farther away."),
    QT_TRANSLATE_NOOP("Sentence", "the robot stands until you have it go on"),
    QT_TRANSLATE_NOOP("Sentence", "The robot has been silent for {} s; check the Wi-Fi and that its software runs."),
    QT_TRANSLATE_NOOP("Sentence", "The robot has been silent for {} s; check the Wi-Fi and that its software runs. {}"),
    QT_TRANSLATE_NOOP("Sentence", "The robot's clock is {} ahead of this laptop's: distances do not depend on it, dates"
                                  " in the robot's logs do; set the one that is wrong, or have the laptop take the "
                                  "robot's (docs/robot-setup.md, Clocks)."),
    QT_TRANSLATE_NOOP("Sentence", "The robot's clock is {} behind this laptop's: distances do not depend on it, dates"
                                  " in the robot's logs do; set the one that is wrong, or have the laptop take the "
                                  "robot's (docs/robot-setup.md, Clocks)."),
    QT_TRANSLATE_NOOP("Sentence", "Status {} was ignored: {}"),
    QT_TRANSLATE_NOOP("Sentence", "The robot no longer takes this application's Commands: another application has "
                                  "controlled it meanwhile, or goodbye was said in this one's name; connect again, or "
                                  "go on with a continued test."),
    QT_TRANSLATE_NOOP("Sentence", "The robot's ports are open, but no Status has come for {} s; check that both "
                                  "ports are the robot's. {}"),
    QT_TRANSLATE_NOOP("Sentence", "The robot's ports are open, but no Status has come for {} s; check that both "
                                  "ports are the robot's."),
    QT_TRANSLATE_NOOP("Sentence", "The laptop slept for {} s, and the robot stood meanwhile."),
    QT_TRANSLATE_NOOP("Sentence", "The application stood still for {} s, and the robot stood meanwhile."),
    QT_TRANSLATE_NOOP("Sentence", "The window did not react for {} s, nor would its Stop have: the robot was "
                                  "stopped."),
    QT_TRANSLATE_NOOP("Sentence", "{} The line at hand is measured anew when the test goes on."),
    QT_TRANSLATE_NOOP("Sentence", "The robot started anew during the test; the measured lines are kept, go on with "
                                  "a continued test."),
    QT_TRANSLATE_NOOP("Sentence", "Another application has taken over the control of the robot."),
    QT_TRANSLATE_NOOP("Sentence", "The test was interrupted."),
    QT_TRANSLATE_NOOP("Sentence", "The line was skipped by the Operator."),
    QT_TRANSLATE_NOOP("Sentence", "The link to the robot was interrupted for {} s."),
    QT_TRANSLATE_NOOP("Sentence", "The link to the robot was interrupted: {}"),
    QT_TRANSLATE_NOOP("Sentence", "The robot does not know its position relative to the Car."),
    QT_TRANSLATE_NOOP("Sentence", "The robot had a fault: {}"),
    QT_TRANSLATE_NOOP("Sentence", "The Car does not say whether it is locked."),
    QT_TRANSLATE_NOOP("Sentence", "The robot has restarted; the present order was sent to it again."),
    QT_TRANSLATE_NOOP("Sentence", "The robot is not connected."),
    QT_TRANSLATE_NOOP("Sentence", "Parameter {} is {}; it has to be below {}, {}."),
    QT_TRANSLATE_NOOP("Sentence", "Parameter {} is {}; allowed is at most {}, {}."),
    QT_TRANSLATE_NOOP("Sentence", "Parameter {} is {}; allowed is clearance_m, {}, and more."),
    QT_TRANSLATE_NOOP("Sentence", "Parameter {} is {}; allowed is {}."),
    QT_TRANSLATE_NOOP("Sentence", "Parameter {} is {}; allowed are {}."),
    QT_TRANSLATE_NOOP("Sentence", "Parameter {} is {}; {}"),
    QT_TRANSLATE_NOOP("Sentence", "Parameter {} is unknown; {}"),
    QT_TRANSLATE_NOOP("Sentence", "allowed is a number, {}."),
    QT_TRANSLATE_NOOP("Sentence", "write a decimal point: {}."),
    QT_TRANSLATE_NOOP("Sentence", "did you mean {}?"),
    QT_TRANSLATE_NOOP("Sentence", "known are {}."),
    QT_TRANSLATE_NOOP("Sentence", "Parameter minimum_distance_m is {} m; on the radial of {} degrees that leaves {}"
                                  " m between Remote key and Car, and clearance_m, {} m, has to remain."),
    QT_TRANSLATE_NOOP("Sentence", "The test cannot be continued from {}. {}"),
    QT_TRANSLATE_NOOP("Sentence", "There is no test in {}."),
    QT_TRANSLATE_NOOP("Sentence", "It is not a progress file of this application."),
    QT_TRANSLATE_NOOP("Sentence", "It is not a progress file of this application, or of a scenario that it does not"
                                  " know."),
    QT_TRANSLATE_NOOP("Sentence", "It has version {}; this application reads version {}."),
    QT_TRANSLATE_NOOP("Sentence", "It belongs to the scenario {}, not to {}."),
    QT_TRANSLATE_NOOP("Sentence", "It is damaged: the parameters are missing."),
    QT_TRANSLATE_NOOP("Sentence", "It is damaged: parts of it are missing or of the wrong kind."),
    QT_TRANSLATE_NOOP("Sentence", "It was measured with other parameters: {} was {}, now it is {}."),
    QT_TRANSLATE_NOOP("Sentence", "It is larger than {} MiB."),
    *keeping.SENTENCES,
    *limits.SENTENCES, *identity.SENTENCES, *pairing.SENTENCES,
    *can.SENTENCES, *logs.SENTENCES, *handle.SENTENCES, *passes.SENTENCES, *figures.SENTENCES, *learn.SENTENCES,
    *area.SENTENCES,
    *cars.SENTENCES, *supervision.SENTENCES + service.SENTENCES, *events.SENTENCES, *phone.SENTENCES, *relay.SENTENCES,
    QT_TRANSLATE_NOOP("Sentence", "It cannot be read: {}."),
    QT_TRANSLATE_NOOP("Sentence", "It is truncated or not a JSON file."),
    QT_TRANSLATE_NOOP("Sentence", "The progress file belongs to another Car: its {} was {} m, now it measures {} m. "
                                  "Continue the test at the Car with which it was begun, or begin a new one."),
    QT_TRANSLATE_NOOP("Sentence", "The file {} cannot be written: {}."),
    QT_TRANSLATE_NOOP("Sentence", "Results cannot be written to the folder {}: {}."),
    QT_TRANSLATE_NOOP("Sentence", "The settings in {} were not used. {}"),
    QT_TRANSLATE_NOOP("Sentence", "The settings cannot be kept: {}"),
    QT_TRANSLATE_NOOP("Sentence", "They are of another format or version."),
    QT_TRANSLATE_NOOP("Sentence", "They are damaged."),
    QT_TRANSLATE_NOOP("Sentence", "They cannot be read."),
    QT_TRANSLATE_NOOP("Sentence", "The application has a defect: {}: {}"),
    QT_TRANSLATE_NOOP("Sentence", "Robot address is {}; allowed is an IPv4 address or a host name."),
    QT_TRANSLATE_NOOP("Sentence", "Robot address is {}; an IPv4 address is four numbers from 0 to 255 with dots "
                                  "between them."),
    QT_TRANSLATE_NOOP("Sentence", "The {} is {}; allowed is a whole number from {} to {}."),
    QT_TRANSLATE_NOOP("Sentence", "The {} is {}; allowed is a whole number."),
    QT_TRANSLATE_NOOP("Sentence", "Subscriber port and publisher port are both {}; the robot uses two different "
                                  "ones."),
    QT_TRANSLATE_NOOP("Sentence", "The package mtr_proto, the contract with the robot, is not installed; pip install "
                                  "the folder proto of the project."),
    QT_TRANSLATE_NOOP("Sentence", "No host of the name {} is known; check the robot's address."),
    QT_TRANSLATE_NOOP("Sentence", "No answer from {} within {} s; check the address, the Wi-Fi and that the robot "
                                  "is on."),
    QT_TRANSLATE_NOOP("Sentence", "Nothing listens on {}; check the port and that the robot's software runs."),
    QT_TRANSLATE_NOOP("Sentence", "Cannot reach {}: {}."),
    QT_TRANSLATE_NOOP("Sentence", "The {} port {} is open, but not the robot's; subscriber and publisher port may "
                                  "be swapped, the robot's link may be encrypted, or another program listens there."),
    QT_TRANSLATE_NOOP("Sentence", "CAN interface is {}; allowed are {}."),
    QT_TRANSLATE_NOOP("Sentence", "CAN channel is empty; give the adapter's port, e.g. /dev/ttyACM0, can0 or "
                                  "PCAN_USBBUS1."),
    QT_TRANSLATE_NOOP("Sentence", "CAN bit rate is {}; allowed is {} to {} bit/s."),
    QT_TRANSLATE_NOOP("Sentence", "There is no CAN adapter at {}; check the channel and the USB plug."),
    QT_TRANSLATE_NOOP("Sentence", "{} is no serial port; give the CAN adapter's, e.g. /dev/ttyACM0."),
    QT_TRANSLATE_NOOP("Sentence", "Cannot open the {} at {} bit/s: {}."),
    QT_TRANSLATE_NOOP("Sentence", "The {} has gone: {}."),
    QT_TRANSLATE_NOOP("Sentence", "The {} sends something else than the slcan protocol; check the channel, and that"
                                  " the device is a CAN adapter."),
    QT_TRANSLATE_NOOP("Sentence", "The {} does not answer; check the channel, and that the device is a CAN adapter."),
    QT_TRANSLATE_NOOP("Sentence", "CAN adapter {} ({})"),
    QT_TRANSLATE_NOOP("Sentence", "another program uses it"),
    QT_TRANSLATE_NOOP("Sentence", "The CAN bus has errors ({} error frames); check bit rate, plug and termination."),
    QT_TRANSLATE_NOOP("Sentence", "The Car's CAN bus is not connected."),
    QT_TRANSLATE_NOOP("Sentence", "No CAN adapter is chosen."),
    QT_TRANSLATE_NOOP("Sentence", "No CAN frame for {} s; check the plug, the bit rate and that the Car is awake."),
    QT_TRANSLATE_NOOP("Sentence", "No message {} (id 0x{}) for {} s although the CAN bus is alive; check the car "
                                  "profile."),
    QT_TRANSLATE_NOOP("Sentence", "The clock of the CAN frames is not mapped to the robot's yet; this takes about "
                                  "two seconds."),
    QT_TRANSLATE_NOOP("Sentence", "The robot's clock was set; the clock of the CAN frames is mapped to it anew, which "
                                  "takes about two seconds."),
    QT_TRANSLATE_NOOP("Sentence", "The clock of the CAN adapter jumped; it is mapped to the robot's anew, which takes "
                                  "about two seconds."),
    QT_TRANSLATE_NOOP("Sentence", "Frames or messages of the robot are late, or a clock was set; the time at which the "
                                  "locks changed is not known yet."),
    QT_TRANSLATE_NOOP("Sentence", "The instant of the event is not known."),
    QT_TRANSLATE_NOOP("Sentence", "The CAN adapter reports errors on the bus or has left it (bus-off); check bit "
                                  "rate, plug and termination."),
    QT_TRANSLATE_NOOP("Sentence", "The CAN adapter is error-passive; check bit rate, plug and termination."),
    QT_TRANSLATE_NOOP("Sentence", "The CAN adapter has failed: {}."),
    QT_TRANSLATE_NOOP("Sentence", "There is no car profile {}; shipped are: {}; a path to a YAML file works too."),
    QT_TRANSLATE_NOOP("Sentence", "Car profile {}: states must name a value for locked and one for unlocked."),
    QT_TRANSLATE_NOOP("Sentence", "Car profile {} is no table of names and values."),
    QT_TRANSLATE_NOOP("Sentence", "Car profile {} has a text of more than {} characters."),
    QT_TRANSLATE_NOOP("Sentence", "Car profile {}: source_signal and sources belong together; give both or none."),
    QT_TRANSLATE_NOOP("Sentence", "Car profile {}: {} must be a table from raw value to {}."),
    QT_TRANSLATE_NOOP("Sentence", "Car profile {}: {} is {}; allowed is {} to {} s."),
    QT_TRANSLATE_NOOP("Sentence", "Car profile {} cannot be read: {}."),
    QT_TRANSLATE_NOOP("Sentence", "Car profile {}: unknown entry {}; allowed are {}."),
    QT_TRANSLATE_NOOP("Sentence", "Car profile {} lacks the entry {}."),
    QT_TRANSLATE_NOOP("Sentence", "Car profile {}: {} has {}: {}; allowed is a whole number with {}."),
    QT_TRANSLATE_NOOP("Sentence", "Message {} of CAN database {} has no signal {}."),
    QT_TRANSLATE_NOOP("Sentence", "Message {} of CAN database {} has no signal {}; not all of it could be read: {}."),
    QT_TRANSLATE_NOOP("Sentence", "Message {} of CAN database {} has no signal {}; message {}, line {}, could not be "
                                  "read: {}."),
    QT_TRANSLATE_NOOP("Sentence", "CAN database {} has no message {}."),
    QT_TRANSLATE_NOOP("Sentence", "CAN database {} has no message {}; not all of it could be read: {}."),
    QT_TRANSLATE_NOOP("Sentence", "CAN database {} has no message {}; message {}, line {}, could not be read: {}."),
    QT_TRANSLATE_NOOP("Sentence", "CAN database {} cannot be read: {}."),
    QT_TRANSLATE_NOOP("Sentence", "A message of {} bytes was ignored; allowed is at most {} bytes."),
    QT_TRANSLATE_NOOP("Sentence", "A message was ignored: {}"),
    QT_TRANSLATE_NOOP("Sentence", "wait for the robot"),
    QT_TRANSLATE_NOOP("Sentence", "check where the Car stands"),
    QT_TRANSLATE_NOOP("Sentence", "warning: the robot's software is too old to check where the Car stands; it is "
                                  "taken as it is"),
    QT_TRANSLATE_NOOP("Sentence", "Without length and width of the Car's data sheet the distances may be up to {} cm "
                                  "too long: the Car may be wider above the height at which the LiDARs see it. Start "
                                  "the robot with car_file, and map the Car again."),
    QT_TRANSLATE_NOOP("Sentence", "The Car's sides are known to (95 %): {}; distances from them may be wrong by that "
                                  "much. Fill in {} (data sheet or tape measure) in the robot's car_file, restart the "
                                  "robot with it, and map the Car again."),
    QT_TRANSLATE_NOOP("Sentence", "The Car's {} is known to {} cm only (95 %); the robot may touch it nearer than {} "
                                  "m. Fill in {} (data sheet or tape measure) in the robot's car_file, restart the "
                                  "robot with it, and map the Car again."),
    QT_TRANSLATE_NOOP("Sentence", "The robot has not found the Car yet, so there is nothing to check; a test begins"
                                  " with it."),
    QT_TRANSLATE_NOOP("Sentence", "The robot's software is too old to check where the Car stands."),
    QT_TRANSLATE_NOOP("Sentence", "The robot did not check the Car within {} s. {}"),
    QT_TRANSLATE_NOOP("Sentence", "The robot did not check the Car within {} s."),
    QT_TRANSLATE_NOOP("Sentence", "The test does not begin. {}"),
    QT_TRANSLATE_NOOP("Sentence", "The Car coordinate system was corrected during the measurement."),
    QT_TRANSLATE_NOOP("Sentence", "The Car's bus is not connected."),
)
