/// @file
/// Writes one rosserial frame straight into the serial line's buffer.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdint.h>

#include "../crc16.hpp"

namespace mtr {

/// A frame is begun only when there is room for all of it, so that nothing ever waits for the line.
class FrameWriter {
 public:
  /// Writes the header; false, and nothing is written, when there is no room.
  bool begin(uint16_t topic, uint8_t length);

  void u8(uint8_t value);
  void u16(uint16_t value);
  void u32(uint32_t value);
  void f32(float value);
  /// CRC of all payload so far.
  void crc() { u16(crc_); }
  void end();

 private:
  uint8_t sum_ = 0;
  uint16_t crc_ = kCrcInitial;
};

}  // namespace mtr
