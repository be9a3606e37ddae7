// One pass of projective point-to-plane ICP. For a frame pixel with vertex p_f and normal n_f:
//   p = T_world_frame p_f; its pixel in the model camera gives the model's v and n (world);
//   associated when |v - p| < gate.s0 + gate.s1 z^2 and (R n_f) . n > gate.s2;
//   r = n . (v - p),  J = ((p - centre) x n, n),  Huber: w = s(z)^-2 min(1, delta / |r|), delta = gate.s3 s(z),
//   s(z) = 1 + gate.s4 z^2 (depth noise grows with z^2), z the depth in the frame.
// The same form with gate.s5 and gate.s6 instead of s3 and s4 gives h, the weight in the residual that judges the fit.
// A pixel of the overlap is behind the model's surface if it is farther from the camera by more than that distance, and before
// it if nearer by as much.
// Sums as in icp_layout.h. Bounds tests fail for NaN, so no NaN is converted to an integer.
// One work-item: `run` pixels, LANES of them at a time, GROUP * LANES (GROUP: build option) apart; the lanes' and the group's
// sums are added in a fixed order.
// vertices, normals: pixel_count, camera frame; model_vertices, model_normals: model_width * model_height,
// world; sums: ICP_SUMS per group.
#include "core/compute/kernels/lanes.clh"
#include "core/tracking/kernels/icp_layout.h"

inline Points transformed(const float16 T, const Points p) {
  const Points result = {T.s0 * p.x + T.s1 * p.y + T.s2 * p.z + T.s3, T.s4 * p.x + T.s5 * p.y + T.s6 * p.z + T.s7,
                         T.s8 * p.x + T.s9 * p.y + T.sa * p.z + T.sb, p.w};
  return result;
}

// Huber's weight of residuals whose noise is `noise` times the noise at which `delta` applies.
inline floatN huber_weight(const floatN size, const floatN noise, const float delta) {
  const floatN reach = delta * noise;
  return (size < reach ? 1.0f : reach / size) / (noise * noise);
}

kernel void accumulate_icp(global const float4* restrict vertices, global const float4* restrict normals,
                           const int pixel_count, const int run, const float16 T_world_frame,
                           const float16 T_model_world, const float4 K_model, const int model_width,
                           const int model_height, global const float4* restrict model_vertices,
                           global const float4* restrict model_normals, const float4 centre, const float8 gate,
                           global float* restrict sums) {
  floatN total[ICP_SUMS];
#pragma unroll
  for (int i = 0; i < ICP_SUMS; ++i) total[i] = 0.0f;
  const float16 turn = (float16)(T_world_frame.s012, 0.0f, T_world_frame.s456, 0.0f, T_world_frame.s89a, 0.0f, (float4)(0.0f));

  const int begin = LANES * ((int)get_group_id(0) * GROUP * (run / LANES) + (int)get_local_id(0));
  for (int k = 0; k < run / LANES; ++k) {
    const intN i = begin + k * GROUP * LANES + LANE;
    const intN pixel = min(i, (intN)(pixel_count - 1));
    const Points vertex = points_at(vertices, pixel);
    const intN reading = where(i < pixel_count) & where(vertex.w > 0.0f);
    if (!any_lane(reading)) continue;
    total[ICP_READINGS] += one_where(reading);
    const Points p = transformed(T_world_frame, vertex);
    const Points q = transformed(T_model_world, p);
    const floatN per_z = 1.0f / q.z;
    const floatN u = K_model.x * q.x * per_z + (K_model.z + 0.5f);
    const floatN v = K_model.y * q.y * per_z + (K_model.w + 0.5f);
    const intN inside = reading & where(q.z > 0.05f) & where(u >= 0.0f) & where(u < (float)model_width) & where(v >= 0.0f) &
                        (v < (float)model_height);
    const intN m = convert_intN(inside ? v : 0.0f) * model_width + convert_intN(inside ? u : 0.0f);
    const Points n = points_at(model_normals, m);
    const intN overlap = inside & where(n.w > 0.0f);
    if (!any_lane(overlap)) continue;
    total[ICP_OVERLAP] += one_where(overlap);
    const Points model = points_at(model_vertices, m);
    const Points difference = {model.x - p.x, model.y - p.y, model.z - p.z, 0.0f};
    const floatN z2 = vertex.z * vertex.z;
    const floatN reach = gate.s0 + gate.s1 * z2;
    const floatN farther = q.z - transformed(T_model_world, model).z;
    total[ICP_BEFORE] += one_where(overlap & (farther < -reach));
    total[ICP_BEHIND] += one_where(overlap & (farther > reach));
    const Points normal = transformed(turn, points_at(normals, pixel));
    const intN meets =
        overlap & where(dot_of(difference, difference) < reach * reach) & where(dot_of(normal, n) > gate.s2);
    if (!any_lane(meets)) continue;

    const floatN r = meets ? dot_of(n, difference) : 0.0f;
    const floatN w = meets ? huber_weight(fabs(r), 1.0f + gate.s4 * z2, gate.s3) : 0.0f;
    const floatN h = meets ? huber_weight(fabs(r), 1.0f + gate.s6 * z2, gate.s5) : 0.0f;
    total[ICP_FIT_WEIGHT] += h;
    total[ICP_FIT_ERROR] += h * r * r;
    const floatN arm_x = meets ? p.x - centre.x : 0.0f;
    const floatN arm_y = meets ? p.y - centre.y : 0.0f;
    const floatN arm_z = meets ? p.z - centre.z : 0.0f;
    const floatN J[7] = {arm_y * n.z - arm_z * n.y, arm_z * n.x - arm_x * n.z, arm_x * n.y - arm_y * n.x,
                         n.x, n.y, n.z, r};
#pragma unroll
    for (int row = 0; row < 7; ++row) {
      const floatN weighted = w * J[row];
#pragma unroll
      for (int column = row; column < 7; ++column) total[8 * row + column] += weighted * J[column];
    }
    total[ICP_INLIERS] += one_where(meets);
    total[ICP_POINT] += arm_x;
    total[ICP_POINT + 1] += arm_y;
    total[ICP_POINT + 2] += arm_z;
    total[ICP_POINT_2] += arm_x * arm_x + arm_y * arm_y + arm_z * arm_z;
    total[ICP_ERROR] += r * r;
  }

#if GROUP == 1
  global float* out = sums + (int)get_group_id(0) * ICP_SUMS;
#else
  local float shared_sums[GROUP * ICP_SUMS];
  local float* out = shared_sums + (int)get_local_id(0) * ICP_SUMS;
#endif
#pragma unroll
  for (int row = 0; row < 8; ++row) {
#pragma unroll
    for (int column = 0; column < 8; ++column) {
      const bool is_mirrored = row < 7 && column < row;
      out[8 * row + column] = sum_of_lanes(total[is_mirrored ? 8 * column + row : 8 * row + column]);
    }
  }
#if GROUP > 1
  barrier(CLK_LOCAL_MEM_FENCE);
  for (int j = (int)get_local_id(0); j < ICP_SUMS; j += GROUP) {
    float sum = 0.0f;
    for (int item = 0; item < GROUP; ++item) sum += shared_sums[item * ICP_SUMS + j];
    sums[(int)get_group_id(0) * ICP_SUMS + j] = sum;
  }
#endif
}
