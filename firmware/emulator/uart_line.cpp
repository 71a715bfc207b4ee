/// @file
/// Pacing of bytes by the core's own timers.
// SPDX-License-Identifier: Apache-2.0
#include "uart_line.hpp"

#include <cstring>
#include <stdexcept>

// fifo_declare.h defines its functions as inline on request only.
DEFINE_FIFO(uint16_t, uart_fifo);

namespace emulator {
namespace {

constexpr char kUart = '0';
/// Two bytes in the receiver's buffer and one in its shift register.
constexpr int kUartBytes = 3;
/// simavr 1.6 counts a parity bit even when there is none.
constexpr avr_cycle_count_t kBits = 10, kBitsOfSimavr = 11;

/// Until the firmware sets up the UART, as after a reset, bytes pass at the pace of 57600 baud and are lost.
constexpr avr_cycle_count_t kCyclesBeforeSetUp = 2800;

avr_uart_t* find_uart(avr_t* core) {
  for (avr_io_t* io = core->io_port; io; io = io->next) {
    avr_uart_t* uart = reinterpret_cast<avr_uart_t*>(io);
    if (std::strcmp(io->kind, "uart") == 0 && uart->name == kUart) {
      return uart;
    }
  }
  throw std::runtime_error("The microcontroller has no UART 0.");
}

}  // namespace

UartLine::UartLine(Mcu* mcu, std::uint32_t seed) : mcu_(mcu), uart_(find_uart(mcu->core())), random_(seed) {
  std::uint32_t flags = 0;
  avr_ioctl(mcu->core(), AVR_IOCTL_UART_GET_FLAGS(kUart), &flags);
  flags &= ~static_cast<std::uint32_t>(AVR_UART_FLAG_STDIO | AVR_UART_FLAG_POLL_SLEEP);
  avr_ioctl(mcu->core(), AVR_IOCTL_UART_SET_FLAGS(kUart), &flags);
  avr_irq_register_notify(avr_io_getirq(mcu->core(), AVR_IOCTL_UART_GETIRQ(kUart), UART_IRQ_OUTPUT), sent, this);
  mcu->on_reset([this] {
    is_feeding_ = false;
    byte_cycles_ = 0;
    start_feeding();
  });
}

void UartLine::offer(const std::uint8_t* bytes, std::size_t count) {
  to_mcu_.insert(to_mcu_.end(), bytes, bytes + count);
  start_feeding();
}

std::vector<std::uint8_t> UartLine::take() {
  std::vector<std::uint8_t> taken;
  taken.swap(to_host_);
  return taken;
}

void UartLine::start_feeding() {
  if (is_feeding_ || to_mcu_.empty()) {
    return;
  }
  is_feeding_ = true;
  mend_byte_time();
  avr_cycle_timer_register(mcu_->core(), byte_cycles(), feed, this);
}

avr_cycle_count_t UartLine::byte_cycles() const { return byte_cycles_ ? byte_cycles_ : kCyclesBeforeSetUp; }

void UartLine::mend_byte_time() {
  if (uart_->cycles_per_byte && uart_->cycles_per_byte != byte_cycles_) {
    byte_cycles_ = uart_->cycles_per_byte = uart_->cycles_per_byte * kBits / kBitsOfSimavr;
  }
}

avr_cycle_count_t UartLine::feed(avr_t* core, avr_cycle_count_t when, void* self) {
  UartLine* line = static_cast<UartLine*>(self);
  line->mend_byte_time();
  std::uint8_t byte = line->to_mcu_.front();
  line->to_mcu_.pop_front();
  if (line->passes(&byte)) {
    if (uart_fifo_get_read_size(&line->uart_->input) >= kUartBytes) {
      ++line->overruns_;
    } else {
      avr_raise_irq(avr_io_getirq(core, AVR_IOCTL_UART_GETIRQ(kUart), UART_IRQ_INPUT), byte);
    }
  }
  line->is_feeding_ = !line->to_mcu_.empty();
  return line->is_feeding_ ? when + line->byte_cycles() : 0;
}

void UartLine::sent(avr_irq_t*, std::uint32_t value, void* self) {
  UartLine* line = static_cast<UartLine*>(self);
  std::uint8_t byte = static_cast<std::uint8_t>(value);
  if (line->passes(&byte)) {
    line->to_host_.push_back(byte);
  }
}

bool UartLine::passes(std::uint8_t* byte) {
  if (is_cut_ || chance(drop_)) {
    return false;
  }
  if (chance(corrupt_)) {
    *byte = static_cast<std::uint8_t>(*byte ^ 1 << random_() % 8);
  }
  return true;
}

}  // namespace emulator
