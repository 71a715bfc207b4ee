/// @file
/// Frames as the host sends them, for tests.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstring>
#include <vector>

#include "../../hal_host/hal_host.hpp"
#include "../../logic/crc16.hpp"

namespace frames {

using Bytes = std::vector<std::uint8_t>;

template <typename T>
void append(Bytes* bytes, T value) {
  std::uint8_t raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes->insert(bytes->end(), raw, raw + sizeof value);
}

inline void seal(Bytes* payload) {
  append(payload, mtr::crc16(payload->data(), static_cast<std::uint8_t>(payload->size())));
}

inline Bytes frame(std::uint16_t topic, const Bytes& payload) {
  const std::uint16_t length = static_cast<std::uint16_t>(payload.size());
  Bytes bytes = {0xFF, 0xFE};
  append(&bytes, length);
  bytes.push_back(static_cast<std::uint8_t>(255 - (length & 0xFF) - (length >> 8)));
  append(&bytes, topic);
  bytes.insert(bytes.end(), payload.begin(), payload.end());
  std::uint8_t sum = 0;
  for (std::size_t i = 5; i < bytes.size(); ++i) {
    sum = static_cast<std::uint8_t>(sum + bytes[i]);
  }
  bytes.push_back(static_cast<std::uint8_t>(255 - sum));
  return bytes;
}

/// Time of the firmware up to which an order of now may begin.
inline std::uint32_t soon_us() { return hal_host::hardware().now_us + 500000U; }

inline Bytes command(std::uint32_t seq, float height_m, std::uint8_t led_pattern = 4, std::uint8_t stop = 0,
                     std::uint32_t latest_us = soon_us()) {
  Bytes payload;
  append(&payload, seq);
  append(&payload, height_m);
  payload.push_back(led_pattern);
  payload.push_back(stop);
  append(&payload, latest_us);
  seal(&payload);
  return frame(100, payload);
}

inline Bytes press(std::uint32_t id, std::uint8_t servos, float strength, std::uint16_t hold_ms,
                   std::uint32_t latest_us = soon_us()) {
  Bytes payload;
  append(&payload, id);
  payload.push_back(servos);
  append(&payload, strength);
  append(&payload, hold_ms);
  append(&payload, latest_us);
  seal(&payload);
  return frame(101, payload);
}

inline Bytes calibrate(std::uint32_t id, float stroke_m, std::uint32_t latest_us = soon_us()) {
  Bytes payload;
  append(&payload, id);
  append(&payload, stroke_m);
  append(&payload, latest_us);
  seal(&payload);
  return frame(102, payload);
}

inline Bytes signals(std::uint8_t signal, std::uint8_t beacon = 0, std::uint8_t stop_input = 0,
                     std::uint32_t latest_us = soon_us()) {
  Bytes payload = {signal, beacon, stop_input};
  append(&payload, latest_us);
  seal(&payload);
  return frame(103, payload);
}

}  // namespace frames
