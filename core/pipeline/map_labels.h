#pragma once
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/compute/compute_context.h"
#include "core/discovery/region_set.h"
#include "core/editing/region_editor.h"
#include "core/fusion/rendered_view.h"
#include "core/labeling/estimated_labels.h"
#include "core/labeling/label_cloud.h"
#include "core/labeling/observation_recorder.h"
#include "core/labeling/region_merger.h"
#include "core/labeling/region_table.h"
#include "core/labeling/support_recorder.h"
#include "core/pipeline/editable_cloud.h"

namespace scantrove {

/// The labels of a map: the fragments of its voxels and their regions. One thread, the context's; may throw
/// cl::Error.
class MapLabels {
 public:
  struct Setup {
    float truncation_vox = 0;  ///< FusionParams
    LabelingParams::Rule rule = {};
  };
  /// `bricks`: the map's; it outlives this.
  [[nodiscard]] static Result<std::unique_ptr<MapLabels>> create(ComputeContext& compute, BrickMap& bricks,
                                                                 const Setup& setup);

  /// The labels of the voxels along a surface of the map, by pixel.
  [[nodiscard]] std::vector<FragmentId> project(const SurfaceMaps& surface) {
    return cloud_->project(surface, bricks_);
  }
  /// Adds the estimated surface to a view of the map with its fragments.
  void projectEstimated(RenderedView& view) const { estimated_.project(view); }
  /// Merges a frame's segments with the regions.
  [[nodiscard]] RegionMerger::Outcome merge(const SegmentMap& segments, const RenderedView& view,
                                            std::span<const Eigen::Vector3f> color_lab,
                                            std::span<const std::uint8_t> newly_appeared,
                                            const LabelingParams& params);
  /// Writes the merged fragments to the voxels along `surface`. Returns the affected bricks, valid until
  /// the next call.
  std::span<const Eigen::Vector3i> update(const SurfaceMaps& surface, const RegionMerger::Outcome& merged,
                                          const LabelingParams& params);
  /// Writes the merged fragments of the surface that `segments` estimate in a view, and removes what the
  /// view contradicts.
  void updateEstimated(const RenderedView& view, const SegmentMap& segments) {
    estimated_.update(view, segments.is_estimated, view.fragments);
  }
  [[nodiscard]] EstimatedLabels& estimated() { return estimated_; }
  /// Updates the evidence about where the frame's regions are seen.
  void recordDirections(const RenderedView& view) { directions_.record(view, table_); }

  /// Updates the evidence about which of the frame's regions are supports, or lie on one.
  void recordSupports(const SegmentMap& segments, const RenderedView& view) {
    supports_.record(segments, view, table_);
  }

  /// Log-odds that two regions of `table` are one thing; lowest without evidence.
  [[nodiscard]] float joiningOdds(RegionId a, RegionId b, const RegionTable& table,
                                  const LabelingParams& params) const;
  /// Frames neither join nor split a known region; all `regions` of one thing become one region.
  enum class Known { no, yes, one_object };
  void setKnown(const RegionSet& regions, Known known);
  void setRule(LabelingParams::Rule rule);

  [[nodiscard]] const RegionTable& table() const { return table_; }
  [[nodiscard]] RegionTable& table() { return table_; }
  [[nodiscard]] const RegionMerger& merger() const { return *merger_; }
  [[nodiscard]] RegionMerger& merger() { return *merger_; }
  [[nodiscard]] const RegionEditor& editor() const { return *editor_; }
  [[nodiscard]] RegionEditor& editor() { return *editor_; }
  [[nodiscard]] LabelCloud& cloud() { return *cloud_; }
  /// Number of voxels of each fragment, by fragment number.
  [[nodiscard]] const std::vector<cl_int>& voxelsOfFragments() const { return cloud_->voxelsOfFragments(); }
  /// Bricks whose labels operations changed since the last call.
  [[nodiscard]] std::vector<Eigen::Vector3i> takeEditedBricks() { return editable_.takeChanged(); }

 private:
  MapLabels(BrickMap& bricks, std::unique_ptr<LabelCloud> cloud, const Setup& setup);
  /// Deletes fragments without voxels; their numbers are used again.
  void forgetFragments();
  /// Voxels and estimated cells of each fragment.
  [[nodiscard]] std::vector<int> sizesOfFragments() const;

  BrickMap& bricks_;
  std::unique_ptr<LabelCloud> cloud_;
  EstimatedLabels estimated_;
  RegionTable table_;
  std::unique_ptr<RegionMerger> merger_;
  ObservationRecorder directions_;
  SupportRecorder supports_;
  EditableCloud editable_;
  std::optional<RegionEditor> editor_;
};

}  // namespace scantrove
