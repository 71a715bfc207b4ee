/// @file
/// Negotiation, one topic per pass of the main loop.
// SPDX-License-Identifier: Apache-2.0
#include "rosserial_client.hpp"

#include <string.h>

#include "../../hal/hal.hpp"
#include "../config.hpp"
#include "../progmem.hpp"
#include "endpoints.hpp"
#include "frame_writer.hpp"

namespace mtr {
namespace {

/// What the host is told about the size of our buffer: it drops longer messages.
constexpr uint32_t kBufferBytes = kLongestPayload;

/// Topics are announced one at a time on an idle line, so that reports wait behind one of them at most.
constexpr uint8_t kIdleRoom = 250;

uint8_t flash_length(const char* text) {
  uint8_t length = 0;
  while (pgm_read_byte(text + length)) {
    ++length;
  }
  return length;
}

void write_string(FrameWriter* frame, const char* text, uint8_t length) {
  frame->u32(length);
  for (uint8_t i = 0; i < length; ++i) {
    frame->u8(static_cast<uint8_t>(pgm_read_byte(text + i)));
  }
}

}  // namespace

void RosserialClient::start(uint32_t now_us) { now_us_ = byte_us_ = heard_us_ = asked_us_ = announced_us_ = now_us; }

void RosserialClient::receive(uint8_t byte, uint32_t now_us) {
  now_us_ = byte_us_ = now_us;
  reader_.push(byte);
}

void RosserialClient::poll(uint32_t now_us, bool is_commanded) {
  now_us_ = now_us;
  if (reader_.is_waiting() && now_us - byte_us_ > kFrameGapUs) {
    reader_.flush();
  }
  if (!open_) {
    return;
  }
  if (host_heard_ && now_us - heard_us_ > kHostLostUs) {
    host_heard_ = false;
  }
  if (!(host_heard_ && is_commanded) && now_us - announced_us_ >= kAnnouncePeriodUs) {
    is_asked_ = false;
    announce();
  }
  if (now_us - asked_us_ >= kTimePeriodUs) {
    time_due_ = true;
    asked_us_ = now_us;
  }
  // With no room now, the next pass tries again.
  if (time_due_) {
    time_due_ = !ask_time();
  } else if (next_endpoint_ < kEndpointCount && hal::uart_room() >= kIdleRoom && send_endpoint(next_endpoint_)) {
    ++next_endpoint_;
  }
}

void RosserialClient::take(void* self, uint16_t topic, const uint8_t* payload, uint8_t length) {
  RosserialClient* client = static_cast<RosserialClient*>(self);
  switch (topic) {
    case kTopicNegotiate:
      client->open_ = true;
      client->time_due_ = true;
      client->is_asked_ = true;
      client->announce();
      return;
    case kTopicTime:
      client->host_heard_ = true;
      client->heard_us_ = client->now_us_;
      return;
    case kTopicStop:
      client->open_ = false;
      break;
    default:
      break;
  }
  client->handler_(client->context_, topic, payload, length);
}

void RosserialClient::announce() {
  announced_us_ = now_us_;
  next_endpoint_ = 0;
}

bool RosserialClient::send_endpoint(uint8_t index) {
  const Endpoint& endpoint = kEndpoints[index];
  const uint8_t name_bytes = flash_length(endpoint.name), type_bytes = flash_length(endpoint.type);
  FrameWriter frame;
  const uint8_t length = static_cast<uint8_t>(2 + 4 + name_bytes + 4 + type_bytes + 4 + kMd5Bytes + 4);
  if (!frame.begin(pgm_read_byte(&endpoint.negotiation), length)) {
    return false;
  }
  frame.u16(pgm_read_word(&endpoint.topic));
  write_string(&frame, endpoint.name, name_bytes);
  write_string(&frame, endpoint.type, type_bytes);
  write_string(&frame, endpoint.md5, kMd5Bytes);
  frame.u32(kBufferBytes);
  frame.end();
  return true;
}

bool RosserialClient::ask_time() {
  FrameWriter frame;
  if (!frame.begin(kTopicTime, 8)) {
    return false;
  }
  frame.u32(0);
  frame.u32(0);
  frame.end();
  return true;
}

}  // namespace mtr
