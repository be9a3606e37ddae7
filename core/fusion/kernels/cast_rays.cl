#include "core/fusion/kernels/brick_window.clh"

// V_t and N_t: along each pixel's ray the first place where the signed distance goes from + to -, found by steps no longer
// than the distance allows and refined in the trilinear field; the normal is the field's gradient (central differences of
// one voxel). A ray that comes from - to + first has met a surface from behind and gets no vertex.
//
// One work-item: one pixel; work-groups of TILE x TILE pixels share a depth range.
// ranges: (nearest, farthest) camera z of the bricks in view per tile, ceil(width / TILE) a row; nearest > farthest = none.
// T_window_camera: camera metres to voxels of the window. origin_m: world position of the window's first voxel corner.
// vertices, normals: width * height, world, w = 1, or all 0.

typedef struct Field {
  global const int* cells;
  global const int* page_slots;
  global const uint* voxels;
  int4 size;
  int bx, by, bz, slot; /* the brick looked up last */
} Field;

inline int field_slot(Field* field, const int bx, const int by, const int bz) {
  if (bx != field->bx || by != field->by || bz != field->bz) {
    field->bx = bx;
    field->by = by;
    field->bz = bz;
    field->slot = window_slot(field->cells, field->page_slots, field->size, bx, by, bz);
  }
  return field->slot;
}

// The voxel (x, y, z) of the window as (distance in truncations, 1), or (0, 0) where never seen.
inline float2 field_voxel(Field* field, const int x, const int y, const int z) {
  const int slot = field_slot(field, x >> BRICK_SHIFT, y >> BRICK_SHIFT, z >> BRICK_SHIFT);
  if (slot < 0) return (float2)(0.0f, 0.0f);
  const uint voxel = field->voxels[slot * BRICK_VOXELS + (x & 7) + 8 * ((y & 7) + 8 * (z & 7))];
  if ((voxel >> 16) == 0) return (float2)(0.0f, 0.0f);
  return (float2)((float)(short)(voxel & 0xffffu) * (1.0f / 32767.0f), 1.0f);
}

// Trilinear distance at p (voxels; samples lie at voxel centres) and 1, or (0, 0) if one of the eight voxels was never seen.
inline float2 field_at(Field* field, const float px, const float py, const float pz) {
  const float fx = floor(px - 0.5f);
  const float fy = floor(py - 0.5f);
  const float fz = floor(pz - 0.5f);
  const int x = (int)fx;
  const int y = (int)fy;
  const int z = (int)fz;
  const float wx = px - 0.5f - fx;
  const float wy = py - 0.5f - fy;
  const float wz = pz - 0.5f - fz;
  float2 c[8];
  for (int i = 0; i < 8; ++i) c[i] = field_voxel(field, x + (i & 1), y + ((i >> 1) & 1), z + (i >> 2));
  const float4 near_face = mix((float4)(c[0].x, c[2].x, c[4].x, c[6].x), (float4)(c[1].x, c[3].x, c[5].x, c[7].x), wx);
  const float2 edge = mix((float2)(near_face.x, near_face.z), (float2)(near_face.y, near_face.w), wy);
  const float valid = c[0].y * c[1].y * c[2].y * c[3].y * c[4].y * c[5].y * c[6].y * c[7].y;
  return (float2)(mix(edge.x, edge.y, wz), valid);
}

// Difference of the field over two voxels around a point where it is 0, from the sides that were seen; false if none was.
inline bool field_slope(const float2 before, const float2 after, float* slope) {
  *slope = before.y * after.y > 0.0f ? after.x - before.x : 2.0f * (after.x - before.x);
  return before.y + after.y > 0.0f;
}

kernel void cast_rays(global const float2* ranges, const int width, const int height, const float4 K,
                      const float16 T_window_camera, const float voxel_size_m, const float truncation_m,
                      const float4 origin_m, global const int* cells, global const int* page_slots,
                      const int4 window_size, global const uint* voxels, global float4* vertices,
                      global float4* normals) {
  const int u = (int)get_global_id(0);
  const int v = (int)get_global_id(1);
  if (u >= width || v >= height) return;
  const int pixel = v * width + u;
  vertices[pixel] = (float4)(0.0f);
  normals[pixel] = (float4)(0.0f);
  const float2 range = ranges[(v / TILE) * ((width + TILE - 1) / TILE) + u / TILE];
  if (!(range.x < range.y)) return;

  Field field = {cells, page_slots, voxels, window_size, INT_MIN, 0, 0, BRICK_NONE};
  const float cx = ((float)u - K.z) / K.x;
  const float cy = ((float)v - K.w) / K.y;
  // p(t) = o + t d, t = camera z in metres.
  const float ox = T_window_camera.s3;
  const float oy = T_window_camera.s7;
  const float oz = T_window_camera.sb;
  const float dx = T_window_camera.s0 * cx + T_window_camera.s1 * cy + T_window_camera.s2;
  const float dy = T_window_camera.s4 * cx + T_window_camera.s5 * cy + T_window_camera.s6;
  const float dz = T_window_camera.s8 * cx + T_window_camera.s9 * cy + T_window_camera.sa;
  const float t_voxel = 1.0f / sqrt(dx * dx + dy * dy + dz * dz);
  const float inverse_x = 1.0f / dx;
  const float inverse_y = 1.0f / dy;
  const float inverse_z = 1.0f / dz;
  const float truncation_vox = truncation_m / voxel_size_m;

  float t = range.x;
  float t_before = 0.0f;
  float before = 0.0f; /* the distance at t_before; 0 = unknown */
  float now = 0.0f;
  bool met = false;
  while (t < range.y) {
    const float x = ox + t * dx;
    const float y = oy + t * dy;
    const float z = oz + t * dz;
    const int bx = (int)floor(x) >> BRICK_SHIFT;
    const int by = (int)floor(y) >> BRICK_SHIFT;
    const int bz = (int)floor(z) >> BRICK_SHIFT;
    if (field_slot(&field, bx, by, bz) < 0) {
      // To just behind the face through which the ray leaves this brick.
      const float tx = ((float)(BRICK_SIDE * (bx + (dx > 0.0f))) - ox) * inverse_x;
      const float ty = ((float)(BRICK_SIDE * (by + (dy > 0.0f))) - oy) * inverse_y;
      const float tz = ((float)(BRICK_SIDE * (bz + (dz > 0.0f))) - oz) * inverse_z;
      const float leave = fmin(tx, fmin(ty, tz));
      t = fmax(leave, t) + 0.05f * t_voxel;
      before = 0.0f;
      continue;
    }
    float2 sample = field_voxel(&field, (int)floor(x), (int)floor(y), (int)floor(z));
    if (sample.y > 0.0f && sample.x < 0.5f) sample = field_at(&field, x, y, z);
    if (sample.y == 0.0f) {
      t += t_voxel;
      before = 0.0f;
      continue;
    }
    now = sample.x;
    if (before > 0.0f && now <= 0.0f) {
      met = true;
      break;
    }
    if (before < 0.0f && now > 0.0f) return;
    before = now;
    t_before = t;
    t += t_voxel * fmax(1.0f, 0.8f * truncation_vox * fabs(now));
  }
  if (!met) return;

  // Regula falsi between (t_before, before > 0) and (t, now <= 0).
  float t_hit = t_before + (t - t_before) * before / (before - now);
  for (int i = 0; i < 2; ++i) {
    const float2 sample = field_at(&field, ox + t_hit * dx, oy + t_hit * dy, oz + t_hit * dz);
    if (sample.y == 0.0f) break;
    if (sample.x > 0.0f) {
      t_before = t_hit;
      before = sample.x;
    } else {
      t = t_hit;
      now = sample.x;
    }
    t_hit = t_before + (t - t_before) * before / (before - now);
  }
  const float x = ox + t_hit * dx;
  const float y = oy + t_hit * dy;
  const float z = oz + t_hit * dz;
  vertices[pixel] =
      (float4)(origin_m.x + voxel_size_m * x, origin_m.y + voxel_size_m * y, origin_m.z + voxel_size_m * z, 1.0f);

  float nx, ny, nz;
  const bool sx = field_slope(field_at(&field, x - 1.0f, y, z), field_at(&field, x + 1.0f, y, z), &nx);
  const bool sy = field_slope(field_at(&field, x, y - 1.0f, z), field_at(&field, x, y + 1.0f, z), &ny);
  const bool sz = field_slope(field_at(&field, x, y, z - 1.0f), field_at(&field, x, y, z + 1.0f), &nz);
  const float squared = nx * nx + ny * ny + nz * nz;
  if (!(sx && sy && sz && squared > 0.0f)) return;
  const float scale = (nx * dx + ny * dy + nz * dz > 0.0f ? -1.0f : 1.0f) / sqrt(squared);
  normals[pixel] = (float4)(scale * nx, scale * ny, scale * nz, 1.0f);
}
