/// @file
/// The serial line between host and microcontroller, byte by byte, with its faults.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <simavr/avr_uart.h>

#include <cstdint>
#include <deque>
#include <random>
#include <vector>

#include "mcu.hpp"

namespace emulator {

/// Bytes take their ten bit times; a third byte that waits in the UART is lost, as in the silicon.
class UartLine {
 public:
  UartLine(Mcu* mcu, std::uint32_t seed);

  /// Bytes that the host has written.
  void offer(const std::uint8_t* bytes, std::size_t count);
  /// Bytes that have arrived at the host's end since the last call.
  std::vector<std::uint8_t> take();

  void cut(bool is_cut) { is_cut_ = is_cut; }
  /// Loses, or flips a bit of, one byte in so many; 0: none.
  void drop_one_in(std::uint32_t bytes) { drop_ = bytes; }
  void corrupt_one_in(std::uint32_t bytes) { corrupt_ = bytes; }

  /// Bytes lost because the firmware did not fetch them in time.
  std::uint64_t overruns() const { return overruns_; }

 private:
  static avr_cycle_count_t feed(avr_t* core, avr_cycle_count_t when, void* self);
  static void sent(avr_irq_t* irq, std::uint32_t value, void* self);
  avr_cycle_count_t byte_cycles() const;
  void start_feeding();
  void mend_byte_time();
  bool passes(std::uint8_t* byte);
  bool chance(std::uint32_t one_in) { return one_in != 0 && random_() % one_in == 0; }

  Mcu* mcu_;
  avr_uart_t* uart_;
  std::deque<std::uint8_t> to_mcu_;
  std::vector<std::uint8_t> to_host_;
  std::mt19937 random_;
  std::uint32_t drop_ = 0, corrupt_ = 0;
  std::uint64_t overruns_ = 0;
  avr_cycle_count_t byte_cycles_ = 0;
  bool is_feeding_ = false;
  bool is_cut_ = false;
};

}  // namespace emulator
