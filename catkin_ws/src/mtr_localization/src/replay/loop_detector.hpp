/// @file
/// Notices when a robot has driven round something.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "map_names.hpp"

namespace mtr_localization::replay {

/// Watches the key frames as they come.
class LoopDetector {
 public:
  /// True once the path has come back to where it was and turned a full turn on the way.
  bool closes(const std::vector<KeyFrame>& key_frames);

 private:
  std::size_t seen_ = 0;
  bool closed_ = false;
};

}  // namespace mtr_localization::replay
