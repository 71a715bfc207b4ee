/// @file
/// CRC-16/CCITT-FALSE: polynomial 0x1021, initially 0xFFFF; mtr_core/crc.py has the same for the host.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdint.h>

namespace mtr {

constexpr uint16_t kCrcInitial = 0xFFFF;

/// The sum after one more byte; shifts instead of a table of 512 bytes.
inline uint16_t crc16_step(uint16_t crc, uint8_t byte) {
  crc = static_cast<uint16_t>((crc >> 8) | (crc << 8));
  crc ^= byte;
  crc ^= (crc & 0xFF) >> 4;
  crc = static_cast<uint16_t>(crc ^ (crc << 12));
  crc = static_cast<uint16_t>(crc ^ ((crc & 0xFF) << 5));
  return crc;
}

inline uint16_t crc16(const uint8_t* bytes, uint8_t length) {
  uint16_t crc = kCrcInitial;
  for (uint8_t i = 0; i < length; ++i) {
    crc = crc16_step(crc, bytes[i]);
  }
  return crc;
}

}  // namespace mtr
