/// @file
/// openpty with a symbolic link to the host's end.
// SPDX-License-Identifier: Apache-2.0
#include "pty.hpp"

#include <fcntl.h>
#include <pty.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>

namespace emulator {
namespace {

void check(int result, const std::string& what) {
  if (result < 0) {
    throw std::system_error(errno, std::generic_category(), what);
  }
}

}  // namespace

Pty::Pty(const std::string& link) : link_(link) {
  termios raw{};
  cfmakeraw(&raw);
  std::array<char, 256> name{};
  // The slave stays open here too: otherwise its settings are lost whenever the host closes it.
  check(openpty(&master_, &slave_, name.data(), &raw, nullptr), "openpty");
  check(fcntl(master_, F_SETFL, O_NONBLOCK), "fcntl");
  unlink(link_.c_str());
  check(symlink(name.data(), link_.c_str()), link_);
}

Pty::~Pty() {
  unlink(link_.c_str());
  close(slave_);
  close(master_);
}

std::vector<std::uint8_t> Pty::read() {
  std::vector<std::uint8_t> bytes;
  std::array<std::uint8_t, 4096> chunk;
  ssize_t count;
  while ((count = ::read(master_, chunk.data(), chunk.size())) > 0) {
    bytes.insert(bytes.end(), chunk.begin(), chunk.begin() + count);
  }
  bytes_read_ += bytes.size();
  return bytes;
}

void Pty::write(const std::vector<std::uint8_t>& bytes) {
  if (bytes.empty()) {
    return;
  }
  const ssize_t count = ::write(master_, bytes.data(), bytes.size());
  bytes_written_ += count > 0 ? static_cast<std::uint64_t>(count) : 0;
}

}  // namespace emulator
