/// @file
/// Finds rosserial frames in a stream of bytes.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdint.h>

#include "../counters.hpp"

namespace mtr {

/// rosserial revision 2: FF FE, length, its check, topic, payload, check.
constexpr uint8_t kSync = 0xFF;
constexpr uint8_t kRevision = 0xFE;
constexpr uint8_t kHeaderBytes = 7;
constexpr uint8_t kFrameOverheadBytes = 8;
constexpr uint8_t kLongestPayload = 24;
constexpr int16_t kUnknownTopic = -1;

/// Only frames of known topics with exactly their length are waited for, so that damage swallows few bytes; after a
/// bad frame the search goes on with the byte after its first, so that a whole frame within is found.
class FrameReader {
 public:
  /// Payload bytes of a topic, or kUnknownTopic.
  using LengthOf = int16_t (*)(uint16_t topic);
  using Handler = void (*)(void* context, uint16_t topic, const uint8_t* payload, uint8_t length);

  FrameReader(LengthOf length_of, Handler handler, void* context, Counters* counters)
      : length_of_(length_of), handler_(handler), context_(context), counters_(counters) {}

  /// Takes one byte and hands over the frames that it completes.
  void push(uint8_t byte);

  /// Gives up the frame that has begun, because nothing follows; looks for others within.
  void flush();

  /// True when a frame has begun.
  bool is_waiting() const { return size_ > 0; }

 private:
  enum class Found { kNothing, kPart, kFrame };

  void search();
  Found look();
  Found skip(uint16_t* counter);
  void drop(uint8_t bytes);

  LengthOf length_of_;
  Handler handler_;
  void* context_;
  Counters* counters_;
  uint8_t buffer_[kLongestPayload + kFrameOverheadBytes] = {};
  uint8_t size_ = 0;
};

}  // namespace mtr
