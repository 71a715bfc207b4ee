/// @file
/// Frame with running sums.
// SPDX-License-Identifier: Apache-2.0
#include "frame_writer.hpp"

#include <string.h>

#include "../../hal/hal.hpp"
#include "frame_reader.hpp"

namespace mtr {

bool FrameWriter::begin(uint16_t topic, uint8_t length) {
  if (hal::uart_room() < length + kFrameOverheadBytes) {
    return false;
  }
  hal::uart_put(kSync);
  hal::uart_put(kRevision);
  hal::uart_put(length);
  hal::uart_put(0);
  hal::uart_put(static_cast<uint8_t>(0xFF - length));
  sum_ = 0;
  u16(topic);
  crc_ = kCrcInitial;
  return true;
}

void FrameWriter::u8(uint8_t value) {
  hal::uart_put(value);
  sum_ = static_cast<uint8_t>(sum_ + value);
  crc_ = crc16_step(crc_, value);
}

void FrameWriter::u16(uint16_t value) {
  u8(static_cast<uint8_t>(value));
  u8(static_cast<uint8_t>(value >> 8));
}

void FrameWriter::u32(uint32_t value) {
  u16(static_cast<uint16_t>(value));
  u16(static_cast<uint16_t>(value >> 16));
}

void FrameWriter::f32(float value) {
  uint32_t bits = 0;
  static_assert(sizeof bits == sizeof value, "ROS float32");
  memcpy(&bits, &value, sizeof bits);
  u32(bits);
}

void FrameWriter::end() { hal::uart_put(static_cast<uint8_t>(0xFF - sum_)); }

}  // namespace mtr
