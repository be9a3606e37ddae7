// The model of one scanned object against the truth of demo:turntable:SEED: distance of its surface, how much
// of what the camera saw it has, and its texture at places where no camera stood.
//
//   scantrove scan demo:turntable:3 --object --out turn
//   scantrove export turn --format mesh --texture --out model
//   build/dev/tests/benchmarks/object_model_benchmark 3 model/scene.obj
#include <pcl/kdtree/kdtree_flann.h>
#include <spdlog/fmt/fmt.h>

#include <CLI/CLI.hpp>
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>
#include <opencv2/core.hpp>

#include "core/synthetic/lighting.h"
#include "core/synthetic/renderer.h"
#include "core/synthetic/synthetic_source.h"
#include "tests/support/textured_obj.h"

namespace scantrove {
namespace {

constexpr double kReach_m = 0.005;   // surface within this distance counts as modelled
constexpr double kSample_m = 0.001;  // distance of samples on faces
constexpr int kTruthEvery = 6;       // frames, of 1.5 degrees each

struct Surface {
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector3d> normals;
};

pcl::KdTreeFLANN<pcl::PointXYZ> treeOf(const std::vector<Eigen::Vector3d>& points) {
  const auto cloud = std::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  for (const Eigen::Vector3d& p : points) {
    cloud->emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()));
  }
  pcl::KdTreeFLANN<pcl::PointXYZ> tree;
  tree.setInputCloud(cloud);
  return tree;
}

struct Nearest {
  std::size_t index = 0;
  double distance_m = 0;
};

Nearest nearestOf(const pcl::KdTreeFLANN<pcl::PointXYZ>& tree, const Eigen::Vector3d& p) {
  pcl::Indices index(1);
  std::vector<float> squared(1);
  tree.nearestKSearch({static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())}, 1,
                      index, squared);
  return {static_cast<std::size_t>(index[0]), std::sqrt(static_cast<double>(squared[0]))};
}

/// What the cameras of the recording see of the thing, in the frame of the thing at rest.
Surface truthOf(SyntheticSource& exact, const SyntheticScene& at_rest, const Intrinsics& K,
                std::uint16_t thing) {
  Surface truth;
  for (FrameRead read = exact.next(); read.status == FrameRead::Status::frame; read = exact.next()) {
    const Eigen::Isometry3d T_thing_camera = exact.pose(read.frame.index);
    for (int v = 0; v < K.height; v += 2) {
      for (int u = 0; u < K.width; u += 2) {
        if (read.frame.instances.at<std::uint16_t>(v, u) != thing) continue;
        const Eigen::Vector3d ray((u - static_cast<double>(K.cx)) / static_cast<double>(K.fx),
                                  (v - static_cast<double>(K.cy)) / static_cast<double>(K.fy), 1);
        const Eigen::Vector3d direction = T_thing_camera.linear() * ray;
        const RayHit hit = at_rest.cast(T_thing_camera.translation(), direction);
        if (hit.instance != thing) continue;
        truth.points.push_back(T_thing_camera.translation() + hit.distance * direction);
        truth.normals.push_back(hit.normal);
      }
    }
  }
  return truth;
}

/// Points on all faces, kSample_m apart at most.
std::vector<Eigen::Vector3d> samplesOf(const test::TexturedObj& mesh) {
  std::vector<Eigen::Vector3d> points;
  for (const auto& face : mesh.faces) {
    const Eigen::Vector3d a = mesh.vertices[face[0].vertex], ab = mesh.vertices[face[1].vertex] - a,
                          ac = mesh.vertices[face[2].vertex] - a;
    const int steps = std::max(1, static_cast<int>(std::ceil(std::max(ab.norm(), ac.norm()) / kSample_m)));
    for (int i = 0; i <= steps; ++i) {
      for (int j = 0; i + j <= steps; ++j) points.push_back(a + ab * i / steps + ac * j / steps);
    }
  }
  return points;
}

/// Moves the mesh onto the truth: point-to-plane steps from the first camera's pose. The result: the whole
/// motion.
Eigen::Isometry3d align(test::TexturedObj& mesh, const Surface& truth,
                        const pcl::KdTreeFLANN<pcl::PointXYZ>& tree, int steps) {
  Eigen::Isometry3d whole = Eigen::Isometry3d::Identity();
  for (int step = 0; step < steps; ++step) {
    Eigen::Matrix<double, 6, 6> A = Eigen::Matrix<double, 6, 6>::Zero();
    Eigen::Matrix<double, 6, 1> b = Eigen::Matrix<double, 6, 1>::Zero();
    for (std::size_t i = 0; i < mesh.vertices.size(); i += 3) {
      const Eigen::Vector3d& p = mesh.vertices[i];
      const Nearest nearest = nearestOf(tree, p);
      if (nearest.distance_m > 0.01) continue;
      const Eigen::Vector3d& n = truth.normals[nearest.index];
      Eigen::Matrix<double, 6, 1> row;
      row << p.cross(n), n;
      A += row * row.transpose();
      b += row * n.dot(truth.points[nearest.index] - p);
    }
    const Eigen::Matrix<double, 6, 1> x = A.ldlt().solve(b);
    Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
    if (x.head<3>().norm() > 0) {
      motion.linear() = Eigen::AngleAxisd(x.head<3>().norm(), x.head<3>().normalized()).toRotationMatrix();
    }
    motion.translation() = x.tail<3>();
    for (Eigen::Vector3d& p : mesh.vertices) p = motion * p;
    whole = motion * whole;
  }
  return whole;
}

/// The textured mesh as a camera sees it, faces from outside only; `drawn`: 255 where it is.
cv::Mat3b rendered(const test::TexturedObj& mesh, const Intrinsics& K,
                   const Eigen::Isometry3d& T_thing_camera, cv::Mat1b& drawn) {
  cv::Mat3b image(K.height, K.width, cv::Vec3b(0, 0, 0));
  cv::Mat1f nearest(K.height, K.width, 1e9F);
  drawn = cv::Mat1b(K.height, K.width, uchar{0});
  const Eigen::Isometry3d T_camera_thing = T_thing_camera.inverse();
  for (const auto& face : mesh.faces) {
    Eigen::Matrix3d at;  // corners in pixels, third row: 1 / z
    Eigen::Matrix<double, 2, 3> place;
    bool is_before = true;
    for (int k = 0; k < 3; ++k) {
      const auto& corner = face[static_cast<std::size_t>(k)];
      const Eigen::Vector3d p = T_camera_thing * mesh.vertices[corner.vertex];
      is_before = is_before && p.z() > 0.01;
      at.col(k) =
          Eigen::Vector3d(static_cast<double>(K.fx) * p.x() / p.z() + static_cast<double>(K.cx),
                          static_cast<double>(K.fy) * p.y() / p.z() + static_cast<double>(K.cy), 1 / p.z());
      place.col(k) = mesh.places[corner.place];
    }
    if (!is_before) continue;
    const auto cross = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
      return a.x() * b.y() - a.y() * b.x();
    };
    const Eigen::Vector2d a = at.col(0).head<2>(), ab = at.col(1).head<2>() - a, ac = at.col(2).head<2>() - a;
    const double area = cross(ab, ac);  // counter-clockwise from outside is clockwise where y points down
    if (area >= 0) continue;
    const int left = std::max(0, static_cast<int>(std::ceil(at.row(0).minCoeff()))),
              right = std::min(K.width - 1, static_cast<int>(std::floor(at.row(0).maxCoeff()))),
              upper = std::max(0, static_cast<int>(std::ceil(at.row(1).minCoeff()))),
              lower = std::min(K.height - 1, static_cast<int>(std::floor(at.row(1).maxCoeff())));
    for (int v = upper; v <= lower; ++v) {
      for (int u = left; u <= right; ++u) {
        const Eigen::Vector2d d = Eigen::Vector2d(u, v) - a;
        const double second = cross(d, ac) / area, third = cross(ab, d) / area;
        if (second < 0 || third < 0 || second + third > 1) continue;
        Eigen::Vector3d weights(1 - second - third, second, third);
        weights = weights.cwiseProduct(at.row(2).transpose());
        const double z = 1 / weights.sum();
        if (z >= static_cast<double>(nearest(v, u))) continue;
        nearest(v, u) = static_cast<float>(z);
        const Eigen::Vector2d t = place * weights * z;
        const double x = std::clamp(t.x() * mesh.image.cols - 0.5, 0.0, mesh.image.cols - 1.001),
                     y = std::clamp((1 - t.y()) * mesh.image.rows - 0.5, 0.0, mesh.image.rows - 1.001);
        const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
        const auto texel = [&](int dx, int dy) -> cv::Vec3d {
          return mesh.image.at<cv::Vec3b>(std::min(y0 + dy, mesh.image.rows - 1),
                                          std::min(x0 + dx, mesh.image.cols - 1));
        };
        const cv::Vec3d color = (1 - (y - y0)) * ((1 - (x - x0)) * texel(0, 0) + (x - x0) * texel(1, 0)) +
                                (y - y0) * ((1 - (x - x0)) * texel(0, 1) + (x - x0) * texel(1, 1));
        image(v, u) = cv::Vec3b(color);
        drawn(v, u) = 255;
      }
    }
  }
  return image;
}

/// A camera that looks at `middle` from `raised_deg` higher.
Eigen::Isometry3d raised(const Eigen::Isometry3d& T_thing_camera, const Eigen::Vector3d& middle,
                         double raised_deg) {
  Eigen::Isometry3d about = Eigen::Isometry3d::Identity();
  const Eigen::Vector3d right = T_thing_camera.linear().col(0);
  about.translate(middle);
  about.rotate(Eigen::AngleAxisd(-raised_deg / 180 * std::numbers::pi, right));
  about.translate(-middle);
  return about * T_thing_camera;
}

double percentileOf(std::vector<double> values, double part) {
  if (values.empty()) return std::nan("");
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

int compare(std::uint32_t seed, const std::string& file) {
  std::optional<test::TexturedObj> mesh = test::TexturedObj::read(file);
  if (!mesh) {
    std::cerr << file << " has no faces with a texture. Export the scan with --format mesh --texture.\n";
    return 1;
  }
  SyntheticOptions options;
  options.recipe = [seed] { return synthetic::makeRandomTurntableScene(seed); };
  options.noise = options.color = false;
  const auto at_rest = makeSyntheticSource(options).value();
  const Intrinsics K = options.K;
  options.stride = kTruthEvery;
  const auto exact = makeSyntheticSource(options).value();
  const SyntheticScene& scene = at_rest->scene();
  const std::uint16_t thing = scene.find("thing");
  const Surface truth = truthOf(*exact, scene, K, thing);
  const auto truth_tree = treeOf(truth.points);
  for (Eigen::Vector3d& p : mesh->vertices) p = at_rest->pose(0) * p;  // the map begins at the first camera
  const Eigen::Isometry3d moved = align(*mesh, truth, truth_tree, 20);

  std::vector<double> off_m;
  for (const Eigen::Vector3d& p : samplesOf(*mesh)) {
    const Nearest nearest = nearestOf(truth_tree, p);
    const Eigen::Vector3d away = p - truth.points[nearest.index];
    off_m.push_back(nearest.distance_m < kReach_m ? std::abs(away.dot(truth.normals[nearest.index]))
                                                  : away.norm());
  }
  const auto model_tree = treeOf(samplesOf(*mesh));
  std::size_t within_reach = 0, within_3mm = 0;
  for (const Eigen::Vector3d& p : truth.points) {
    const double distance_m = nearestOf(model_tree, p).distance_m;
    within_reach += distance_m <= kReach_m ? 1U : 0U;
    within_3mm += distance_m <= 0.003 ? 1U : 0U;
  }

  const synthetic::SceneRecipe recipe = synthetic::makeRandomTurntableScene(seed);
  const synthetic::Lighting lighting(recipe.scene, recipe.lit_center, recipe.lit_radius_m, recipe.lights);
  const Eigen::Vector3d middle = scene.boundsOf(thing).center();
  double squares = 0, values = 0, squares_same_height = 0, values_same_height = 0, drawn_part = 0;
  int views = 0;
  for (const double height_deg : {-8.0, 0.0, 8.0}) {
    for (int frame = 7; frame < 240; frame += 30) {
      const Eigen::Isometry3d T_thing_camera = raised(at_rest->pose(frame), middle, height_deg);
      const synthetic::RenderedFrame image = synthetic::renderFrame(scene, &lighting, K, T_thing_camera);
      cv::Mat1b drawn;
      const cv::Mat3b shown = rendered(*mesh, K, T_thing_camera, drawn);
      const cv::Mat both = drawn & (image.instances == thing);
      const double count = 3.0 * cv::countNonZero(both);
      cv::Mat difference;
      cv::absdiff(shown, image.color, difference);
      difference.setTo(cv::Scalar::all(0), both == 0);
      const double sum = cv::norm(difference, cv::NORM_L2SQR);
      squares += sum;
      values += count;
      if (height_deg == 0) squares_same_height += sum, values_same_height += count;
      drawn_part += cv::countNonZero(both) / static_cast<double>(cv::countNonZero(image.instances == thing));
      ++views;
    }
  }
  const auto psnrOf = [](double sum, double count) { return 10 * std::log10(255.0 * 255.0 * count / sum); };
  std::cout << fmt::format(
      "turntable {}: off by {:.2f} mm (median), {:.2f} mm (95 %); {:.1f} % of the seen surface within 5 mm, "
      "{:.1f} % "
      "within 3 mm; texture {:.1f} dB, at the camera's height {:.1f} dB, over {:.1f} % of the thing's pixels "
      "in {} views; "
      "aligned by {:.1f} mm and {:.2f} degrees; {} faces\n",
      seed, 1000 * percentileOf(off_m, 0.5), 1000 * percentileOf(off_m, 0.95),
      100 * static_cast<double>(within_reach) / static_cast<double>(truth.points.size()),
      100 * static_cast<double>(within_3mm) / static_cast<double>(truth.points.size()),
      psnrOf(squares, values), psnrOf(squares_same_height, values_same_height), 100 * drawn_part / views,
      views, 1000 * (moved * middle - middle).norm(),
      Eigen::AngleAxisd(moved.linear()).angle() * 180 / std::numbers::pi, mesh->faces.size());
  return 0;
}

}  // namespace
}  // namespace scantrove

int main(int argc, char** argv) {
  CLI::App app("The model of an object that was scanned on a turntable, against the truth");
  std::uint32_t seed = 0;
  std::string file;
  app.add_option("seed", seed, "of demo:turntable")->required();
  app.add_option("mesh", file, "scene.obj of `scantrove export --format mesh --texture`")->required();
  CLI11_PARSE(app, argc, argv);
  return scantrove::compare(seed, file);
}
