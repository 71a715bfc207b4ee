/// @file
/// simavr 1.6 with its deviations from the silicon put right.
// SPDX-License-Identifier: Apache-2.0
#include "mcu.hpp"

#include <simavr/avr_eeprom.h>
#include <simavr/avr_extint.h>
#include <simavr/avr_timer.h>
#include <simavr/sim_elf.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <stdexcept>

namespace emulator {
namespace {

constexpr std::uint32_t kFrequencyHz = 16000000;
constexpr std::uint32_t kCyclesPerUs = kFrequencyHz / 1000000;
constexpr std::uint32_t kSupplyMv = 5000;
constexpr std::uint8_t kPaint = 0xC5;
/// rjmp to itself: avr-libc ends each program with it.
constexpr std::uint8_t kEndlessLoop[] = {0xFF, 0xCF};

void log_errors(avr_t*, const int level, const char* format, va_list arguments) {
  if (level <= LOG_ERROR) {
    std::vfprintf(stderr, format, arguments);
  }
}

/// The loop that paces the core sleeps, not the core itself.
void do_not_sleep(avr_t*, avr_cycle_count_t) {}

}  // namespace

Mcu::Mcu(const std::string& elf, const Wiring& wiring) : wiring_(wiring), core_(avr_make_mcu_by_name(wiring.mcu)) {
  if (!core_) {
    throw std::runtime_error(std::string("simavr does not know the microcontroller ") + wiring.mcu + ".");
  }
  load(elf);
}

Mcu::~Mcu() { avr_terminate(core_); }

void Mcu::load(const std::string& elf) {
  avr_global_logger_set(log_errors);
  elf_firmware_t firmware;
  std::memset(&firmware, 0, sizeof firmware);
  if (elf_read_firmware(elf.c_str(), &firmware)) {
    throw std::runtime_error("The firmware " + elf + " cannot be read.");
  }
  avr_init(core_);
  firmware.frequency = kFrequencyHz;
  avr_load_firmware(core_, &firmware);
  core_->frequency = kFrequencyHz;
  core_->vcc = core_->avcc = core_->aref = kSupplyMv;
  core_->sleep = do_not_sleep;
  std::memset(core_->data + wiring_.last_register + 1, kPaint, core_->ramend - wiring_.last_register);
  core_->data[kMcusr] = kPowerOn;
  mend_simavr();
  core_->custom.data = this;
  reset_of_core_ = core_->reset;
  core_->reset = take_reset;
  is_ready_ = true;
}

void Mcu::mend_simavr() {
  for (avr_io_t* io = core_->io_port; io; io = io->next) {
    if (std::strcmp(io->kind, "timer") != 0) {
      continue;
    }
    // The table of the ATmega328P calls modes 14 and 15 phase-correct; they are fast PWM.
    avr_timer_t* timer = reinterpret_cast<avr_timer_t*>(io);
    for (int mode = 14; mode <= 15; ++mode) {
      if (timer->wgm_op[mode].kind == avr_timer_wgm_pwm) {
        timer->wgm_op[mode].kind = avr_timer_wgm_fast_pwm;
      }
    }
  }
  // A low INT pin would be polled at each cycle even when its interrupt is off.
  for (int line = 0; line < 8; ++line) {
    avr_extint_set_strict_lvl_trig(core_, static_cast<std::uint8_t>(line), 0);
  }
}

void Mcu::take_reset(avr_t* core) {
  Mcu* self = static_cast<Mcu*>(core->custom.data);
  if (self->reset_of_core_) {
    self->reset_of_core_(core);
  }
  ++self->resets_;
  // simavr forgets the timers of everybody.
  self->start_timers();
  for (const auto& callback : self->reset_callbacks_) {
    callback();
  }
}

void Mcu::run_until_us(std::uint64_t time_us) {
  const avr_cycle_count_t end = time_us * kCyclesPerUs;
  if (end <= core_->cycle) {
    return;
  }
  // A sleeping core jumps to the next timer: without one at the end it would run past it.
  avr_cycle_timer_register(core_, end - core_->cycle, take_end, this);
  while (core_->cycle < end) {
    const int state = avr_run(core_);
    if (state == cpu_Done || state == cpu_Crashed) {
      throw std::runtime_error("The firmware has crashed the emulated core.");
    }
  }
  avr_cycle_timer_cancel(core_, take_end, this);
}

avr_cycle_count_t Mcu::take_end(avr_t*, avr_cycle_count_t, void*) { return 0; }

std::uint64_t Mcu::time_us() const { return core_->cycle / kCyclesPerUs; }

void Mcu::every(std::uint32_t period_us, std::function<void()> callback) {
  timers_.push_back(std::unique_ptr<Timer>(new Timer{this, period_us * kCyclesPerUs, std::move(callback)}));
  avr_cycle_timer_register(core_, timers_.back()->period, take_timer, timers_.back().get());
}

void Mcu::start_timers() {
  for (const auto& timer : timers_) {
    avr_cycle_timer_register(core_, timer->period, take_timer, timer.get());
  }
}

avr_cycle_count_t Mcu::take_timer(avr_t*, avr_cycle_count_t when, void* timer) {
  Timer* self = static_cast<Timer*>(timer);
  self->callback();
  return when + self->period;
}

void Mcu::reset() {
  avr_reset(core_);
  core_->data[kMcusr] = kExternal;
}

void Mcu::hang() {
  const std::uint8_t* begin = core_->flash;
  const std::uint8_t* end = begin + core_->flashend;
  const std::uint8_t* loop = std::search(begin, end, std::begin(kEndlessLoop), std::end(kEndlessLoop));
  if (loop == end) {
    throw std::runtime_error("The firmware has no endless loop to hang in.");
  }
  core_->pc = static_cast<avr_flashaddr_t>(loop - begin);
  core_->sreg[S_I] = 0;
  core_->state = cpu_Running;
}

bool Mcu::pin(const Pin& pin) const { return (core_->data[pin.port - 1] & core_->data[pin.port] & 1 << pin.bit) != 0; }

int Mcu::untouched_ram() const {
  int longest = 0, run = 0;
  for (int address = wiring_.last_register + 1; address <= core_->ramend; ++address) {
    run = core_->data[address] == kPaint ? run + 1 : 0;
    longest = std::max(longest, run);
  }
  return longest;
}

std::vector<std::uint8_t> Mcu::eeprom() const {
  std::vector<std::uint8_t> bytes(core_->e2end + 1);
  avr_eeprom_desc_t description = {bytes.data(), 0, static_cast<std::uint32_t>(bytes.size())};
  avr_ioctl(core_, AVR_IOCTL_EEPROM_GET, &description);
  return bytes;
}

void Mcu::set_eeprom(const std::vector<std::uint8_t>& bytes) {
  std::vector<std::uint8_t> copy = bytes;
  copy.resize(std::min<std::size_t>(copy.size(), core_->e2end + 1));
  avr_eeprom_desc_t description = {copy.data(), 0, static_cast<std::uint32_t>(copy.size())};
  avr_ioctl(core_, AVR_IOCTL_EEPROM_SET, &description);
}

}  // namespace emulator
