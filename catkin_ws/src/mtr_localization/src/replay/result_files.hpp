/// @file
/// Output files of a replay.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "replay/replay.hpp"

namespace mtr_localization::replay {

/// Writes trajectory.csv, surfaces.csv, key_frames.csv, map.pgm, map.yaml and summary.json into the folder, which is
/// created. Throws std::runtime_error with one sentence.
void write_files(const Result& result, const std::string& bag, const std::string& folder);

}  // namespace mtr_localization::replay
