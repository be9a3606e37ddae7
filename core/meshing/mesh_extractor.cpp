#include "core/meshing/mesh_extractor.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/fusion/kernels/color_voxel.h"
#include "core/labeling/kernels/label_voxel.h"
#include "core/meshing/cube_cases.h"
#include "core/meshing/page_reader.h"
#include "core/meshing/voxel_block.h"

namespace scantrove {
namespace {

using Vertex = SurfaceMesh::Vertex;

constexpr std::uint32_t kNoVertex = std::numeric_limits<std::uint32_t>::max();
/// Minimum distance of vertices from the ends of their grid edges, in voxels, so that triangles around such
/// an end do not degenerate.
constexpr float kFromEnd_vox = 1.0F / 64;
constexpr int kEdgesSide = VoxelBlock::kPageVoxels + 1;
constexpr std::size_t kBlockEdges = std::size_t{3} * kEdgesSide * kEdgesSide * kEdgesSide;

/// An edge of the grid of voxel centres: from `voxel` one step along `axis`.
struct GridEdge {
  Eigen::Vector3i voxel;
  int axis;
  bool operator==(const GridEdge& other) const { return axis == other.axis && voxel == other.voxel; }
};
struct GridEdgeHash {
  std::size_t operator()(const GridEdge& edge) const {
    return std::size_t{3} * brick_hash(edge.voxel.x(), edge.voxel.y(), edge.voxel.z()) +
           static_cast<std::size_t>(edge.axis);
  }
};

/// Builds one mesh page by page.
class PageMesher {
 public:
  PageMesher(float voxel_size_m, SurfaceMesh& mesh)
      : voxel_size_m_(voxel_size_m), mesh_(mesh), vertex_of_edge_(kBlockEdges) {}

  void add(PageReader& reader, int page) {
    if (reader.page(page).bricks.none()) return;
    block_.load(reader, page);
    std::ranges::fill(vertex_of_edge_, kNoVertex);
    for (std::size_t brick = 0; brick < PAGE_BRICKS; ++brick) {
      if (block_.bricks()[brick]) addBrick(static_cast<int>(brick));
    }
  }

 private:
  void addBrick(int brick);
  void addCell(const Eigen::Vector3i& first, std::size_t at);
  /// Index of the vertex on an edge that starts at a voxel, relative to the page's first.
  std::uint32_t vertexOn(const Eigen::Vector3i& start, int axis);
  [[nodiscard]] Vertex makeVertex(const Eigen::Vector3i& start, int axis) const;
  [[nodiscard]] Eigen::Vector3f gradientAt(std::size_t at) const;
  /// Index of the voxel nearest to a point (voxels from the page's first) among those around `centre` with a
  /// non-zero `value`; that of `centre` if there is none.
  template <class Value>
  [[nodiscard]] std::size_t nearestWith(const Value& value, const Eigen::Vector3i& center,
                                        const Eigen::Vector3f& point) const;

  float voxel_size_m_;
  SurfaceMesh& mesh_;
  VoxelBlock block_;
  std::vector<std::uint32_t> vertex_of_edge_;  ///< of the page
  /// Vertices of edges shared by cells of several pages.
  std::unordered_map<GridEdge, std::uint32_t, GridEdgeHash> shared_;
};

void PageMesher::addBrick(int brick) {
  const Eigen::Vector3i first = BRICK_SIDE * Eigen::Vector3i(brick % PAGE_SIDE, brick / PAGE_SIDE % PAGE_SIDE,
                                                             brick / (PAGE_SIDE * PAGE_SIDE));
  for (int z = 0; z < BRICK_SIDE; ++z) {
    for (int y = 0; y < BRICK_SIDE; ++y) {
      const Eigen::Vector3i row = first + Eigen::Vector3i(0, y, z);
      const std::size_t at = VoxelBlock::at(row);
      for (int x = 0; x < BRICK_SIDE; ++x)
        addCell(row + Eigen::Vector3i(x, 0, 0), at + static_cast<std::size_t>(x));
    }
  }
}

void PageMesher::addCell(const Eigen::Vector3i& first, std::size_t at) {
  unsigned outside = 0;
  for (unsigned corner = 0; corner < kCubeCorners.size(); ++corner) {
    const auto& [x, y, z] = kCubeCorners[corner];
    const std::ptrdiff_t step =
        x * VoxelBlock::kSteps[0] + y * VoxelBlock::kSteps[1] + z * VoxelBlock::kSteps[2];
    const int distance = block_.distance(at + static_cast<std::size_t>(step));
    if (distance == DISTANCE_UNSEEN) return;
    if (distance > 0) outside |= 1U << corner;
  }
  const std::span<const int> edges = trianglesOfCube(outside);
  for (std::size_t i = 0; i < edges.size(); i += 3) {
    std::array<std::uint32_t, 3> face{};
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const CubeEdge& edge = kCubeEdges[static_cast<std::size_t>(edges[i + corner])];
      face[corner] = vertexOn(first + Eigen::Vector3i(edge.start.data()), edge.axis);
    }
    mesh_.faces.push_back(face);
  }
}

std::uint32_t PageMesher::vertexOn(const Eigen::Vector3i& start, int axis) {
  const Eigen::Matrix<std::size_t, 3, 1> p = start.cast<std::size_t>();
  const std::size_t edge =
      p.x() + kEdgesSide * (p.y() + kEdgesSide * (p.z() + kEdgesSide * static_cast<std::size_t>(axis)));
  std::uint32_t& vertex = vertex_of_edge_[edge];
  if (vertex != kNoVertex) return vertex;
  bool is_shared = false;
  for (int other = 0; other < 3; ++other) {
    is_shared |= other != axis && start[other] % VoxelBlock::kPageVoxels == 0;
  }
  vertex = static_cast<std::uint32_t>(mesh_.vertices.size());
  if (is_shared) {
    vertex = shared_.try_emplace({block_.firstVoxel() + start, axis}, vertex).first->second;
  }
  if (vertex == mesh_.vertices.size()) mesh_.vertices.push_back(makeVertex(start, axis));
  return vertex;
}

Vertex PageMesher::makeVertex(const Eigen::Vector3i& start, int axis) const {
  const std::size_t from = VoxelBlock::at(start);
  const std::size_t to = from + static_cast<std::size_t>(VoxelBlock::kSteps[static_cast<std::size_t>(axis)]);
  const auto at_from = static_cast<float>(block_.distance(from));
  const auto at_to = static_cast<float>(block_.distance(to));
  const float share = std::clamp(at_from / (at_from - at_to), kFromEnd_vox, 1 - kFromEnd_vox);
  const Eigen::Vector3i along = Eigen::Vector3i::Unit(axis);

  Vertex vertex;
  const Eigen::Vector3f point = start.cast<float>() + share * along.cast<float>();
  vertex.position = (((block_.firstVoxel().cast<double>() + point.cast<double>()).array() + 0.5) *
                     static_cast<double>(voxel_size_m_))
                        .cast<float>();
  const Eigen::Vector3f gradient = (1 - share) * gradientAt(from) + share * gradientAt(to);
  const float length = gradient.norm();
  vertex.normal = length > 0 ? Eigen::Vector3f(gradient / length)
                             : Eigen::Vector3f(along.cast<float>() * (at_to > at_from ? 1.0F : -1.0F));

  const bool starts_nearer = share <= 0.5F;
  const std::size_t nearer = starts_nearer ? from : to;
  const std::size_t farther = starts_nearer ? to : from;
  const Eigen::Vector3i center = starts_nearer ? start : Eigen::Vector3i(start + along);
  if (block_.hasLabels()) {
    const auto labelAt = [&](std::size_t i) { return LABEL_OF(block_.label(i)); };
    std::size_t labeled = labelAt(nearer) != 0 ? nearer : farther;
    if (labelAt(labeled) == 0) labeled = nearestWith(labelAt, center, point);
    vertex.fragment = FragmentId{labelAt(labeled)};
  }
  if (block_.hasColors()) {
    const auto colorAt = [&](std::size_t i) { return block_.color(i); };
    std::uint32_t a = colorAt(from);
    std::uint32_t b = colorAt(to);
    if (a == 0 && b == 0) a = colorAt(nearestWith(colorAt, center, point));
    if (a == 0) a = b;
    if (b == 0) b = a;
    const auto between = [&](std::uint32_t low, std::uint32_t high) {
      return static_cast<std::uint8_t>(
          std::lround((1 - share) * static_cast<float>(low) + share * static_cast<float>(high)));
    };
    vertex.has_color = a != 0;
    vertex.color = {between(COLOR_RED(a), COLOR_RED(b)), between(COLOR_GREEN(a), COLOR_GREEN(b)),
                    between(COLOR_BLUE(a), COLOR_BLUE(b))};
  }
  return vertex;
}

Eigen::Vector3f PageMesher::gradientAt(std::size_t at) const {
  Eigen::Vector3f gradient;
  for (int axis = 0; axis < 3; ++axis) {
    const auto step = static_cast<std::size_t>(VoxelBlock::kSteps[static_cast<std::size_t>(axis)]);
    const bool is_low = block_.distance(at - step) != DISTANCE_UNSEEN;
    const bool is_high = block_.distance(at + step) != DISTANCE_UNSEEN;
    const int low = block_.distance(is_low ? at - step : at);
    const int high = block_.distance(is_high ? at + step : at);
    gradient[axis] = static_cast<float>(high - low) / (is_low && is_high ? 2.0F : 1.0F);
  }
  return gradient;
}

template <class Value>
std::size_t PageMesher::nearestWith(const Value& value, const Eigen::Vector3i& center,
                                    const Eigen::Vector3f& point) const {
  constexpr int kReach = VoxelBlock::kMargin;
  std::size_t nearest = VoxelBlock::at(center);
  float least = std::numeric_limits<float>::max();
  for (int z = -kReach; z <= kReach; ++z) {
    for (int y = -kReach; y <= kReach; ++y) {
      for (int x = -kReach; x <= kReach; ++x) {
        const Eigen::Vector3i voxel = center + Eigen::Vector3i(x, y, z);
        const std::size_t at = VoxelBlock::at(voxel);
        if (value(at) == 0) continue;
        const float distance = (voxel.cast<float>() - point).squaredNorm();
        if (distance >= least) continue;
        least = distance;
        nearest = at;
      }
    }
  }
  return nearest;
}

}  // namespace

std::optional<SurfaceMesh> extractMesh(BrickMap& map, const MeshProgress& may_continue) {
  SurfaceMesh mesh;
  PageReader reader(map);
  PageMesher mesher(map.voxelSize(), mesh);
  const std::vector<int> pages = map.pagesByPosition();
  for (std::size_t i = 0; i < pages.size(); ++i) {
    if (may_continue && !may_continue(static_cast<double>(i) / static_cast<double>(pages.size())))
      return std::nullopt;
    mesher.add(reader, pages[i]);
  }
  if (may_continue && !may_continue(1)) return std::nullopt;
  return mesh;
}

}  // namespace scantrove
