/// @file
/// UART 0 at 57600 baud with a ring for each direction.
// SPDX-License-Identifier: Apache-2.0
#include <avr/interrupt.h>
#include <avr/io.h>
#include <util/atomic.h>

#include "../hal.hpp"
#include "board_avr.hpp"

#if defined(USART_RX_vect)
#define UART_RX_vect USART_RX_vect
#define UART_UDRE_vect USART_UDRE_vect
#else
#define UART_RX_vect USART0_RX_vect
#define UART_UDRE_vect USART0_UDRE_vect
#endif

namespace hal {
namespace {

constexpr uint32_t kBaud = 57600;
constexpr uint8_t kReceiveMask = 63;
constexpr uint16_t kSendBytes = 256;

// Each index has one writer; the rings are volatile too, so that a byte is there before its index says so.
volatile uint8_t received[kReceiveMask + 1];
volatile uint8_t received_head, received_tail;
volatile uint8_t sending[kSendBytes];
volatile uint8_t send_head, send_tail;
volatile uint16_t overruns, dropped;

uint16_t read_atomic(const volatile uint16_t* counter) {
  uint16_t value = 0;
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) { value = *counter; }
  return value;
}

void count_up(volatile uint16_t* counter) {
  if (*counter != 0xFFFF) {
    *counter = *counter + 1;
  }
}

}  // namespace

void start_uart() {
  // U2X first: simavr takes the byte's duration when UBRR is written.
  UCSR0A = _BV(U2X0);
  UBRR0 = (F_CPU / 4 / kBaud - 1) / 2;
  UCSR0C = _BV(UCSZ01) | _BV(UCSZ00);
  UCSR0B = _BV(RXEN0) | _BV(TXEN0) | _BV(RXCIE0);
}

bool has_byte() { return received_head != received_tail; }

bool uart_take(uint8_t* byte) {
  if (!has_byte()) {
    return false;
  }
  *byte = received[received_tail];
  received_tail = (received_tail + 1) & kReceiveMask;
  return true;
}

uint8_t uart_room() { return static_cast<uint8_t>(send_tail - send_head - 1); }

void uart_put(uint8_t byte) {
  sending[send_head] = byte;
  send_head = static_cast<uint8_t>(send_head + 1);
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) { UCSR0B |= _BV(UDRIE0); }
}

uint16_t uart_overruns() { return read_atomic(&overruns); }

uint16_t uart_dropped() { return read_atomic(&dropped); }

}  // namespace hal

ISR(UART_RX_vect) {
  const uint8_t status = UCSR0A, byte = UDR0;
  if (status & _BV(DOR0)) {
    hal::count_up(&hal::overruns);
  }
  const uint8_t next = (hal::received_head + 1) & hal::kReceiveMask;
  if (next == hal::received_tail) {
    hal::count_up(&hal::dropped);
    return;
  }
  hal::received[hal::received_head] = byte;
  hal::received_head = next;
}

ISR(UART_UDRE_vect) {
  if (hal::send_tail == hal::send_head) {
    UCSR0B &= ~_BV(UDRIE0);
    return;
  }
  UDR0 = hal::sending[hal::send_tail];
  hal::send_tail = static_cast<uint8_t>(hal::send_tail + 1);
}
