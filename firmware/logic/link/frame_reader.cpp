/// @file
/// Search for frames in a buffer that always begins with the first byte of what may be one.
// SPDX-License-Identifier: Apache-2.0
#include "frame_reader.hpp"

#include <string.h>

namespace mtr {

void FrameReader::push(uint8_t byte) {
  buffer_[size_++] = byte;
  search();
}

void FrameReader::flush() {
  while (size_ > 0) {
    count(&counters_->skipped_frames);
    drop(1);
    search();
  }
}

void FrameReader::search() {
  while (size_ > 0) {
    const Found found = look();
    if (found == Found::kPart) {
      return;
    }
    drop(found == Found::kFrame ? static_cast<uint8_t>(buffer_[2] + kFrameOverheadBytes) : 1);
  }
}

FrameReader::Found FrameReader::look() {
  if (buffer_[0] != kSync || (size_ > 1 && buffer_[1] != kRevision)) {
    return Found::kNothing;
  }
  if (size_ < kHeaderBytes) {
    return Found::kPart;
  }
  const uint16_t length = static_cast<uint16_t>(buffer_[2] | buffer_[3] << 8);
  const uint16_t topic = static_cast<uint16_t>(buffer_[5] | buffer_[6] << 8);
  if (static_cast<uint8_t>(buffer_[2] + buffer_[3] + buffer_[4]) != 0xFF) {
    return skip(&counters_->checksum_errors);
  }
  if (length > kLongestPayload || length_of_(topic) != static_cast<int16_t>(length)) {
    return skip(&counters_->skipped_frames);
  }
  if (size_ < kFrameOverheadBytes + length) {
    return Found::kPart;
  }
  uint8_t sum = 0;
  for (uint8_t i = 5; i < kFrameOverheadBytes + length; ++i) {
    sum = static_cast<uint8_t>(sum + buffer_[i]);
  }
  if (sum != 0xFF) {
    return skip(&counters_->checksum_errors);
  }
  handler_(context_, topic, buffer_ + kHeaderBytes, static_cast<uint8_t>(length));
  return Found::kFrame;
}

FrameReader::Found FrameReader::skip(uint16_t* counter) {
  count(counter);
  return Found::kNothing;
}

void FrameReader::drop(uint8_t bytes) {
  // Nothing but the start of a frame is kept.
  while (bytes < size_ && buffer_[bytes] != kSync) {
    ++bytes;
  }
  size_ = static_cast<uint8_t>(size_ - bytes);
  memmove(buffer_, buffer_ + bytes, size_);
}

}  // namespace mtr
