/// @file
/// Topics of the firmware as rosserial negotiates them.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdint.h>

namespace mtr {

/// Topics that rosserial reserves.
enum : uint16_t {
  kTopicNegotiate = 0,  ///< host: asks for topics; device: here is a publisher
  kTopicSubscriber = 1,
  kTopicTime = 10,
  kTopicStop = 11,
};

/// Topics of this device.
enum : uint16_t {
  kTopicCommand = 100,
  kTopicPress = 101,
  kTopicCalibrate = 102,
  kTopicSignals = 103,
  kTopicState = 125,
  kTopicHealth = 126,
  kTopicEcho = 127,
  kTopicInputs = 128,
};

constexpr uint8_t kMd5Bytes = 32;

struct Endpoint {
  uint16_t topic;
  uint8_t negotiation;  ///< kTopicNegotiate or kTopicSubscriber
  uint8_t payload_bytes;
  char name[24];
  char type[32];
  char md5[kMd5Bytes + 1];
};

constexpr uint8_t kEndpointCount = 8;

/// In flash: read it with pgm_read_*. Publishers first: the host takes a message that it knows nothing of for a lost
/// negotiation.
extern const Endpoint kEndpoints[kEndpointCount];

/// Payload bytes of a topic that the host may send, or kUnknownTopic.
int16_t host_payload_bytes(uint16_t topic);

}  // namespace mtr
