/// @file
/// Messages between host and firmware as plain data.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdint.h>

#include "../config.hpp"
#include "../counters.hpp"

namespace mtr {

/// mtr_msgs/FirmwareCommand
struct Command {
  uint32_t seq = 0;
  float lift_height_m = 0.0f;
  uint8_t led_pattern = 0;
  uint8_t stop = 0;
  uint32_t latest_us = 0;
};

/// mtr_msgs/FirmwarePress
struct Press {
  uint32_t id = 0;
  uint8_t servos = 0;
  float strength = 0.0f;
  uint16_t hold_ms = 0;
  uint32_t latest_us = 0;
};

/// mtr_msgs/FirmwareCalibrate
struct Calibrate {
  uint32_t id = 0;
  float stroke_m = 0.0f;
  uint32_t latest_us = 0;
};

/// mtr_msgs/FirmwareSignals
struct SignalOrder {
  uint8_t signal = 0;
  uint8_t beacon = 0;
  uint8_t stop_input = 0;
  uint32_t latest_us = 0;
};

enum class PressState : uint8_t { kNone = 0, kPressing = 1, kDone = 2, kRefused = 3, kCutShort = 4 };
enum class Fault : uint8_t { kNone = 0, kLiftJammed = 1, kSensorBroken = 2, kLinkLost = 3, kLiftGivenUp = 4 };
enum class StopState : uint8_t { kUnused = 0, kClosed = 1, kOpen = 2 };
enum class LiftState : uint8_t { kStill = 0, kMoving = 1, kCalibrating = 2 };
enum class CalibrationState : uint8_t { kNone = 0, kUnderWay = 1, kDone = 2, kFailed = 3 };

/// What FirmwareState says of the newest press.
struct PressReport {
  uint32_t id = 0;
  PressState state = PressState::kNone;
  uint32_t start_us = 0;
  uint32_t end_us = 0;
};

/// mtr_msgs/FirmwareState
struct State {
  uint32_t time_us = 0;
  float lift_height_m = 0.0f;
  uint16_t servo_us[kServoCount]{};
  PressReport press;
  uint8_t led_pattern = 0;
  Fault fault = Fault::kNone;
  LiftState lift_state = LiftState::kStill;
  uint32_t calibration_id = 0;
  CalibrationState calibration_state = CalibrationState::kNone;
};

/// mtr_msgs/FirmwareHealth
struct Health {
  uint8_t reset_cause = 0;
  uint16_t resets = 0;
  uint16_t uart_overruns = 0;
  uint16_t dropped_bytes = 0;
  Counters counters;
  uint32_t worst_loop_us = 0;
  uint16_t free_ram = 0;
  uint8_t calibration_copies = 0;
  uint16_t stroke_mm = 0;
};

/// mtr_msgs/FirmwareInputs
struct InputReport {
  uint32_t time_us = 0;
  StopState stop = StopState::kUnused;
  uint16_t stops = 0;
  uint8_t signal = 0;
  uint8_t beacon = 0;
};

/// Reads a payload; false when its CRC or its length is wrong.
bool read(const uint8_t* payload, uint8_t length, Command* message);
bool read(const uint8_t* payload, uint8_t length, Press* message);
bool read(const uint8_t* payload, uint8_t length, Calibrate* message);
bool read(const uint8_t* payload, uint8_t length, SignalOrder* message);

/// Sends a message; false when there is no room.
bool send(const State& message);
bool send(const Health& message);
bool send(const InputReport& message);
/// Echo of a command's seq.
bool send_echo(uint8_t seq);

}  // namespace mtr
