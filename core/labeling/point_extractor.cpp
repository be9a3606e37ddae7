#include "core/labeling/point_extractor.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "core/labeling/fit_buffer.h"
#include "embedded/labeling_kernels.h"

namespace scantrove {

Result<PointExtractor> PointExtractor::create(ComputeContext& compute) {
  PointExtractor extractor(compute);
  SCANTROVE_TRY(moveInto(extractor.extract_points_, compute.kernel(kernels::labeling, "extract_points")));
  return extractor;
}

PointExtractor::Extract PointExtractor::extract(std::span<const Eigen::Vector3i> bricks, BrickMap& map,
                                                float truncation_vox) {
  // First the bricks on the device; then, page by page, those in the file, through separate pools.
  Extract found;
  std::vector<cl_int4> listed;
  std::vector<std::size_t> order;  // index in `bricks` of each brick of `found`
  std::map<int, std::vector<std::size_t>> in_file;
  const auto list = [&](std::size_t i, int slot) {
    listed.push_back({{bricks[i].x(), bricks[i].y(), bricks[i].z(), slot}});
    order.push_back(i);
  };
  for (std::size_t i = 0; i < bricks.size(); ++i) {
    if (const int slot = map.device().slotOf(bricks[i]); slot != BRICK_NONE) {
      list(i, slot);
    } else if (const int page = map.pages().pageWith(bricks[i]); page != BRICK_NONE) {
      in_file[page].push_back(i);
    }
  }
  extractListed(listed, map.pools().distances(), map.pools().labels(), map.pools().colors(), map.voxelSize(),
                truncation_vox, found);
  for (const auto& [page, asked] : in_file) {
    const std::vector<Eigen::Vector3i> in_page = map.bricksOfPage(page);
    const std::optional<StoredPage> stored = map.readStored(page);
    if (!stored) continue;
    listed.clear();
    for (const std::size_t i : asked) {
      const auto place = std::ranges::find(in_page, bricks[i]);
      if (place != in_page.end()) list(i, static_cast<int>(place - in_page.begin()));
    }
    const BrickContents& held = stored->contents;
    fitBuffer(compute_->context(), stored_distances_, held.voxels());
    fitBuffer(compute_->context(), stored_labels_, held.voxels());
    fitBuffer(compute_->context(), stored_colors_, held.voxels());
    stored_distances_.write(compute_->queue(), held.distances);
    stored_labels_.write(compute_->queue(), held.labels);
    stored_colors_.write(compute_->queue(), held.colors);
    extractListed(listed, stored_distances_, stored_labels_, stored_colors_, map.voxelSize(), truncation_vox,
                  found);
  }
  found.first.push_back(static_cast<std::uint32_t>(found.points.size()));
  if (in_file.empty() && order.size() == bricks.size()) return found;

  std::vector<std::size_t> place(bricks.size(), order.size());
  for (std::size_t k = 0; k < order.size(); ++k) place[order[k]] = k;
  Extract result;
  result.points.reserve(found.points.size());
  for (const std::size_t k : place) {
    result.first.push_back(static_cast<std::uint32_t>(result.points.size()));
    if (k == order.size()) continue;  // missing brick
    result.points.insert(result.points.end(), found.points.begin() + found.first[k],
                         found.points.begin() + found.first[k + 1]);
  }
  result.first.push_back(static_cast<std::uint32_t>(result.points.size()));
  return result;
}

void PointExtractor::extractListed(std::span<const cl_int4> listed, const Buffer<cl_short>& distances,
                                   const Buffer<cl_uint>& labels, const Buffer<cl_uint>& colors,
                                   float voxel_size_m, float truncation_vox, Extract& extract) {
  if (listed.empty()) return;
  fitBuffer(compute_->context(), listed_, listed.size());
  fitBuffer(compute_->context(), offsets_, listed.size());
  fitBuffer(compute_->context(), points_, 1);
  listed_.write(compute_->queue(), listed);
  const auto run = [&](int write) {
    const auto band = static_cast<cl_int>(DISTANCE_ONE / truncation_vox);
    extract_points_.launch(cl::NDRange(listed.size()), cl::NDRange(8), listed_,
                           static_cast<cl_int>(listed.size()), distances, labels, colors, voxel_size_m, band,
                           cl_int{write}, offsets_, points_);
  };
  run(0);
  std::vector<cl_int> offsets(listed.size());
  offsets_.read(compute_->queue(), std::span<cl_int>(offsets));
  const auto before = static_cast<std::uint32_t>(extract.points.size());
  cl_int total = 0;
  for (cl_int& entry : offsets) {
    extract.first.push_back(before + static_cast<std::uint32_t>(total));
    total += std::exchange(entry, total);
  }
  if (total == 0) return;
  fitBuffer(compute_->context(), points_, static_cast<std::size_t>(total));
  offsets_.write(compute_->queue(), offsets);
  run(1);
  extract.points.resize(before + static_cast<std::size_t>(total));
  points_.read(compute_->queue(), std::span<LabelPoint>(extract.points).subspan(before));
}

}  // namespace scantrove
