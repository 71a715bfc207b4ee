/// @file
/// Pseudo-terminal that stands in for the USB serial port.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace emulator {

/// The host opens the link; its end is raw from the start, so that nothing is echoed back.
class Pty {
 public:
  /// Throws std::system_error.
  explicit Pty(const std::string& link);
  ~Pty();
  Pty(const Pty&) = delete;
  Pty& operator=(const Pty&) = delete;

  /// What the host has written, as far as it has arrived.
  std::vector<std::uint8_t> read();
  /// Sends to the host; what does not fit, because nobody reads, is lost as on a real port.
  void write(const std::vector<std::uint8_t>& bytes);

  int descriptor() const { return master_; }
  std::uint64_t bytes_read() const { return bytes_read_; }
  std::uint64_t bytes_written() const { return bytes_written_; }

 private:
  std::string link_;
  int master_ = -1, slave_ = -1;
  std::uint64_t bytes_read_ = 0, bytes_written_ = 0;
};

}  // namespace emulator
