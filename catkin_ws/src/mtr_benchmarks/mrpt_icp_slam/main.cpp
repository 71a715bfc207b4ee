/// @file
/// MRPT's CMetricMapBuilderICP with a points map over scans and odometry from a file; its poses as CSV.
///
/// Input, little endian: int64 number of scans, int64 beams of a scan; then for each scan double stamp (s), double x, y
/// (m) and heading (rad) by odometry, float ranges (m, 0: none) over the full circle from -pi.
// SPDX-License-Identifier: Apache-2.0
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/slam/CMetricMapBuilderICP.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <iostream>
#include <vector>

namespace {

using mrpt::obs::CActionCollection;
using mrpt::obs::CActionRobotMovement2D;
using mrpt::obs::CObservation2DRangeScan;
using mrpt::obs::CSensoryFrame;
using mrpt::poses::CPose2D;

constexpr float kRangeMax = 30.0F;

struct Record {
  double stamp_s = 0.0;
  CPose2D odometry;
  std::vector<float> ranges;
};

std::int64_t read_count(std::istream& in) {
  std::int64_t count = 0;
  in.read(reinterpret_cast<char*>(&count), sizeof count);
  return count;
}

bool read_record(std::istream& in, std::int64_t beams, Record& record) {
  double values[4] = {};
  record.ranges.resize(static_cast<std::size_t>(beams));
  in.read(reinterpret_cast<char*>(values), sizeof values);
  in.read(reinterpret_cast<char*>(record.ranges.data()), beams * static_cast<std::int64_t>(sizeof(float)));
  record.stamp_s = values[0];
  record.odometry = CPose2D(values[1], values[2], values[3]);
  return static_cast<bool>(in);
}

CSensoryFrame frame_of(const Record& record) {
  auto scan = CObservation2DRangeScan::Create();
  scan->aperture = static_cast<float>(2.0 * M_PI);
  scan->maxRange = kRangeMax;
  scan->rightToLeft = true;
  scan->timestamp = mrpt::Clock::fromDouble(record.stamp_s);
  scan->resizeScan(record.ranges.size());
  for (std::size_t beam = 0; beam < record.ranges.size(); ++beam) {
    scan->setScanRange(beam, record.ranges[beam] > 0.0F ? record.ranges[beam] : kRangeMax);
    scan->setScanRangeValidity(beam, record.ranges[beam] > 0.0F);
  }
  CSensoryFrame frame;
  frame.insert(scan);
  return frame;
}

CActionCollection movement(const Record& record, const CPose2D& before) {
  CActionRobotMovement2D action;
  action.timestamp = mrpt::Clock::fromDouble(record.stamp_s);
  action.computeFromOdometry(record.odometry - before, CActionRobotMovement2D::TMotionModelOptions());
  CActionCollection actions;
  actions.insert(action);
  return actions;
}

/// Configuration of MRPT's icp-slam application, with a finer points map.
void configure(mrpt::slam::CMetricMapBuilderICP& builder) {
  builder.setVerbosityLevel(mrpt::system::LVL_ERROR);
  mrpt::maps::CSimplePointsMap::TMapDefinition points;
  points.insertionOpts.minDistBetweenLaserPoints = 0.02F;
  builder.ICP_options.mapInitializers.push_back(points);
  builder.ICP_options.matchAgainstTheGrid = false;
  builder.ICP_options.insertionLinDistance = 0.5;
  builder.ICP_options.insertionAngDistance = mrpt::DEG2RAD(20.0);
  builder.ICP_options.localizationLinDistance = 0.0;
  builder.ICP_options.localizationAngDistance = 0.0;
  builder.ICP_options.minICPgoodnessToAccept = 0.4;
  builder.ICP_params.maxIterations = 80;
  builder.ICP_params.thresholdDist = 0.3;
  builder.ICP_params.thresholdAng = mrpt::DEG2RAD(1.0);
  builder.ICP_params.ALFA = 0.8;
  builder.ICP_params.smallestThresholdDist = 0.05;
  builder.ICP_params.ICP_covariance_method = mrpt::slam::icpCovLinealMSE;
  builder.initialize();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "Usage: mrpt_icp_slam INPUT OUTPUT.csv\n";
    return 2;
  }
  std::ifstream in(argv[1], std::ios::binary);
  std::ofstream out(argv[2]);
  const std::int64_t scans = read_count(in);
  const std::int64_t beams = read_count(in);
  if (!in || !out || scans < 1 || beams < 1) {
    std::cerr << argv[1] << " is not an input of scans, or " << argv[2] << " cannot be written.\n";
    return 1;
  }
  mrpt::slam::CMetricMapBuilderICP builder;
  configure(builder);
  out << "stamp_s,x_m,y_m,heading_rad\n" << std::fixed;
  out.precision(6);
  Record record;
  CPose2D before;
  double cpu_s = 0.0;
  for (std::int64_t index = 0; index < scans && read_record(in, beams, record); ++index) {
    CActionCollection actions = movement(record, index ? before : record.odometry);
    CSensoryFrame frame = frame_of(record);
    before = record.odometry;
    const std::clock_t begun = std::clock();
    builder.processActionObservation(actions, frame);
    cpu_s += static_cast<double>(std::clock() - begun) / CLOCKS_PER_SEC;
    const CPose2D pose(builder.getCurrentPoseEstimation()->getMeanVal());
    out << record.stamp_s << ',' << pose.x() << ',' << pose.y() << ',' << pose.phi() << '\n';
  }
  std::cout << 1e3 * cpu_s / static_cast<double>(scans) << '\n';
  return 0;
}
