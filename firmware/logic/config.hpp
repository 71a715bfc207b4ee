/// @file
/// Every number of the firmware that a person may want to change, with unit and source.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdint.h>

namespace mtr {

// Link
constexpr uint32_t kSilenceUs = 1000000;      ///< without a command for so long, everything stops
constexpr uint32_t kMaxLeadUs = 5000000;      ///< an order that may begin later is one of another clock
constexpr uint32_t kStatePeriodUs = 40000;    ///< FirmwareState
constexpr uint32_t kHealthPeriodUs = 200000;  ///< FirmwareHealth
constexpr uint32_t kTimePeriodUs = 500000;    ///< TIME requests; the upstream host gives up after 15 s without one
constexpr uint32_t kHostLostUs = 1200000;     ///< without an answer to TIME for so long, topics are announced again
constexpr uint32_t kAnnouncePeriodUs = 1000000;
constexpr uint32_t kFrameGapUs = 20000;  ///< a frame whose next byte takes longer is given up

// Lift; the loop runs once per kLiftPeriodMs
constexpr uint8_t kLiftPeriodMs = 10;
constexpr uint16_t kNominalStrokeMm = 1200;
constexpr uint16_t kShortestStrokeMm = 50;
constexpr uint16_t kLongestStrokeMm = 2000;
constexpr int32_t kTopSpeedUmPerStep = 1500;       ///< 0.15 m/s
constexpr int32_t kAccelerationUmPerStep2 = 30;    ///< 0.3 m/s^2
constexpr int32_t kFullDutySpeedUmPerStep = 2000;  ///< 0.2 m/s, data sheet of the actuator at its rated voltage
constexpr int16_t kFrictionDuty = 30;              ///< of kFullDuty; just enough to move the unloaded lift slowly
constexpr int32_t kGainStepsPerCorrection = 20;    ///< a position error is made good within so many steps
constexpr int32_t kArrivedUm = 700;                ///< motor off within this of the target
constexpr int32_t kDepartedUm = 1500;              ///< and on again beyond this
constexpr int32_t kHeightToleranceUm = 100;        ///< rounding of a height that was sent as float32
constexpr int16_t kFullDuty = 254;                 ///< of 255; a constant level would hide a stuck output

// Stall: driven without having moved by so much within so many steps
constexpr int32_t kStallUm = 1500;
constexpr uint8_t kStallSteps = 40;
constexpr uint8_t kJamRestSteps = 100;  ///< motor off between two tries
constexpr uint8_t kJamTries = 2;  ///< then the motor stays off until an order to hold still, and a height after it

// Position sensor: potentiometer between 0 and 5 V, kSamplesPerStep readings of 10 bits added
constexpr uint8_t kSamplesPerStep = 10;
constexpr uint16_t kFullScale = 1023 * kSamplesPerStep;
constexpr uint16_t kNominalLow = 512;     ///< 5 % at the lower stop
constexpr uint16_t kNominalHigh = 9718;   ///< 95 % at the upper stop
constexpr uint16_t kBrokenLow = 205;      ///< 2 %: a pull-down resistor draws a broken wire here
constexpr uint16_t kBrokenHigh = 10025;   ///< 98 %: ground of the sensor is broken
constexpr uint16_t kJumpLimit = 400;      ///< per step; faster than any lift moves
constexpr uint8_t kSensorGoodSteps = 50;  ///< plausible for so long before it is trusted again

// Calibration: slowly to both stops
constexpr int16_t kCalibrationDuty = 100;
constexpr int32_t kCalibrationStallCounts = 4;
constexpr uint16_t kCalibrationSteps = 9000;  ///< 90 s for one way
constexpr uint16_t kSmallestSpan = 3000;      ///< of kFullScale between the stops

// Stop input and signals
constexpr uint8_t kStopCloseMs = 100;           ///< closed without a bounce for so long before a stop ends
constexpr uint32_t kInputsPeriodUs = 80000;     ///< FirmwareInputs
constexpr uint32_t kSignalSilenceUs = 1000000;  ///< without an order for so long no signal is given

// Presses
constexpr uint8_t kServoCount = 2;
constexpr uint16_t kServoPeriodUs = 20000;
constexpr uint8_t kRampPeriods = 5;     ///< 100 ms to the full travel, slower than any hobby servo by itself
constexpr uint32_t kReturnUs = 100000;  ///< time a released servo takes to come back
constexpr uint16_t kShortestHoldMs = 20;
constexpr uint16_t kLongestHoldMs = 10000;
constexpr uint8_t kRememberedPresses = 16;

/// The clock starts two minutes before it wraps, so that each longer run meets the wrap (else each 71 minutes).
constexpr uint32_t kClockStartUs = 0xFFFFFFFFu - 120000000u;

}  // namespace mtr
