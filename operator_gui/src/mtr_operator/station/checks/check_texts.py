"""Texts of the checklist: findings and remedies, in English or by the window's translator."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Callable

from mtr_operator.domain.clocks.clock_offset import span_text

from .finding import Check, Finding, Item

# Function of context and text; pylupdate5 finds the texts by this name.
Translate = Callable[[str, str], str]

_CM_PER_M, _MS_PER_S, _MB_PER_GB = 100.0, 1000.0, 1000.0


@dataclass(frozen=True)
class Speech:
    """Language of a view; by default English.

    translate: for the sentences here. sentence: translates one from elsewhere, word: one of the domain's words. number:
    formats a value with decimals. duration: formats seconds.
    """

    translate: Translate = lambda context, text: text
    sentence: Callable[[str], str] = str
    word: Callable[[str], str] = str
    number: Callable[[float, int], str] = lambda value, digits: f"{value:.{digits}f}"
    duration: Callable[[float], str] = span_text


ENGLISH = Speech()


def check_title(check: Check, speech: Speech = ENGLISH) -> str:
    """Return the title of a check."""
    translate = speech.translate
    return {
        Check.LINK: translate("Check", "Link"), Check.ENCRYPTION: translate("Check", "Encryption"),
        Check.ROBOT: translate("Check", "Robot"), Check.PREFLIGHT: translate("Check", "Preflight"),
        Check.EMERGENCY_STOP: translate("Check", "Emergency stop"),
        Check.POSITION: translate("Check", "Position"), Check.TEST_AREA: translate("Check", "Test area"),
        Check.SIZE: translate("Check", "Car's size"),
        Check.WAY: translate("Check", "Way of the lines"),
        Check.STOP_TRIAL: translate("Check", "Stop trial"),
        Check.GROUND: translate("Check", "Ground next to the Car"), Check.CABLES: translate("Check", "Cables"),
        Check.OPENINGS: translate("Check", "Doors and lids"), Check.FITTINGS: translate("Check", "Fittings"),
        Check.AREA: translate("Check", "Area"), Check.PEOPLE: translate("Check", "People"),
        Check.WEATHER: translate("Check", "Weather"), Check.LIGHT: translate("Check", "Light"),
        Check.CAR: translate("Check", "Car"), Check.ATTENDANCE: translate("Check", "Attendance"),
        Check.LIDARS: translate("Check", "LiDARs"), Check.BOARD: translate("Check", "Lift and buttons"),
        Check.BATTERY: translate("Check", "Battery"),
        Check.BUS: translate("Check", "CAN bus"), Check.LOCKS: translate("Check", "Car's locks"),
        Check.SIGNALS: translate("Check", "Car's signals"),
        Check.CLOCK: translate("Check", "Clocks"), Check.ROBOT_CLOCK: translate("Check", "Robot's clock"),
        Check.KEY: translate("Check", "Remote key"),
        Check.DISK: translate("Check", "Disk"), Check.LIMITS: translate("Check", "Limits"),
    }[check]


def check_text(item: Item, speech: Speech = ENGLISH) -> str:
    """Return the finding as a sentence."""
    translate = speech.translate
    # Texts of robot, link and file may contain braces.
    finding, said = item.finding, speech.sentence(item.said).replace("{", "{{").replace("}", "}}")
    first, second, third = (*item.numbers, math.nan, math.nan, math.nan)[:3]
    texts = {**_of_link(translate), **_of_robot(translate, said), **_of_preflight(translate, said),
             **_of_area(translate, said),
             **_of_place(translate, said, bool(item.numbers)), **_of_way(translate, said), **_of_unseen(translate),
             **_of_conditions(translate, said), **_of_signals(speech, item.said, said),
             **_of_battery(translate),
             **_of_car(translate, said, is_cyclic=not math.isnan(second)), **_of_files(translate, said)}
    return texts[finding].format(first=_shown(speech, item, first), second=_shown(speech, item, second, 1),
                                 age="" if math.isnan(third) else speech.duration(third),
                                 said=speech.word(item.said) if finding is Finding.LOCKS_HEARD else "")


def _of_link(translate: Translate) -> dict[Finding, str]:
    return {
        Finding.UNHEARD: translate("Check", "Not known while the robot is silent."),
        Finding.LINK_ALIVE: translate("Check", "The robot's newest message is {first} s old."),
        Finding.LINK_SILENT: translate("Check", "The robot has not answered for {first} s."),
        Finding.ENCRYPTED: translate("Check", "The link to the robot is encrypted."),
        Finding.NOT_ENCRYPTED: translate("Check", "The link is not encrypted: whoever is in its network can listen and "
                                                  "send."),
        Finding.LOCAL_LINK: translate("Check", "Not encrypted; it does not leave this computer."),
    }


def _of_robot(translate: Translate, said: str) -> dict[Finding, str]:
    return {
        Finding.ROBOT_READY: translate("Check", "It takes orders, and reports nothing against a test."),
        Finding.ROBOT_STARTING: translate("Check", "The robot is still starting."),
        Finding.ROBOT_FAULT: said or translate("Check", "The robot reports a fault."),
        Finding.OTHER_OPERATOR: translate("Check", "Another application controls the robot."),
        Finding.ROBOT_SAYS: said, Finding.IN_SERVICE: said, Finding.PART_TROUBLED: said,
        Finding.STOP_RELEASED: translate("Check", "The one by hand is heard, and released."),
        Finding.STOP_ENGAGED: translate("Check", "The one by hand is engaged: the robot stands."),
        Finding.STOP_ABSENT: translate("Check", "The robot has none by hand."),
        Finding.STOP_MISSING: translate("Check", "The robot has none by hand, so no test begins."),
        Finding.STOP_UNKNOWN: translate("Check", "The robot does not say whether it has one by hand."),
        Finding.ROBOT_CLOCK_FINE: translate("Check", "Within {first} s of this laptop's."),
        Finding.ROBOT_CLOCK_APART: said,
        Finding.ROBOT_CLOCK_SIMULATED: translate("Check", "The robot tells simulated time."),
        Finding.LIDARS_FINE: translate("Check", "The robot reports nothing against them."),
        Finding.BOARD_FINE: translate("Check", "The robot reports nothing against them."),
    }


def _of_preflight(translate: Translate, said: str) -> dict[Finding, str]:
    return {
        Finding.PREFLIGHT_FINE: translate("Check", "{first} of {second} right, {age} ago."),
        Finding.PREFLIGHT_OLD: translate("Check", "{first} of {second} right, but {age} ago."),
        Finding.PREFLIGHT_BAD: " ".join((translate("Check", "{first} of {second} wrong, {age} ago."), said)),
        Finding.PREFLIGHT_AT_REST: translate("Check", "Made at rest only; a real robot needs one in motion."),
        Finding.PREFLIGHT_NEVER: translate("Check", "Never made since the robot was started."),
        Finding.PREFLIGHT_UNTOLD: translate("Check", "The robot does not say whether one was made."),
    }


def _of_area(translate: Translate, said: str) -> dict[Finding, str]:
    return {
        Finding.AREA_KEPT: translate("Check", "The robot keeps inside an area of {first} m2."),
        Finding.AREA_FIXED: translate("Check", "The robot's launch file sets an area of {first} m2."),
        Finding.AREA_MISSING: said or translate("Check", "The robot has none."),
        Finding.AREA_NOT_NEEDED: translate("Check", "None; a simulated robot needs none."),
        Finding.AREA_UNTOLD: translate("Check", "The robot does not say whether it keeps inside one."),
    }


def _of_place(translate: Translate, said: str, has_sigma: bool) -> dict[Finding, str]:
    return {
        Finding.POSITION_KNOWN: translate("Check", "Known beside the Car to {first} cm (1 sigma).")
        if has_sigma else translate("Check", "Known beside the Car."),
        Finding.POSITION_TO_COME: translate("Check", "Not known yet: a test begins with a drive around the Car."),
        Finding.POSITION_LOST: said or translate("Check", "The robot does not know its position."),
        Finding.SIZE_KNOWN: translate("Check", "The robot has it from the data sheet."),
        Finding.SIZE_OF_PLANE: translate("Check", "Only as the LiDARs see it at their height: distances from the Car's "
                                                  "outline may be up to {first} cm too long."),
        Finding.SIZE_VAGUE: translate("Check", "Known to {first} cm (95 %): distances from the Car's outline may be "
                                               "wrong by as much."),
        Finding.SIZE_TOO_VAGUE: translate("Check", "Known to {first} cm only (95 %): the robot may touch the Car "
                                                   "nearer than {second} m."),
        Finding.SIZE_TO_COME: translate("Check", "Not known before the Car is mapped."),
    }


def _of_way(translate: Translate, lines: str) -> dict[Finding, str]:
    return {
        Finding.WAY_FREE: translate("Check", "As far as the robot has seen, nothing stands on the lines."),
        Finding.WAY_HINDERED: translate("Check", "Something stands in the way of lines {lines}, the nearest {distance} "
                                                 "m from the Car.").format(lines=lines, distance="{first}"),
        Finding.WAY_UNSEEN: translate("Check", "The robot has not seen all of the way of lines {lines}.").format(
            lines=lines),
        Finding.WAY_TO_COME: translate("Check", "Looked at when the Car is mapped and a test is chosen."),
    }


def _of_unseen(translate: Translate) -> dict[Finding, str]:
    return {
        Finding.STOP_UNTRIED: translate("Check", "The robot may not notice a lost controller while its receiver stays "
                                                 "plugged in."),
        Finding.GROUND_UNSEEN: translate("Check", "The LiDARs see nothing below their plane: no person lying or "
                                                  "kneeling, no child, no wheel chocks."),
        Finding.CABLES_UNSEEN: translate("Check", "The robot does not see cables, and drives around the whole Car."),
        Finding.OPENINGS_UNSEEN: translate("Check", "The robot does not see an open door, lid or tailgate above the "
                                                    "LiDARs. A hatch may open by itself for a key behind the Car."),
        Finding.FITTINGS_UNSEEN: translate("Check", "The robot does not see what stands out above or below the LiDARs, "
                                                    "such as a tow bar. It keeps 10 to 25 cm from "
                                                    "the Car's ends."),
    }


def _of_conditions(translate: Translate, said: str) -> dict[Finding, str]:
    """Return the texts of the operating conditions, as in docs/safety/hazards.yaml."""
    return {
        Finding.AREA_UNSEEN: translate("Check", "Closed or marked, 2 m free around the paths, no edge, stairs, dock or "
                                                "kerb inside?"),
        Finding.PEOPLE_UNSEEN: translate("Check", "Trained adults only, nobody lies, kneels or works at the Car?"),
        Finding.WEATHER_UNSEEN: translate("Check", "No ice, snow, heavy rain or fog, no low sun into a LiDAR, mean "
                                                   "wind below 8 m/s?"),
        Finding.LIGHT_UNSEEN: translate("Check", "Is the area lit?"),
        Finding.CAR_UNSEEN: translate("Check", "Parking brake applied, gear P, chocks placed, cabin empty, windows "
                                               "closed, alarm off or announced?"),
        Finding.ATTENDANCE_UNSEEN: translate("Check", "Is a trained person within 10 m and in sight of the robot, with "
                                                      "a hardware emergency stop?"),
        Finding.CONFIRMED: translate("Check", "Confirmed by a person."),
        Finding.OPENINGS_OPEN: said,
    }


def condition_title(name: str, speech: Speech = ENGLISH) -> str:
    """Return the title of an operating condition, a word or two."""
    return check_title(Check[name.upper()], speech)


def condition_text(name: str, speech: Speech = ENGLISH) -> str:
    """Return the requirement of an operating condition, as a question."""
    if name == "ground":
        return speech.translate("Check", "Dry or wet asphalt or concrete, steps and cables below 15 mm, slope at most "
                                         "2 degrees?")
    return _of_conditions(speech.translate, "")[Finding[f"{name.upper()}_UNSEEN"]]


def _of_signals(speech: Speech, named: str, said: str) -> dict[Finding, str]:
    translate = speech.translate
    words = ", ".join(map(speech.word, named.split(", "))).replace("{", "{{").replace("}", "}}")
    return {
        Finding.SIGNAL_ACTIVE: said,
        Finding.SIGNALS_FINE: translate("Check", "Ignition, gear, speed and doors are received, and do not forbid "
                                                 "motion."),
        Finding.SIGNALS_SILENT: translate("Check", "Not received from the Car: {signals}.").format(signals=said),
        Finding.SIGNALS_UNNAMED: translate("Check", "The car profile names no signal for: {signals}.").format(
            signals=words),
    }


def _of_battery(translate: Translate) -> dict[Finding, str]:
    return {
        Finding.BATTERY_FINE: translate("Check", "At {first} %; what a test takes is told when it is chosen."),
        Finding.BATTERY_SUFFICES: translate("Check", "At {first} %; the test takes about {second} %."),
        Finding.BATTERY_SHORT: translate("Check", "At {first} % it may not suffice: the test takes about {second} %."),
        Finding.BATTERY_LOW: translate("Check", "Low: {first} %."),
        Finding.BATTERY_EMPTY: translate("Check", "Nearly empty: {first} %."),
        Finding.BATTERY_UNKNOWN: translate("Check", "The robot does not report its charge."),
    }


def _of_car(translate: Translate, said: str, is_cyclic: bool) -> dict[Finding, str]:
    return {
        Finding.BUS_TROUBLED: said, Finding.CLOCK_NOT_MAPPED: said,
        Finding.BUS_FINE: translate("Check", "Load {first} %, lock message every {second} ms.")
        if is_cyclic else translate("Check", "Load {first} %, no lock message yet."),
        Finding.BUS_SIMULATED: translate("Check", "There is none: the Car is a substitute inside the application."),
        Finding.BUS_FULL: translate("Check", "Load {first} %: messages may be late, and so the time of events."),
        Finding.BUS_SLOW: translate("Check", "The lock message comes every {first} ms; the profile says {second} ms."),
        Finding.NO_ADAPTER: translate("Check", "No CAN adapter is chosen."),
        Finding.LOCKS_HEARD: translate("Check", "The Car says: {said}."),
        Finding.LOCKS_UNKNOWN: translate("Check", "The Car does not say whether it is locked."),
        Finding.CLOCK_MAPPED: translate("Check", "Events of the Car have a time on the robot's clock."),
        Finding.CLOCK_UNKNOWN: translate("Check", "Not known without an adapter."),
        Finding.KEY_ANSWERED: translate("Check", "The Car has reacted {first} s ago: the key is awake."),
        Finding.KEY_UNKNOWN: translate("Check", "Whether it is awake nobody knows before the Car reacts to it."),
    }


def _of_files(translate: Translate, said: str) -> dict[Finding, str]:
    return {
        Finding.LIMITS_UNFIT: said,
        Finding.DISK_FINE: translate("Check", "{first} GB are free."),
        Finding.DISK_SHORT: translate("Check", "Only {first} GB are free."),
        Finding.DISK_FULL: translate("Check", "Nearly full: {first} GB are free."),
        Finding.DISK_UNKNOWN: translate("Check", "The system does not say how much room there is."),
        Finding.LIMITS_LOADED: translate("Check", "Limits loaded: {first}."),
        Finding.NO_LIMITS: translate("Check", "None: the lines get no verdict."),
    }


def check_advice(item: Item, speech: Speech = ENGLISH) -> str:
    """Return the remedy; empty if nothing has to be done, or the sentence contains it."""
    translate = speech.translate
    return {
        Finding.LINK_SILENT: translate("Check", "Check the Wi-Fi and that the robot is on; the link comes back by "
                                                "itself."),
        Finding.NOT_ENCRYPTED: translate("Check", "Pair this laptop with the robot in the connection window, and "
                                                  "have the robot encrypt its link."),
        Finding.ROBOT_STARTING: translate("Check", "Wait a moment."),
        Finding.ROBOT_FAULT: translate("Check", "Make sure that nothing blocks the robot; if the fault stays, switch "
                                                "it off and on."),
        Finding.OTHER_OPERATOR: translate("Check", "End the other application; control comes here by itself."),
        Finding.IN_SERVICE: translate("Check", "When the work is finished, release it here under Settings and on the "
                                               "robot: rosrun mtr_dispatcher service_mode release"),
        Finding.PREFLIGHT_OLD: translate("Check", "Make it again on the robot: rosrun mtr_commissioning preflight"),
        Finding.PREFLIGHT_BAD: translate("Check",
                                         "Then make it again on the robot: rosrun mtr_commissioning preflight"),
        Finding.AREA_MISSING: translate("Check", "Draw it on the start page under Test area."),
        Finding.AREA_UNTOLD: translate("Check", "Stay where you can stop the robot before an edge."),
        **dict.fromkeys((Finding.PREFLIGHT_NEVER, Finding.PREFLIGHT_AT_REST, Finding.PREFLIGHT_UNTOLD),
                        translate("Check", "Make it on the robot: rosrun mtr_commissioning preflight --drive")),
        Finding.OPENINGS_OPEN: translate("Check", "Close it."),
        Finding.SIGNALS_SILENT: translate("Check", "Wake the Car; watch ignition, gear and doors yourself meanwhile."),
        Finding.SIGNALS_UNNAMED: translate("Check", "Watch them yourself: the robot does not stop for them."),
        Finding.STOP_ENGAGED: translate("Check", "Release it when the area is clear."),
        Finding.STOP_ABSENT: translate("Check", "Stay where you reach the button on the robot."),
        Finding.STOP_MISSING: translate("Check", "Start the robot with its controller (controller:=true)."),
        Finding.STOP_UNTRIED: translate("Check", "Press the stop button in your hand: the robot reports it here. "
                                                 "Then release it."),
        Finding.WAY_HINDERED: translate("Check", "Move it, or measure from nearer; the robot does not drive into it."),
        Finding.GROUND_UNSEEN: translate("Check", "Walk around the Car: nobody within 2 m, no chock beyond its "
                                                  "outline."),
        Finding.CABLES_UNSEEN: translate("Check", "Put the laptop into the Car, or tape the CAN cable flat to the "
                                                  "ground. Unplug the charging cable."),
        Finding.OPENINGS_UNSEEN: translate("Check", "Close doors, bonnet, boot and tailgate. Switch off a hatch that "
                                                    "opens by itself, in the Car's menu."),
        Finding.FITTINGS_UNSEEN: translate("Check", "Remove carriers and larger fittings, or start the robot with "
                                                    "front_fitting_m or rear_fitting_m."),
        Finding.POSITION_LOST: translate("Check", "Drive or turn it by hand where it sees the Car; if it stays lost, "
                                                  "map the Car again under Calibrate."),
        Finding.SIZE_OF_PLANE: translate("Check", "Start the robot with length and width of the data sheet (car_file), "
                                                  "and map the Car again."),
        Finding.SIZE_VAGUE: translate("Check", "Fill in {keys} in the robot's car_file (data sheet or tape measure), "
                                               "restart the robot with it, and map the Car again.").format(
                                                   keys=item.said),
        Finding.SIZE_TOO_VAGUE: translate("Check", "Fill in {keys} in the robot's car_file (data sheet or tape "
                                                   "measure), restart the robot with it, and map the Car again; or "
                                                   "measure from farther away.").format(keys=item.said),
        Finding.SIZE_TO_COME: translate("Check", "Have length and width of the Car's data sheet ready: the robot is "
                                                 "started with them (car_file)."),
        Finding.BATTERY_SHORT: translate("Check", "Charge it, or measure fewer lines; an interrupted test can be gone "
                                                  "on with."),
        Finding.BATTERY_LOW: translate("Check", "Charge it soon."),
        Finding.BATTERY_EMPTY: translate("Check", "Charge it before the test."),
        Finding.BATTERY_UNKNOWN: translate("Check", "Check that the base publishes it on the robot's topic of the "
                                                    "battery (docs/other-bases.md)."),
        Finding.BUS_FULL: translate("Check", "Check bit rate and other testers on the bus."),
        Finding.BUS_SLOW: translate("Check", "Check whether the profile is that of this Car."),
        Finding.NO_ADAPTER: translate("Check", "Choose one under Settings, CAN adapter."),
        Finding.BUS_TROUBLED: translate("Check", "If the adapter is the wrong one, choose another under Settings."),
        Finding.LOCKS_UNKNOWN: translate("Check", "Wake the Car, e.g. open a door; check the car profile."),
        Finding.KEY_UNKNOWN: translate("Check", "Press one of its buttons under Calibrate; a test notices a key that "
                                                "sleeps."),
        Finding.DISK_SHORT: translate("Check", "Make room, or choose another folder under Settings."),
        Finding.DISK_FULL: translate("Check", "Make room, or choose another folder under Settings."),
        Finding.NO_LIMITS: translate("Check", "Choose a limits file below the parameters if there are limits."),
        Finding.LIMITS_UNFIT: translate("Check", "Choose another file below the parameters, or none."),
    }.get(item.finding, "")


def _shown(speech: Speech, item: Item, value: float, index: int = 0) -> str:
    """Return a number in the unit of its sentence."""
    if math.isnan(value):
        return ""
    if item.check is Check.SIZE and index:
        return speech.number(value, 2)
    if item.check in (Check.POSITION, Check.SIZE):
        return speech.number(value * _CM_PER_M, 1)
    if item.check is Check.BUS and (index or item.finding is Finding.BUS_SLOW):
        return speech.number(value * _MS_PER_S, 0)
    if item.check is Check.DISK:
        return speech.number(value / _MB_PER_GB, 1)
    return speech.number(value, 1 if item.check in (Check.LINK, Check.WAY) else 0)
