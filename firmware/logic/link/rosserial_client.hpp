/// @file
/// The device's side of rosserial: tells the host its topics and notices whether it is there.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdint.h>

#include "../counters.hpp"
#include "endpoints.hpp"
#include "frame_reader.hpp"

namespace mtr {

/// Whatever the host missed (it started later, the device did, or a frame was damaged) is told again: on request, and
/// each second while TIME requests stay without an answer or no command arrives. After a stop by the host the device is
/// silent until it is asked.
class RosserialClient {
 public:
  /// handler gets the device's own topics, and kTopicStop.
  RosserialClient(FrameReader::Handler handler, void* context, Counters* counters)
      : handler_(handler), context_(context), reader_(host_payload_bytes, take, this, counters) {}

  void start(uint32_t now_us);

  /// Takes one byte from the line.
  void receive(uint8_t byte, uint32_t now_us);

  /// Negotiates and asks for the time, once per pass of the main loop; is_commanded: messages of the host arrive.
  void poll(uint32_t now_us, bool is_commanded);

  /// False after a stop by the host, and until it has been told the topics that it asked for: it would take a report
  /// for a lost negotiation and ask again, for ever.
  bool may_report() const { return open_ && !(is_asked_ && next_endpoint_ < kEndpointCount); }

 private:
  static void take(void* self, uint16_t topic, const uint8_t* payload, uint8_t length);
  void announce();
  bool send_endpoint(uint8_t index);
  bool ask_time();

  FrameReader::Handler handler_;
  void* context_;
  FrameReader reader_;
  uint32_t byte_us_ = 0;
  uint32_t now_us_ = 0;
  uint32_t heard_us_ = 0;
  uint32_t asked_us_ = 0;
  uint32_t announced_us_ = 0;
  bool open_ = true;
  bool time_due_ = true;
  bool host_heard_ = false;
  bool is_asked_ = false;
  uint8_t next_endpoint_ = 0;
};

}  // namespace mtr
