"""What the scenarios' parameters mean, as they declare it."""
# SPDX-License-Identifier: Apache-2.0
from PyQt5.QtCore import QT_TRANSLATE_NOOP

from .keys import phone, relay

SENTENCES = (
    QT_TRANSLATE_NOOP("ParameterDoc", "Where the approach ends if the Car stays locked."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Starting distance of each axis."),
    QT_TRANSLATE_NOOP("ParameterDoc", "First piece of the approach, to correct the heading; the retreat ends where "
                                      "it ended."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Distance between neighbouring axes of a side."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Height of the Remote key above ground."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Speed limit on the whole way."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Speed limit while approaching and retreating; default: the maximum speed."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Approaches and retreats on each axis; those at two speeds tell the Car's "
                                      "reaction time from the static boundary."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Speed limits of the passes, in turn; default: proposed from the cycle of the "
                                      "Car's message."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Sigma of the static boundary for which the speeds are proposed."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Step of one more approach, with a stop for the response time after each, for "
                                      "Cars that poll slowly; default: none."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Gap that has to remain between Remote key and Car."),
    QT_TRANSLATE_NOOP("ParameterDoc", "How long the Car may take to react at the end of the approach and of the "
                                      "retreat."),
    QT_TRANSLATE_NOOP("ParameterDoc", "How long to wait at the starting distance for the Car to be locked."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Before the test the robot looks at the Car again from two places; it does "
                                      "not begin when the Car stands elsewhere than it was measured."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Nearest place at which the button is pressed."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Starting distance of each radial."),
    QT_TRANSLATE_NOOP("ParameterDoc", "First piece of the approach, to correct the heading; the first press is at "
                                      "its end."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Step towards the Car after a press without success."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Angle between neighbouring radials."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Travel of the button: 1 is pressed down fully."),
    QT_TRANSLATE_NOOP("ParameterDoc", "How long the button is held down."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Standstill before each press."),
    QT_TRANSLATE_NOOP("ParameterDoc", "How long after the beginning of a press the Car may take to react."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Presses at each place before it counts as failed."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Presses at the place of one that worked; unless one of them works too, another "
                                      "key or a late answer may have been taken for it, and the place counts as "
                                      "failed. 0: none, as the thesis does."),
    QT_TRANSLATE_NOOP("ParameterDoc", "adaptive: search for the distances at which 50 and 95 % of the presses work, "
                                      "with their intervals. scan: from far to near until a press works, as the "
                                      "thesis does; it reads too far where the Car's range is no sharp border."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Half the width of the 95 % interval of the distance at which a radial ends."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Presses after which a radial ends although its interval is wider."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Radio frequency of the Remote key: presses half a wavelength apart meet another "
                                      "fading."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Standstill after which the Remote key is moved before it is pressed, so that it "
                                      "does not sleep."),
    QT_TRANSLATE_NOOP("ParameterDoc", "How far the Remote key may be beside the line when something is measured."),
    QT_TRANSLATE_NOOP("ParameterDoc", "How far the robot may be turned from the line when something is measured."),
    QT_TRANSLATE_NOOP("ParameterDoc", "How far the Remote key may be from its height while a line is measured."),
    QT_TRANSLATE_NOOP("ParameterDoc", "How much faster than wanted the robot may be when something is measured."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Nearest places of the map."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Farthest places of the map."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Distance between neighbouring places away from the Car."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Highest of the heights at which the map is made, if there are several."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Heights at which the map is made."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Half the width of the 95 % interval of a zone's coverage at which the zone "
                                      "ends."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Presses in a zone after which it ends anyway."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Half a wavelength of the Remote key's radio: 0.35 m at 434 MHz, 0.17 m at "
                                      "868 MHz."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Nearest place at which the handle is taken."),
    QT_TRANSLATE_NOOP("ParameterDoc", "First piece of the approach, to correct the heading; the farthest request is "
                                      "at its end."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Nominal border of the zone, where the first requests of each axis are made."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Requests at the nominal border on each axis before the border is searched; "
                                      "0: only the search."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Half the width of the 95 % interval of the border at which an axis ends."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Requests after which an axis ends although its interval is wider."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Highest of the heights at which the border is measured, if there are several."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Heights at which the border is measured."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Standstill before each request."),
    QT_TRANSLATE_NOOP("ParameterDoc", "How long after the handle was taken the Car may take to unlock; outside "
                                      "otherwise."),
    QT_TRANSLATE_NOOP("ParameterDoc", "How long the Operator may take to come to the handle before the test is "
                                      "interrupted."),
    QT_TRANSLATE_NOOP("ParameterDoc", "How long the Car may take to lock by itself, as the key goes away or by its "
                                      "timer."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Requests so far apart meet another field; half a wavelength of the Remote "
                                      "key's radio: 0.35 m at 434 MHz, 0.17 m at 868 MHz."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Standstill after which the Remote key is moved before the handle is taken, "
                                      "so that it does not sleep."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Side or corner of the Car whose border is measured: that of the handle that "
                                      "is taken."),
    QT_TRANSLATE_NOOP("ParameterDoc", "How the Car is locked again after each unlock. button: the robot presses the "
                                      "key's lock button. itself: the robot drives away and waits, for a key whose "
                                      "button it cannot press."),
    *phone.PARAMETERS,
    *relay.PARAMETERS,
    QT_TRANSLATE_NOOP("ParameterDoc", "Side or corner of the Car at which the key is held: that of the handle that is "
                                      "taken."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Where the Remote key is held still, well inside the zone."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Rest after which the key is asked first."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Longest rest; a key that still answers after it is recorded as awake for at "
                                      "least so long."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Time between the last answer and the first silence at which the search ends."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Trials at each end of that time that have to agree."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Requests without an answer, one right after the other, before the key counts "
                                      "as asleep."),
    QT_TRANSLATE_NOOP("ParameterDoc", "Trials after which the search ends although its interval is wider."),
    QT_TRANSLATE_NOOP("ParameterDoc", "How far the key is moved and brought back before each trial, so that it is "
                                      "awake."),
)
