/// @file
/// Table of topics; types, sums and sizes come from the .msg files.
// SPDX-License-Identifier: Apache-2.0
#include "endpoints.hpp"

#include "../progmem.hpp"
#include "definitions.hpp"
#include "frame_reader.hpp"

namespace mtr {
namespace {

/// sec and nsec of the host
constexpr int16_t kTimeBytes = 8;

static_assert(MTR_FIRMWARECOMMAND_BYTES <= kLongestPayload && MTR_FIRMWAREPRESS_BYTES <= kLongestPayload &&
                  MTR_FIRMWARECALIBRATE_BYTES <= kLongestPayload && MTR_FIRMWARESIGNALS_BYTES <= kLongestPayload,
              "the reader's buffer must hold each message");

}  // namespace

const Endpoint kEndpoints[kEndpointCount] PROGMEM = {
    {kTopicState, kTopicNegotiate, MTR_FIRMWARESTATE_BYTES, "/firmware/state", MTR_FIRMWARESTATE_TYPE,
     MTR_FIRMWARESTATE_MD5},
    {kTopicHealth, kTopicNegotiate, MTR_FIRMWAREHEALTH_BYTES, "/firmware/health", MTR_FIRMWAREHEALTH_TYPE,
     MTR_FIRMWAREHEALTH_MD5},
    {kTopicEcho, kTopicNegotiate, MTR_FIRMWAREECHO_BYTES, "/firmware/echo", MTR_FIRMWAREECHO_TYPE,
     MTR_FIRMWAREECHO_MD5},
    {kTopicInputs, kTopicNegotiate, MTR_FIRMWAREINPUTS_BYTES, "/firmware/inputs", MTR_FIRMWAREINPUTS_TYPE,
     MTR_FIRMWAREINPUTS_MD5},
    {kTopicCommand, kTopicSubscriber, MTR_FIRMWARECOMMAND_BYTES, "/firmware/command", MTR_FIRMWARECOMMAND_TYPE,
     MTR_FIRMWARECOMMAND_MD5},
    {kTopicPress, kTopicSubscriber, MTR_FIRMWAREPRESS_BYTES, "/firmware/press", MTR_FIRMWAREPRESS_TYPE,
     MTR_FIRMWAREPRESS_MD5},
    {kTopicCalibrate, kTopicSubscriber, MTR_FIRMWARECALIBRATE_BYTES, "/firmware/calibrate", MTR_FIRMWARECALIBRATE_TYPE,
     MTR_FIRMWARECALIBRATE_MD5},
    {kTopicSignals, kTopicSubscriber, MTR_FIRMWARESIGNALS_BYTES, "/firmware/signals", MTR_FIRMWARESIGNALS_TYPE,
     MTR_FIRMWARESIGNALS_MD5},
};

int16_t host_payload_bytes(uint16_t topic) {
  switch (topic) {
    case kTopicNegotiate:
    case kTopicStop:
      return 0;
    case kTopicTime:
      return kTimeBytes;
    case kTopicCommand:
      return MTR_FIRMWARECOMMAND_BYTES;
    case kTopicPress:
      return MTR_FIRMWAREPRESS_BYTES;
    case kTopicCalibrate:
      return MTR_FIRMWARECALIBRATE_BYTES;
    case kTopicSignals:
      return MTR_FIRMWARESIGNALS_BYTES;
    default:
      return kUnknownTopic;
  }
}

}  // namespace mtr
