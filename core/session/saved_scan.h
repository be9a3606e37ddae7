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
#include "core/labeling/estimated_labels.h"
#include "core/labeling/support_pixels.h"
#include "core/tracking/pose_estimate.h"

namespace scantrove {

/// Stored data of a scan: plain values, as written and read.
struct SavedFrame {
  int number = 0;        ///< 0, 1, ... in the order of the scan
  int source_index = 0;  ///< RgbdFrame::index in its recording (see SavedRecording)
  double time_s = 0;     ///< likewise
  TrackingState state = TrackingState::lost;
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  std::optional<Intrinsics> intrinsics = {};  ///< RgbdFrame::intrinsics; none: SessionSetup::K

  /// Whether the pose is reliable.
  [[nodiscard]] bool isUsable() const {
    return state == TrackingState::tracking || state == TrackingState::relocalized;
  }
};

/// A recording, or a part of one, that belongs to the scan.
struct SavedRecording {
  int first_frame = 0;  ///< SavedFrame::number
  std::string source;   ///< as given
  /// Offsets from its frame numbers and times to those of the scan.
  int index_shift = 0;
  double time_shift_s = 0;
};

struct SavedKeyFrame {
  int frame = 0;  ///< SavedFrame::number
  /// In the session's folder; no colour: empty. The depth image has no readings of low confidence.
  std::filesystem::path color_file, depth_file;
  float meters_per_unit = 0.001F;
  int color_width = 0, color_height = 0;
  std::optional<ColorCamera> color_camera;  ///< RgbdFrame::color_camera
  /// CRC-32 of the files. None: session of an earlier version.
  std::optional<std::uint32_t> color_checksum = {}, depth_checksum = {};
};

struct SavedFragment {
  FragmentId fragment;
  RegionId region;  ///< none: the fragment no longer exists
  int voxels = 0;
  ViewCoverage seen_from = {};
  SupportPixels support_pixels = {};
};

struct SavedRegion {
  RegionId region;
  ObjectId object;  ///< in the catalogue
  RegionNote note;
  bool operator==(const SavedRegion&) const = default;
};

struct SavedBorder {
  FragmentId a, b;                         ///< a < b
  std::optional<BorderEvidence> evidence;  ///< none: deleted
};

/// Labels at estimated places, as EstimatedLabels provides and accepts them.
using SavedEstimates = EstimatedLabels::StoredBrick;

/// How likely regions are one complete object, by the last refinement: log-odds. Regions that no key frame
/// shows well are missing.
using SavedObjectness = std::map<RegionId, float>;

/// A page of bricks, as BrickMap provides and accepts it.
struct SavedPage {
  Eigen::Vector3i position = Eigen::Vector3i::Zero();  ///< BrickPages::Page::position
  std::vector<std::uint32_t> words;                    ///< StoredPage::toWords
};

/// The camera state when a scan stops: toWords() of CameraMemory.
struct SavedCamera {
  int frame = 0;  ///< SavedFrame::number of the last one
  std::vector<std::uint32_t> words;
};

/// Metadata of the whole scan, by name.
using SessionMetadata = std::map<std::string, std::string>;

/// Changes since the last delta, at one moment between two frames; pages of the map are stored separately.
struct SavedDelta {
  SessionMetadata metadata;
  std::vector<SavedFrame> frames;  ///< new ones, or integrated late
  std::vector<SavedRecording> recordings;
  std::vector<SavedKeyFrame> key_frames;
  std::vector<SavedFragment> fragments;
  std::vector<SavedRegion> regions;  ///< with a label now or before
  std::vector<SavedBorder> borders;
  std::vector<SavedEstimates> estimates;
  std::optional<SavedObjectness> objectness;  ///< of all regions; none: no change
  std::vector<OperationLog::Entry> operations;
  std::optional<SavedCamera> camera;
};

/// A scan that was read, without its map, which is read page by page, and without its camera state.
struct SavedScan {
  SessionMetadata metadata;
  std::vector<SavedFrame> frames;          ///< by number
  std::vector<SavedRecording> recordings;  ///< in order; of an older session, the known ones
  std::vector<SavedKeyFrame> key_frames;
  std::vector<SavedFragment> fragments;
  std::vector<SavedRegion> regions;
  std::vector<SavedBorder> borders;
  std::vector<SavedEstimates> estimates;
  SavedObjectness objectness;
  std::vector<OperationLog::Entry> operations;
  std::vector<Eigen::Vector3i> pages;  ///< positions
};

}  // namespace scantrove
