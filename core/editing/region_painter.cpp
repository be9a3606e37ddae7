#include "core/editing/region_painter.h"

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>

#include "core/editing/surface_paths.h"
#include "core/editing/surface_split.h"

namespace scantrove {
namespace {

using Area = PaintedSurface::Area;

/// Fewer voxels are below the resolution of registration and map.
constexpr std::size_t kLeastVoxels = 12;
/// Covered part of a region from which on all of it is meant.
constexpr double kAll = 0.9;
/// Regions of which one that was painted out may be a part.
constexpr std::size_t kMaxNeighbors = 6;
/// Least mean cost of cutting a border for both sides to be one surface, and its least number of edges.
constexpr float kPlainBorder = 0.5F;
constexpr int kLeastEdges = 8;
/// Voxels around a piece that tell how its surroundings continue it.
constexpr int kAround_vox = 3;
/// Voxels of a piece from which its surroundings are searched.
constexpr std::size_t kPlaces = 200;

using Position = std::array<int, 3>;
Position positionOf(const Eigen::Vector3i& voxel) { return {voxel.x(), voxel.y(), voxel.z()}; }

/// Cells of a few voxels in which a piece lies, or beside which it does.
std::set<Position> cellsAround(const SurfaceGraph& graph, std::span<const std::uint32_t> piece) {
  std::set<Position> cells;
  for (const std::uint32_t place : piece) {
    const Eigen::Vector3i cell =
        (graph.voxels[place].voxel.cast<float>() / kAround_vox).array().floor().cast<int>();
    for (int i = 0; i < 27; ++i)
      cells.insert(positionOf(cell + Eigen::Vector3i(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1)));
  }
  return cells;
}

/// How plain the surface is across the borders between a piece and its surroundings.
struct BorderSum {
  float cost = 0;
  int edges = 0;
};

/// Error: a paint or an unpaint does not say which pixels of which region it concerns.
Result<void> checkComplete(const Operation& operation) {
  const bool has_pixels = operation.correction && (operation.kind == OperationKind::unpaint ||
                                                   !operation.correction->added.isEmpty() ||
                                                   !operation.correction->removed.isEmpty());
  if (operation.regions.size() == 1 && has_pixels) return {};
  return fail("Nothing is painted for region " + std::to_string(operation.regions.front().value) + ".",
              "Paint at least one pixel for one region.");
}

}  // namespace

Result<RegionId> RegionPainter::apply(const Operation& operation, const PaintedSurface* painted,
                                      OperationEffect& effect, RegionEvents& events) {
  SCANTROVE_TRY(checkComplete(operation));
  RegionId region = operation.regions.front();
  if (operation.kind == OperationKind::paint) {
    const bool makes_region = operation.correction->makes_region;
    if (makes_region && painted == nullptr)
      return fail("A new region cannot be in one image alone.", "Paint it in all images.");
    if (makes_region) SCANTROVE_TRY(moveInto(region, create(*painted, effect, events)));
    if (painted != nullptr) paint(region, *painted, effect, events);
    effect.moves = moves();
  }
  effect.anchor = regions_.largestOf(regions_.table().fragmentsOf(region));
  return region;
}

void RegionPainter::paint(RegionId region, const PaintedSurface& painted, OperationEffect& effect,
                          RegionEvents& events) {
  effect_ = &effect;
  events_ = &events;
  remember(region);
  remove(region, painted);
  for (const auto& [from, places] : painted.added_world) {
    if (from && from != region && !regions_.table().fragmentsOf(from).empty())
      add(region, from, places, painted);
  }
}

std::vector<RegionMove> RegionPainter::moves() const {
  std::vector<RegionMove> moves;
  for (const auto& [fragment, before] : before_) {
    const RegionId after = regions_.table().regionOf(fragment);
    if (after != before) moves.push_back({fragment, before, after});
  }
  return moves;
}

Eigen::Vector3f RegionPainter::centerOf(const SurfaceVoxel& voxel) const {
  return (voxel.voxel.cast<float>() + Eigen::Vector3f::Constant(0.5F)) * regions_.map().voxelSize();
}

void RegionPainter::remember(RegionId region) {
  for (const FragmentId fragment : regions_.table().fragmentsOf(region))
    before_.try_emplace(fragment, region);
}

RegionPainter::Seeds RegionPainter::seedsOf(const SurfaceGraph& graph, const PaintedSurface& painted,
                                            Area going) const {
  Seeds seeds;
  for (std::uint32_t voxel = 0; voxel < graph.voxels.size(); ++voxel) {
    const PaintedSurface::Sight sight = painted.sight(centerOf(graph.voxels[voxel]));
    if (sight.area == Area::unclear) continue;
    if (sight.area == going) {
      if (sight.is_visible) {
        seeds.going.push_back(voxel);
      } else {
        ++seeds.hidden_behind;
      }
    } else {
      (sight.is_visible ? seeds.staying : seeds.away).push_back(voxel);
    }
  }
  return seeds;
}

RegionPainter::Extent RegionPainter::extentOf(const Seeds& seeds) {
  if (seeds.going.size() < kLeastVoxels) return Extent::none;
  const std::size_t covered = seeds.going.size() + seeds.hidden_behind;
  const std::size_t shown = covered + seeds.staying.size();
  const bool is_all = static_cast<double>(covered) >= kAll * static_cast<double>(shown);
  // What the image does not show may be anything.
  return is_all && covered >= seeds.away.size() ? Extent::all : Extent::part;
}

EditableRegions::Division RegionPainter::divide(RegionId region, const SurfaceGraph& graph,
                                                std::span<const std::uint32_t> part, std::size_t parts) {
  EditableRegions::Division division = regions_.divideVoxels(region, graph, part, parts);
  // An undo returns a new fragment to where the one that it was cut from came from.
  for (const auto& [fragment, from] : division.divided) before_[fragment] = before_.at(from);
  return division;
}

void RegionPainter::move(RegionId from, RegionId to, const Fragments& fragments) {
  std::vector<RegionMove> moves;
  for (const FragmentId fragment : fragments) moves.push_back({fragment, from, to});
  regions_.table().move(moves, *events_);
  changed_.insert({from, to});
}

RegionPainter::Shown RegionPainter::shownOf(RegionId region, std::span<const Eigen::Vector3f> places,
                                            const PaintedSurface& painted) const {
  Shown shown;
  shown.graph = SurfaceGraph::of(regions_.map().surfaceOf(regions_.table().fragmentsOf(region), places));
  shown.seeds = seedsOf(shown.graph, painted, Area::added);
  shown.extent = extentOf(shown.seeds);
  const bool is_alone = shown.seeds.staying.empty() && shown.seeds.away.empty();
  if (shown.extent == Extent::part && is_alone) shown.extent = Extent::none;
  return shown;
}

EditableRegions::Division RegionPainter::cutOff(RegionId region, const Shown& shown) {
  const Seeds& seeds = shown.seeds;
  const auto side =
      splitSurface(shown.graph, seeds.staying.empty() ? seeds.away : seeds.staying, seeds.going);
  return divide(region, shown.graph, std::vector<std::uint32_t>(side.begin(), side.end()), 2);
}

void RegionPainter::add(RegionId to, RegionId from, std::span<const Eigen::Vector3f> places,
                        const PaintedSurface& painted) {
  const Shown shown = shownOf(from, places, painted);
  if (shown.extent == Extent::none) return;
  remember(from);
  if (shown.extent == Extent::all) return join(to, from);
  const auto division = cutOff(from, shown);
  const auto own = regions_.table().fragmentsOf(to);
  const FragmentId largest = regions_.largestOf(own);
  move(from, to, division.parts.back());
  regions_.constrain(largest, regions_.largestOf(division.parts.back()), LinkConstraint::must_link, *effect_);
  regions_.keepApart(division.parts.back(), division.parts.front(), *effect_);
}

Result<RegionId> RegionPainter::create(const PaintedSurface& painted, OperationEffect& effect,
                                       RegionEvents& events) {
  effect_ = &effect;
  events_ = &events;
  RegionId source, complete;
  Shown most;
  for (const auto& [from, places] : painted.added_world) {
    if (!from || regions_.table().fragmentsOf(from).empty()) continue;
    Shown shown = shownOf(from, places, painted);
    if (shown.extent == Extent::all) complete = from;
    if (shown.extent != Extent::part || shown.seeds.going.size() <= most.seeds.going.size()) continue;
    source = from;
    most = std::move(shown);
  }
  if (!source) {
    return complete ? fail("The painted area is all of region " + std::to_string(complete.value) + ".",
                           "Name that region, or paint a part of it.")
                    : fail("The map has too little surface behind the painted pixels for a region.",
                           "Paint a larger area of something that was scanned.");
  }
  remember(source);
  const auto division = cutOff(source, most);
  const RegionId created = regions_.table().separate(division.parts.back(), events);
  effect.created.push_back(created);
  changed_.insert({source, created});
  regions_.keepApart(division.parts.back(), division.parts.front(), effect);
  return created;
}

void RegionPainter::join(RegionId to, RegionId from) {
  const FragmentId a = regions_.largestOf(regions_.table().fragmentsOf(to));
  const FragmentId b = regions_.largestOf(regions_.table().fragmentsOf(from));
  regions_.table().join(to, from);
  events_->joined.emplace_back(to, from);
  regions_.constrain(a, b, LinkConstraint::must_link, *effect_);
  changed_.insert({from, to});
}

void RegionPainter::remove(RegionId region, const PaintedSurface& painted) {
  if (painted.removed_world.empty()) return;
  const SurfaceGraph graph =
      SurfaceGraph::of(regions_.map().surfaceOf(regions_.table().fragmentsOf(region), painted.removed_world));
  const Seeds seeds = seedsOf(graph, painted, Area::removed);
  const std::vector<std::uint32_t>& staying = seeds.staying.empty() ? seeds.away : seeds.staying;
  // A region is never painted out completely: then something else is meant by it elsewhere.
  if (seeds.going.size() < kLeastVoxels || staying.empty()) return;
  const auto side = splitSurface(graph, staying, seeds.going);
  const SurfacePieces pieces = piecesOf(graph, side);
  std::vector<std::vector<std::uint32_t>> voxels;
  std::vector<std::uint32_t> numbers(pieces.sizes.size(), 0);
  for (std::size_t piece = 0; piece < pieces.sizes.size(); ++piece) {
    if (pieces.sizes[piece] < kLeastVoxels) continue;
    voxels.emplace_back();
    numbers[piece] = static_cast<std::uint32_t>(voxels.size());
  }
  if (voxels.empty()) return;
  std::vector<std::uint32_t> part(side.size(), 0);
  for (std::uint32_t voxel = 0; voxel < part.size(); ++voxel) {
    if (pieces.piece[voxel] == SurfacePieces::kNone) continue;
    part[voxel] = numbers[pieces.piece[voxel]];
    if (part[voxel] > 0) voxels[part[voxel] - 1].push_back(voxel);
  }
  std::vector<RegionId> continued;
  for (const auto& piece : voxels) continued.push_back(continuedBy(graph, piece, painted.around));
  const auto division = divide(region, graph, part, voxels.size() + 1);
  for (std::size_t i = 0; i < voxels.size(); ++i)
    give(region, division.parts[i + 1], division.parts.front(), continued[i]);
}

void RegionPainter::give(RegionId region, const Fragments& piece, const Fragments& rest, RegionId continued) {
  if (continued) {
    const FragmentId largest = regions_.largestOf(regions_.table().fragmentsOf(continued));
    move(region, continued, piece);
    regions_.constrain(largest, regions_.largestOf(piece), LinkConstraint::must_link, *effect_);
  } else {
    const RegionId created = regions_.table().separate(piece, *events_);
    effect_->created.push_back(created);
    changed_.insert({region, created});
  }
  regions_.keepApart(piece, rest, *effect_);
}

RegionId RegionPainter::continuedBy(const SurfaceGraph& graph, std::span<const std::uint32_t> piece,
                                    std::span<const RegionId> around) const {
  const std::set<Position> near = cellsAround(graph, piece);
  std::vector<Eigen::Vector3f> places;
  for (std::size_t i = 0; i < piece.size(); i += 1 + piece.size() / kPlaces)
    places.push_back(centerOf(graph.voxels[piece[i]]));
  std::vector<SurfaceVoxel> voxels;
  for (const std::uint32_t voxel : piece) voxels.push_back(graph.voxels[voxel]);
  std::vector<RegionId> owners(voxels.size());
  for (std::size_t i = 0; i < std::min(around.size(), kMaxNeighbors); ++i) {
    const auto fragments = regions_.table().fragmentsOf(around[i]);
    if (fragments.empty()) continue;
    for (const SurfaceVoxel& voxel : regions_.map().surfaceOf(fragments, places)) {
      const Eigen::Vector3i cell = (voxel.voxel.cast<float>() / kAround_vox).array().floor().cast<int>();
      if (!near.contains(positionOf(cell))) continue;
      voxels.push_back(voxel);
      owners.push_back(around[i]);
    }
  }
  const SurfaceGraph both = SurfaceGraph::of(std::move(voxels));
  std::map<RegionId, BorderSum> borders;
  for (const SurfaceGraph::Edge& edge : both.edges) {
    const RegionId a = owners[edge.a], b = owners[edge.b];
    if (bool(a) == bool(b)) continue;
    BorderSum& border = borders[a ? a : b];
    border.cost += cutCost(edge);
    ++border.edges;
  }
  RegionId best;
  float best_cost = 0;
  for (const auto& [region, border] : borders) {
    const bool is_plain =
        border.edges >= kLeastEdges && border.cost >= kPlainBorder * static_cast<float>(border.edges);
    if (!is_plain || border.cost <= best_cost) continue;
    best = region;
    best_cost = border.cost;
  }
  return best;
}

}  // namespace scantrove
