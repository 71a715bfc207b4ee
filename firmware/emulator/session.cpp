/// @file
/// Real time against the computer's clock, or steps on request.
// SPDX-License-Identifier: Apache-2.0
#include "session.hpp"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <exception>
#include <fstream>
#include <iterator>
#include <sstream>

namespace emulator {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::int64_t kNsPerUs = 1000, kNsPerS = 1000000000;
/// Stepped, nothing happens by itself; this is how soon the end of the parent is noticed.
constexpr std::int64_t kIdleNs = 500000000;
constexpr int kByteTimeoutS = 2;
/// Behind by more, time that is lost is not made up for.
constexpr double kGiveUpLagS = 0.25;

/// The sentence may quote what a client has sent.
std::string error(std::string sentence) {
  for (char& letter : sentence) {
    letter = letter == '"' || letter == '\\' || std::iscntrl(static_cast<unsigned char>(letter)) ? '?' : letter;
  }
  return "{\"error\": \"" + sentence + "\"}";
}

}  // namespace

Session::Session(const Options& options)
    : options_(options),
      emulator_(options.elf, options.mcu, options.lift, options.seed),
      pty_(options.pty),
      control_(options.control, [this](const std::string& line) { return answer(line); }) {
  std::ifstream file(options_.eeprom, std::ios::binary);
  if (file) {
    emulator_.mcu().set_eeprom({std::istreambuf_iterator<char>(file), {}});
  }
}

void Session::run(const volatile std::sig_atomic_t* stop) {
  if (options_.is_stepped) {
    const pid_t parent = getppid();
    while (!*stop && !is_stopped_ && getppid() == parent) {
      wait(kIdleNs);
    }
  } else {
    run_real_time(stop);
  }
  save_eeprom();
}

void Session::run_real_time(const volatile std::sig_atomic_t* stop) {
  const pid_t parent = getppid();
  Clock::time_point started = Clock::now();
  std::uint64_t started_us = 0;
  while (!*stop && !is_stopped_ && getppid() == parent) {
    run_until_us(time_us_ + options_.quantum_us);
    const auto due = started + std::chrono::microseconds(time_us_ - started_us);
    const auto ahead = std::chrono::duration_cast<std::chrono::nanoseconds>(due - Clock::now()).count();
    worst_lag_s_ = std::max(worst_lag_s_, -static_cast<double>(ahead) / kNsPerS);
    if (-ahead > kGiveUpLagS * kNsPerS) {
      started = Clock::now();
      started_us = time_us_;
    }
    wait(std::max<std::int64_t>(0, ahead));
  }
}

void Session::run_until_us(std::uint64_t time_us) {
  const auto bytes = pty_.read();
  emulator_.line().offer(bytes.data(), bytes.size());
  time_us_ = time_us;
  emulator_.mcu().run_until_us(time_us);
  pty_.write(emulator_.line().take());
}

void Session::wait(std::int64_t ns) {
  const Clock::time_point end = Clock::now() + std::chrono::nanoseconds(ns);
  do {
    auto descriptors = control_.descriptors();
    const timespec time = {ns / kNsPerS, ns % kNsPerS};
    if (ppoll(descriptors.data(), descriptors.size(), &time, nullptr) <= 0) {
      return;
    }
    control_.serve();
    ns = std::chrono::duration_cast<std::chrono::nanoseconds>(end - Clock::now()).count();
  } while (ns > 0 && !is_stopped_);
}

std::string Session::answer(const std::string& line) {
  std::istringstream words(line);
  std::string command;
  words >> command;
  try {
    if (command == "step") {
      return step(words);
    }
    if (command == "probe") {
      return probe();
    }
    if (command == "stop_contact") {
      return stop_contact(words);
    }
    if (command == "fault") {
      return fault(words);
    }
    if (command == "stop") {
      is_stopped_ = true;
      return "{\"ok\": true}";
    }
  } catch (const std::exception& failure) {
    return error(failure.what());
  }
  return error("There is no command " + command + ".");
}

std::string Session::step(std::istream& arguments) {
  std::uint64_t us = 0, bytes = 0;
  if (!options_.is_stepped || !(arguments >> us)) {
    return error("step needs a time in us and --stepped.");
  }
  if (arguments >> bytes && !await_bytes(bytes)) {
    return error("The bytes of the host have not arrived.");
  }
  run_until_us(time_us_ + us);
  return "{\"ok\": true, " + totals() + "}";
}

bool Session::await_bytes(std::uint64_t total) {
  // A pseudo-terminal hands bytes over when the kernel finds time, so that what was written may not be there yet.
  const Clock::time_point end = Clock::now() + std::chrono::seconds(kByteTimeoutS);
  while (true) {
    const auto bytes = pty_.read();
    emulator_.line().offer(bytes.data(), bytes.size());
    if (pty_.bytes_read() >= total) {
      return pty_.bytes_read() == total;
    }
    pollfd port = {pty_.descriptor(), POLLIN, 0};
    if (Clock::now() > end || poll(&port, 1, kByteTimeoutS * 1000) <= 0) {
      return false;
    }
  }
}

std::string Session::fault(std::istream& arguments) {
  std::string name;
  std::uint32_t one_in = 0;
  arguments >> name >> one_in;
  emulator_.fault(name, one_in);
  return "{\"ok\": true}";
}

std::string Session::stop_contact(std::istream& arguments) {
  std::string state;
  arguments >> state;
  emulator_.set_stop_contact(state);
  return "{\"ok\": true}";
}

std::string Session::probe() const {
  const Probe seen = emulator_.probe();
  std::ostringstream text;
  text.precision(9);
  text << std::boolalpha << "{\"ok\": true, " << totals() << ", \"servo_us\": [" << seen.servo_us[0] << ", "
       << seen.servo_us[1] << "], \"led\": [" << seen.leds[0] << ", " << seen.leds[1] << ", " << seen.leds[2]
       << "], \"buzzer\": " << seen.buzzer << ", \"beacon\": " << seen.beacon << ", \"lift_m\": " << seen.lift_m
       << ", \"lift_duty\": " << seen.lift_duty << ", \"untouched_ram\": " << seen.untouched_ram
       << ", \"resets\": " << seen.resets << ", \"overruns\": " << seen.overruns
       << ", \"worst_lag_s\": " << worst_lag_s_ << "}";
  return text.str();
}

std::string Session::totals() const {
  std::ostringstream text;
  text << "\"time_us\": " << time_us_ << ", \"rx\": " << pty_.bytes_read() << ", \"tx\": " << pty_.bytes_written();
  return text.str();
}

void Session::save_eeprom() const {
  if (options_.eeprom.empty()) {
    return;
  }
  const auto bytes = emulator_.mcu().eeprom();
  std::ofstream file(options_.eeprom, std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace emulator
