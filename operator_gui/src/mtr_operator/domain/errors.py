"""Error tree of the Operator's application; each text is one sentence for a person.

OperatorError
├── InvalidParameter     a scenario or connection parameter is out of range
├── InvalidLimits        a limits file is damaged, contradicts itself or does not suit the test
├── InvalidCalibration   a calibration record of the robot is damaged
├── InvalidIdentity      what is said of car, key, operator or equipment is wrong, or lacks what is required
├── ConnectionFailed     robot or Car cannot be reached, or the port or adapter is wrong
│   └── BusRefused       the adapter of a further bus of the Car cannot be used, or there is none
├── LinkLost             robot or Car fell silent during a test
├── StoodStill           the laptop slept, or the application was stopped, during a test
├── OperatorAbsent       nobody confirmed to be present during a test
├── RobotFailed          the robot is there, and cannot do what the test needs
│   ├── BatteryCritical  its charge no longer suffices to measure
│   └── CarActive        a signal of the Car forbids motion next to it
├── ProgressFileError    a progress file cannot be read or belongs to something else
├── UnsafeName           a document names a file that would lie outside its folder
├── InUse                another application measures this test, or has gone on with it
└── OutputError          a result cannot be written
"""
# SPDX-License-Identifier: Apache-2.0


class OperatorError(Exception):
    """Base of all errors that the application raises for a person to read."""


class InvalidParameter(OperatorError):
    """A parameter is out of range."""


class InvalidLimits(OperatorError):
    """A limits file is damaged, contradicts itself or does not suit the test."""


class InvalidCalibration(OperatorError):
    """A calibration record of the robot is damaged."""


class InvalidIdentity(OperatorError):
    """What is said of car, key, operator or equipment is wrong, or lacks what the laboratory requires."""


class ConnectionFailed(OperatorError):
    """Robot or Car cannot be reached."""


class BusRefused(ConnectionFailed):
    """A further bus of the Car has no adapter, or one that cannot be used. bus: its name in the Car's profile."""

    def __init__(self, text: str, bus: str):
        super().__init__(text)
        self.bus = bus


class NothingLearned(OperatorError):
    """The Car's bus shows nothing that follows its locks."""


class LinkLost(OperatorError):
    """Robot or Car fell silent during a test."""


class StoodStill(OperatorError):
    """The laptop slept, or the application was stopped, during a test."""


class OperatorAbsent(OperatorError):
    """Nobody confirmed to be present during a test."""


class RobotFailed(OperatorError):
    """The robot is there, and cannot do what the test needs."""


class BatteryCritical(RobotFailed):
    """The robot's charge no longer suffices to measure."""


class CarActive(RobotFailed):
    """The Car's ignition, gear, speed, or an open door forbids motion next to it."""


class ProgressFileError(OperatorError):
    """A progress file cannot be read or belongs to something else."""


class UnsafeName(OperatorError):
    """A document names a file that would lie outside its folder."""


class InUse(OperatorError):
    """Another application measures this test, or has gone on with it."""


class OutputError(OperatorError):
    """A result cannot be written."""
