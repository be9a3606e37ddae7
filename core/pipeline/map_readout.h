#pragma once
#include <Eigen/Geometry>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/compute/compute_context.h"
#include "core/discovery/region_samples.h"
#include "core/fusion/rendered_view.h"
#include "core/labeling/label_cloud.h"
#include "core/meshing/mesh_extractor.h"
#include "core/pipeline/map_fusion.h"
#include "core/pipeline/map_labels.h"

namespace scantrove {

/// Read access to a map: views, the label cloud, samples of its regions, the mesh. Changes nothing. One
/// thread, the context's. Error: the device failed.
class MapReadout {
 public:
  /// All outlive this. `truncation_vox`: FusionParams.
  MapReadout(ComputeContext& compute, MapFusion& fusion, MapLabels& labels, float truncation_vox)
      : compute_(compute), fusion_(fusion), labels_(labels), truncation_vox_(truncation_vox) {}

  /// The map rendered from there, with its current regions.
  [[nodiscard]] Result<RenderedView> renderView(const Eigen::Isometry3d& T_world_camera, const Intrinsics& K);
  /// The same; `surface` takes it on the device. May throw cl::Error.
  [[nodiscard]] RenderedView render(const Eigen::Isometry3d& T_world_camera, const Intrinsics& K,
                                    SurfaceMaps& surface);

  /// Labelled voxels near the surface in some bricks, on the device or not.
  [[nodiscard]] Result<LabelCloud::Extract> extractCloud(std::span<const Eigen::Vector3i> bricks);
  /// Of the whole map, one page after the other.
  [[nodiscard]] std::vector<Eigen::Vector3i> allBricks() const;
  /// The same of the whole map, point by point, in an order that depends only on their positions.
  [[nodiscard]] Result<void> forEachCloudPoint(const std::function<void(const LabelPoint&)>& visit);

  /// All samples of regions in `table`, of the map's fragments.
  [[nodiscard]] Result<RegionSamples> sampleRegions(const RegionTable& table);
  struct RegionCount {
    int regions = 0;          ///< of at least kSmallFragmentVoxels voxels
    int small_fragments = 0;  ///< smaller ones
  };
  /// Regions of the whole map that have a surface: voxels of removed things may keep labels.
  [[nodiscard]] RegionCount regionCount();

  /// The surface of the whole map; see core/meshing/mesh_extractor.h. Nothing: `may_continue` returned
  /// false. Error: also out of memory.
  [[nodiscard]] Result<std::optional<SurfaceMesh>> extractMesh(const MeshProgress& may_continue = {});

 private:
  ComputeContext& compute_;
  MapFusion& fusion_;
  MapLabels& labels_;
  float truncation_vox_;
};

/// Regions of the fragments in the view.
void setRegions(RenderedView& view, const RegionTable& table);

}  // namespace scantrove
