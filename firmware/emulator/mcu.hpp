/// @file
/// A microcontroller on libsimavr.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <simavr/sim_avr.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "wiring.hpp"

namespace emulator {

/// Runs an ELF file cycle by cycle. Time is that of the core and never the computer's.
class Mcu {
 public:
  Mcu(const std::string& elf, const Wiring& wiring);
  ~Mcu();
  Mcu(const Mcu&) = delete;
  Mcu& operator=(const Mcu&) = delete;

  /// Runs until a time since the start.
  void run_until_us(std::uint64_t time_us);
  std::uint64_t time_us() const;

  /// Calls back each period_us of simulated time, through resets too.
  void every(std::uint32_t period_us, std::function<void()> callback);
  /// Calls back after each reset.
  void on_reset(std::function<void()> callback) { reset_callbacks_.push_back(std::move(callback)); }

  /// Pulls the reset line.
  void reset();
  /// Sends the core into an endless loop with interrupts off, as a crash would.
  void hang();

  bool pin(const Pin& pin) const;
  std::uint8_t data(std::uint16_t address) const { return core_->data[address]; }
  /// Bytes of RAM that were never written since the start.
  int untouched_ram() const;

  std::vector<std::uint8_t> eeprom() const;
  void set_eeprom(const std::vector<std::uint8_t>& bytes);

  avr_t* core() const { return core_; }
  const Wiring& wiring() const { return wiring_; }
  /// Resets since the start, of whatever cause.
  int resets() const { return resets_; }

 private:
  struct Timer {
    Mcu* mcu;
    avr_cycle_count_t period;
    std::function<void()> callback;
  };

  static void take_reset(avr_t* core);
  static avr_cycle_count_t take_timer(avr_t* core, avr_cycle_count_t when, void* timer);
  static avr_cycle_count_t take_end(avr_t* core, avr_cycle_count_t when, void* self);
  void load(const std::string& elf);
  void mend_simavr();
  void start_timers();

  const Wiring& wiring_;
  avr_t* core_;
  void (*reset_of_core_)(avr_t*) = nullptr;
  std::vector<std::unique_ptr<Timer>> timers_;
  std::vector<std::function<void()>> reset_callbacks_;
  int resets_ = 0;
  bool is_ready_ = false;
};

}  // namespace emulator
