#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/base/ids.h"
#include "core/capture/color_camera.h"
#include "core/capture/intrinsics.h"
#include "core/editing/operation_log.h"
#include "core/geometry/view_coverage.h"
#include "core/labeling/border_evidence.h"
#include "core/tracking/pose_estimate.h"

namespace scantrove {

/// What is kept of a scan: plain values, as they go to disk and come back.
struct SavedFrame {
  int number = 0;        ///< 0, 1, ... in the order in which the scan saw them
  int source_index = 0;  ///< RgbdFrame::index; SavedRecording says which one its recording has
  double time_s = 0;     ///< likewise
  TrackingState state = TrackingState::lost;
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();

  /// The pose may be trusted.
  [[nodiscard]] bool isUsable() const {
    return state == TrackingState::tracking || state == TrackingState::relocalized;
  }
};

/// A recording, or a part of one, that became part of the scan.
struct SavedRecording {
  int first_frame = 0;  ///< SavedFrame::number
  std::string source;   ///< as it was given
  /// What its own frame numbers and times lack to those of the scan.
  int index_shift = 0;
  double time_shift_s = 0;
};

struct SavedKeyFrame {
  int frame = 0;                                 ///< SavedFrame::number
  std::filesystem::path color_file, depth_file;  ///< in the session's folder; no colour: empty
  float meters_per_unit = 0.001F;
  int color_width = 0, color_height = 0;
  std::optional<ColorCamera> color_camera;  ///< RgbdFrame::color_camera
  /// CRC-32 of the files. None: of a session of an earlier version.
  std::optional<std::uint32_t> color_checksum = {}, depth_checksum = {};
};

struct SavedFragment {
  FragmentId fragment;
  RegionId region;  ///< none: the fragment is no more
  int voxels = 0;
  ViewCoverage seen_from = {};
};

struct SavedRegion {
  RegionId region;
  ObjectId object;  ///< of the catalogue
  RegionNote note;
  bool operator==(const SavedRegion&) const = default;
};

struct SavedBorder {
  FragmentId a, b;                         ///< a < b
  std::optional<BorderEvidence> evidence;  ///< none: there is none any more
};

/// A page of bricks, as BrickMap gives and takes it.
struct SavedPage {
  Eigen::Vector3i position = Eigen::Vector3i::Zero();  ///< BrickPages::Page::position
  std::vector<std::uint32_t> words;                    ///< StoredPage::toWords
};

/// What is known of the camera when a scan stops, as toWords() of CameraMemory has it.
struct SavedCamera {
  int frame = 0;  ///< SavedFrame::number of the last one
  std::vector<std::uint32_t> words;
};

/// What holds for the whole scan, by name.
using SessionMetadata = std::map<std::string, std::string>;

/// All but the pages of the map that changed since the delta before: one moment of the scan, between two
/// frames.
struct SavedDelta {
  SessionMetadata metadata;
  std::vector<SavedFrame> frames;  ///< new ones, or understood late
  std::vector<SavedRecording> recordings;
  std::vector<SavedKeyFrame> key_frames;
  std::vector<SavedFragment> fragments;
  std::vector<SavedRegion> regions;  ///< of which something is to be said, or was
  std::vector<SavedBorder> borders;
  std::vector<OperationLog::Entry> operations;
  std::optional<SavedCamera> camera;
};

/// A scan as it was read back, but for its map, which is read page by page, and what is known of its camera.
struct SavedScan {
  SessionMetadata metadata;
  std::vector<SavedFrame> frames;          ///< by number
  std::vector<SavedRecording> recordings;  ///< in order; of an older session, those that are known
  std::vector<SavedKeyFrame> key_frames;
  std::vector<SavedFragment> fragments;
  std::vector<SavedRegion> regions;
  std::vector<SavedBorder> borders;
  std::vector<OperationLog::Entry> operations;
  std::vector<Eigen::Vector3i> pages;  ///< positions
};

}  // namespace scantrove
