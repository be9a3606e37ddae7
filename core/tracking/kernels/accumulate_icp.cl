// One pass of projective point-to-plane ICP. For a frame pixel with vertex p_f and normal n_f:
//   p = T_world_frame p_f; its pixel in the model camera gives the model's v and n (world);
//   associated when |v - p| < gate.s0 + gate.s1 z^2 and (R n_f) . n > gate.s2;
//   r = n . (v - p),  J = ((p - centre) x n, n),  Huber: w = s(z)^-2 min(1, delta / |r|), delta = gate.s3 s(z),
//   s(z) = 1 + gate.s4 z^2 (depth noise grows with z^2), z the depth in the frame.
// The same form with gate.s5 and gate.s6 instead of s3 and s4 gives h, the weight in the residual that judges the fit.
// A pixel of the overlap that lies farther from the camera than the model's surface there, by more than that distance, is
// behind it; nearer, before it.
// Sums of icp_layout.h; no NaN is converted: bounds are tested positively.
// One work-item: `run` pixels, GROUP (build option) apart; the group's sums are added in a fixed order.
// vertices, normals: pixel_count, camera frame; model_vertices, model_normals: model_width * model_height,
// world; sums: ICP_SUMS per group.
#include "core/compute/kernels/common.clh"
#include "core/tracking/kernels/icp_layout.h"

kernel void accumulate_icp(global const float4* restrict vertices, global const float4* restrict normals,
                           const int pixel_count, const int run, const float16 T_world_frame,
                           const float16 T_model_world, const float4 K_model, const int model_width,
                           const int model_height, global const float4* restrict model_vertices,
                           global const float4* restrict model_normals, const float4 centre, const float8 gate,
                           global float* restrict sums) {
  const int begin = (int)get_group_id(0) * GROUP * run + (int)get_local_id(0);
  float8 row0 = 0.0f, row1 = 0.0f, row2 = 0.0f, row3 = 0.0f, row4 = 0.0f, row5 = 0.0f, row6 = 0.0f, counts = 0.0f;

  float fit_weight = 0.0f, fit_error = 0.0f, before = 0.0f, behind = 0.0f;
  for (int k = 0; k < run; ++k) {
    const int i = begin + k * GROUP;
    if (i >= pixel_count) break;
    const float4 vertex = vertices[i];
    if (!(vertex.w > 0.0f)) continue;
    counts.s2 += 1.0f;
    const float3 p = transform_point(T_world_frame, vertex.xyz);
    const float3 q = transform_point(T_model_world, p);
    if (!(q.z > 0.05f)) continue;
    const float u = K_model.x * q.x / q.z + K_model.z + 0.5f;
    const float v = K_model.y * q.y / q.z + K_model.w + 0.5f;
    if (!(u >= 0.0f && u < (float)model_width && v >= 0.0f && v < (float)model_height)) continue;
    const int m = (int)v * model_width + (int)u;
    const float4 n4 = model_normals[m];
    if (!(n4.w > 0.0f)) continue;
    counts.s1 += 1.0f;
    const float3 n = n4.xyz;
    const float3 model_vertex = model_vertices[m].xyz;
    const float3 difference = model_vertex - p;
    const float z2 = vertex.z * vertex.z;
    const float reach = gate.s0 + gate.s1 * z2;
    const float farther = q.z - transform_point(T_model_world, model_vertex).z;
    before += farther < -reach ? 1.0f : 0.0f;
    behind += farther > reach ? 1.0f : 0.0f;
    if (!(dot(difference, difference) < reach * reach)) continue;
    if (!(dot(rotate_vector(T_world_frame, normals[i].xyz), n) > gate.s2)) continue;

    const float r = dot(n, difference);
    const float noise = 1.0f + gate.s4 * z2;
    const float size = fmax(fabs(r), 1e-12f);
    const float w = fmin(1.0f, gate.s3 * noise / size) / (noise * noise);
    const float fit_noise = 1.0f + gate.s6 * z2;
    const float h = fmin(1.0f, gate.s5 * fit_noise / size) / (fit_noise * fit_noise);
    fit_weight += h;
    fit_error += h * r * r;
    const float3 arm = p - centre.xyz;
    const float3 moment = cross(arm, n);
    const float8 J = (float8)(moment, n, r, 0.0f);
    const float8 wJ = w * J;
    row0 = fma((float8)(J.s0), wJ, row0);
    row1 = fma((float8)(J.s1), wJ, row1);
    row2 = fma((float8)(J.s2), wJ, row2);
    row3 = fma((float8)(J.s3), wJ, row3);
    row4 = fma((float8)(J.s4), wJ, row4);
    row5 = fma((float8)(J.s5), wJ, row5);
    row6 = fma((float8)(r), wJ, row6);
    counts += (float8)(1.0f, 0.0f, 0.0f, arm, dot(arm, arm), r * r);
  }

#if GROUP == 1
  global float* out = sums + (int)get_group_id(0) * ICP_SUMS;
#else
  local float shared_sums[GROUP * ICP_SUMS];
  local float* out = shared_sums + (int)get_local_id(0) * ICP_SUMS;
#endif
  row0.s7 = fit_weight;
  row1.s7 = fit_error;
  row2.s7 = before;
  row3.s7 = behind;
  vstore8(row0, 0, out);
  vstore8(row1, 1, out);
  vstore8(row2, 2, out);
  vstore8(row3, 3, out);
  vstore8(row4, 4, out);
  vstore8(row5, 5, out);
  vstore8(row6, 6, out);
  vstore8(counts, 7, out);
#if GROUP > 1
  barrier(CLK_LOCAL_MEM_FENCE);
  for (int j = (int)get_local_id(0); j < ICP_SUMS; j += GROUP) {
    float sum = 0.0f;
    for (int item = 0; item < GROUP; ++item) sum += shared_sums[item * ICP_SUMS + j];
    sums[(int)get_group_id(0) * ICP_SUMS + j] = sum;
  }
#endif
}
