/// @file
/// CSV, PGM and YAML output.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_surfel_map/map_files.hpp"

#include <cmath>
#include <fstream>
#include <iomanip>
#include <stdexcept>

namespace mtr_surfel_map {
namespace {

// Grey levels of map_server: occupied is black, free is nearly white, unknown is between them.
constexpr char kBlack = 0;
constexpr char kWhite = static_cast<char>(254);
constexpr char kGrey = static_cast<char>(205);

std::ofstream open(const std::string& path) {
  std::ofstream file(path, std::ios::binary);
  if (!file) {
    throw std::runtime_error("File " + path + " cannot be written.");
  }
  file << std::fixed << std::setprecision(6);
  return file;
}

void close(std::ofstream& file, const std::string& path) {
  file.close();
  if (!file) {
    throw std::runtime_error("File " + path + " could not be written completely.");
  }
}

char shade_of(std::int8_t cell) {
  if (cell == OccupancyGrid::kUnknown) {
    return kGrey;
  }
  return cell == OccupancyGrid::kFree ? kWhite : kBlack;
}

}  // namespace

void write_surfaces(const AdjustedMap& map, const std::string& path) {
  std::ofstream file = open(path);
  file << "x_m,y_m,normal_rad,length_m,sigma_m,hits\n";
  for (const Surfel& surfel : map.surfels) {
    file << surfel.position.x() << ',' << surfel.position.y() << ',' << std::atan2(surfel.normal.y(), surfel.normal.x())
         << ',' << surfel.length_m << ',' << surfel.sigma_m << ',' << surfel.hits << '\n';
  }
  close(file, path);
}

void write_key_frames(const AdjustedMap& map, const std::string& path) {
  std::ofstream file = open(path);
  file << "stamp_s,x_m,y_m,heading_rad,cxx,cxy,cxh,cyx,cyy,cyh,chx,chy,chh,returns,standing\n";
  for (std::size_t i = 0; i < map.key_frames.size(); ++i) {
    const KeyFrame& frame = map.key_frames[i];
    file << static_cast<double>(frame.stamp_ns) * 1e-9 << ',' << frame.pose[0] << ',' << frame.pose[1] << ','
         << frame.pose[2];
    file << std::scientific;
    for (Eigen::Index j = 0; j < 9; ++j) {
      file << ',' << map.pose_covariances[i](j / 3, j % 3);
    }
    file << std::fixed << ',' << frame.scan.points.size() << ',' << (frame.standing ? 1 : 0) << '\n';
  }
  close(file, path);
}

void write_grid(const OccupancyGrid& grid, const std::string& folder) {
  const std::string image_path = folder + "/map.pgm";
  std::ofstream image = open(image_path);
  image << "P5\n" << grid.size.x() << ' ' << grid.size.y() << "\n255\n";
  // Image rows start at the top, grid rows at the bottom.
  for (int row = grid.size.y() - 1; row >= 0; --row) {
    for (int column = 0; column < grid.size.x(); ++column) {
      image.put(shade_of(grid.cells[static_cast<std::size_t>(row) * grid.size.x() + column]));
    }
  }
  close(image, image_path);
  const std::string text_path = folder + "/map.yaml";
  std::ofstream text = open(text_path);
  text << "image: map.pgm\nresolution: " << grid.cell_m << "\norigin: [" << grid.origin.x() << ", " << grid.origin.y()
       << ", 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
  close(text, text_path);
}

}  // namespace mtr_surfel_map
