/// @file
/// One run of the emulator: its time, its port and what the control socket asks for.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <csignal>
#include <cstdint>
#include <string>
#include <vector>

#include "control_socket.hpp"
#include "emulator.hpp"
#include "options.hpp"
#include "pty.hpp"

namespace emulator {

class Session {
 public:
  explicit Session(const Options& options);

  /// Until `stop`, a signal, or the end of the process that started this one.
  void run(const volatile std::sig_atomic_t* stop);

 private:
  std::string answer(const std::string& line);
  std::string step(std::istream& arguments);
  std::string fault(std::istream& arguments);
  std::string stop_contact(std::istream& arguments);
  std::string probe() const;
  std::string totals() const;
  bool await_bytes(std::uint64_t total);
  void run_until_us(std::uint64_t time_us);
  void wait(std::int64_t ns);
  void run_real_time(const volatile std::sig_atomic_t* stop);
  void save_eeprom() const;

  Options options_;
  Emulator emulator_;
  Pty pty_;
  ControlSocket control_;
  /// End of the last step; the core may stand a few cycles later.
  std::uint64_t time_us_ = 0;
  double worst_lag_s_ = 0.0;
  bool is_stopped_ = false;
};

}  // namespace emulator
