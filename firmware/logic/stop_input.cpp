/// @file
/// Opens at once, closes slowly.
// SPDX-License-Identifier: Apache-2.0
#include "stop_input.hpp"

namespace mtr {

bool StopInput::step(bool is_open) {
  if (!is_open) {
    closed_ms_ = closed_ms_ < kStopCloseMs ? static_cast<uint8_t>(closed_ms_ + 1) : kStopCloseMs;
    is_open_ = is_open_ && closed_ms_ < kStopCloseMs;
    return false;
  }
  closed_ms_ = 0;
  const bool has_opened = is_used() && !is_open_;
  is_open_ = true;
  if (has_opened) {
    ++openings_;
  }
  return has_opened;
}

}  // namespace mtr
