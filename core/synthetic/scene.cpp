#include "core/synthetic/scene.h"

#include <utility>

namespace scantrove {

RayHit SyntheticScene::cast(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const {
  synthetic::ShapeHit best;
  const Part* part_hit = nullptr;
  for (const Part& part : parts_) {
    const Eigen::Isometry3d T_part_world = part.T_world_part.inverse();
    const synthetic::Ray ray{T_part_world * origin, T_part_world.linear() * direction};
    const synthetic::ShapeHit hit = part.shape->intersect(ray, best.t);
    if (hit.t < best.t) {
      best = hit;
      part_hit = &part;
    }
  }
  if (part_hit == nullptr) {
    return {};
  }
  const Eigen::Vector3d point = part_hit->T_world_part.inverse() * (origin + best.t * direction);
  Eigen::Vector3d normal =
      part_hit->T_world_part.linear() * part_hit->shape->describe(point, best.part).normal;
  if (normal.dot(direction) > 0) {
    normal = -normal;
  }
  return {best.t, normal, part_hit->instance};
}

std::uint16_t SyntheticScene::find(const std::string& name) const {
  for (const InstanceName& instance : instances_) {
    if (instance.name == name) {
      return instance.id;
    }
  }
  return 0;
}

Eigen::AlignedBox3d SyntheticScene::boundsOf(std::uint16_t instance) const {
  Eigen::AlignedBox3d bounds;
  for (const Part& part : parts_) {
    if (part.instance != instance) continue;
    const Eigen::Matrix3d towards = part.T_world_part.linear().transpose();  // columns: the world's axes
    Eigen::Vector3d low = part.T_world_part.translation();
    Eigen::Vector3d high = low;
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] -= part.shape->reach(-towards.col(axis));
      high[axis] += part.shape->reach(towards.col(axis));
    }
    bounds.extend(Eigen::AlignedBox3d(low, high));
  }
  return bounds;
}

std::uint16_t SyntheticScene::addInstance(std::string name, bool is_object, bool non_convex) {
  const auto id = static_cast<std::uint16_t>(instances_.size() + 1);
  instances_.push_back({id, std::move(name), is_object, non_convex});
  return id;
}

void SyntheticScene::add(std::uint16_t instance, std::unique_ptr<synthetic::Shape> shape,
                         const Eigen::Isometry3d& T_world_part, const synthetic::Material& material) {
  parts_.push_back({std::move(shape), T_world_part, material, instance});
}

}  // namespace scantrove
