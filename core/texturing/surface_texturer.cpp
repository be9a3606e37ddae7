#include "core/texturing/surface_texturer.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "core/base/check.h"
#include "core/texturing/face_views.h"
#include "core/texturing/seam_leveling.h"
#include "core/texturing/view_ratings.h"

namespace scantrove {
namespace {

/// Texels of all textures but the largest: 100 MB.
constexpr double kMaxSmallTextures = 32e6;
/// Where charts do not fit, those with fewer faces get the colours of vertices; then fewer than this factor
/// more, and so on.
constexpr std::size_t kFewerCharts = 4;

/// Chooses the views, and counts the steps.
class SceneViews {
 public:
  SceneViews(const TexturedScene& scene, const TexturingProgress& progress)
      : scene_(scene), progress_(progress) {}

  Result<void> step(const std::string& what) { return progress_ ? progress_(done_++, what) : Result<void>(); }

  /// The view of each face. Error: no image can be read; cancelled.
  Result<std::vector<ViewNumber>> choose(const FaceNeighbors& neighbors, SurfaceTextures& result) {
    ViewRatings ratings(scene_.surface);
    std::optional<Error> first_failure;
    for (std::size_t view = 0; view < scene_.views.size(); ++view) {
      SCANTROVE_TRY(step("view " + std::to_string(view + 1)));
      const auto image = scene_.image(view);
      if (image) {
        ratings.add(static_cast<ViewNumber>(view), scene_.views[view], *image);
        continue;
      }
      result.unused_views.push_back(view);
      if (!first_failure) first_failure = image.error();
    }
    if (result.unused_views.size() == scene_.views.size())
      return fail(first_failure.value_or(Error{"No image shows the surface.", ""}));
    SCANTROVE_TRY(step("choosing views"));
    std::vector<ViewNumber> views = chooseFaceViews(ratings, neighbors);
    result.faces_without_view = static_cast<std::size_t>(std::ranges::count(views, kNoView));
    return views;
  }

 private:
  const TexturedScene& scene_;
  const TexturingProgress& progress_;
  int done_ = 0;
};

/// The texture of a part, not painted yet.
TextureAtlas planPart(const ViewedSurface& viewed, const TexturePart& part, double max_scale) {
  for (std::size_t min_faces = 1;; min_faces *= kFewerCharts) {
    TextureCharts cut = cutCharts(viewed, part.faces, min_faces);
    auto plan = planAtlas(cut, viewed.views, part.max_size_px, max_scale);
    if (plan) return {viewed, std::move(cut), std::move(*plan)};
    SCANTROVE_CHECK(!cut.charts.empty());  // without charts all faces fit
  }
}

/// Plans the textures of all parts. `largest`: the part with the resolution of the images.
std::vector<TextureAtlas> planParts(const ViewedSurface& viewed, std::span<const TexturePart> parts,
                                    std::size_t largest) {
  double texels = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i != largest) texels += texelsOf(cutCharts(viewed, parts[i].faces));
  }
  const double scale = texels > kMaxSmallTextures ? std::sqrt(kMaxSmallTextures / texels) : 1;
  std::vector<TextureAtlas> atlases;
  for (std::size_t i = 0; i < parts.size(); ++i)
    atlases.push_back(planPart(viewed, parts[i], i == largest ? 1 : scale));
  return atlases;
}

std::vector<std::uint32_t> allFaces(const TextureSurface& surface) {
  std::vector<std::uint32_t> faces(surface.faces.size());
  std::iota(faces.begin(), faces.end(), 0U);
  return faces;
}

}  // namespace

int texturingSteps(std::size_t views) { return 2 * static_cast<int>(views) + 2; }

Result<SurfaceTextures> textureSurface(const TexturedScene& scene, std::span<const TexturePart> parts,
                                       const TexturingProgress& progress) {
  SurfaceTextures result;
  SceneViews views(scene, progress);
  const FaceNeighbors neighbors = neighborsOf(scene.surface.faces);
  auto chosen = views.choose(neighbors, result);
  if (!chosen) return fail(chosen.error());
  const ViewedSurface viewed{scene.surface, scene.views, neighbors, std::move(*chosen)};
  const auto largest =
      std::ranges::max_element(parts, {}, [](const TexturePart& part) { return part.faces.size(); });
  std::vector<TextureAtlas> atlases =
      planParts(viewed, parts, static_cast<std::size_t>(largest - parts.begin()));
  const TextureCharts all = cutCharts(viewed, allFaces(scene.surface));
  SeamLeveling leveling(viewed, all.charts);
  for (std::size_t view = 0; view < scene.views.size(); ++view) {
    SCANTROVE_TRY(views.step("texture of view " + std::to_string(view + 1)));
    const auto number = static_cast<ViewNumber>(view);
    const bool is_used =
        std::ranges::any_of(all.charts, [&](const TextureChart& chart) { return chart.view == number; });
    if (!is_used) continue;
    auto image = scene.image(view);
    if (!image) return fail(image.error());
    leveling.sample(number, *image);
    ResizedImages resized(std::move(*image));
    for (TextureAtlas& atlas : atlases) atlas.paint(number, resized);
  }
  SCANTROVE_TRY(views.step("levelling seams"));
  leveling.solve();
  for (std::size_t i = 0; i < atlases.size(); ++i) {
    atlases[i].finish([&](std::uint32_t face) { return leveling.offsetsOf(face); });
    result.parts.push_back({atlases[i].image(), atlases[i].textureOf(parts[i].faces)});
  }
  return result;
}

}  // namespace scantrove
