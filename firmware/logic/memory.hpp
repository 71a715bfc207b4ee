/// @file
/// What outlives power: the lift's calibration and the number of resets, each twice with a CRC.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdint.h>

#include "lift/position_sensor.hpp"

namespace mtr {

/// Copy of the EEPROM in RAM that is written back byte by byte, so that nothing waits for the EEPROM.
///
/// The first copy of the calibration is complete before the second is begun: a power failure damages at most one.
class Memory {
 public:
  /// Reads everything, counts this reset, and begins to repair damaged copies.
  void load();

  void save(const Calibration& calibration);

  /// Writes at most one byte; once per pass of the main loop.
  void poll();

  const Calibration& calibration() const { return calibration_; }
  /// Good copies of the calibration; 0: nominal values.
  uint8_t copies() const { return copies_; }
  uint16_t resets() const { return resets_; }

 private:
  static constexpr uint8_t kCalibrationBytes = 8;
  static constexpr uint8_t kResetBytes = 4;
  static constexpr uint8_t kCopies = 2;
  static constexpr uint8_t kImageBytes = kCopies * (kCalibrationBytes + kResetBytes);

  void load_calibration();
  void load_resets();
  void put_calibration();

  uint8_t image_[kImageBytes] = {};
  Calibration calibration_;
  uint16_t resets_ = 0;
  uint8_t copies_ = 0;
  uint8_t next_ = 0;
};

}  // namespace mtr
