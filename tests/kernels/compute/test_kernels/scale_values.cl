#include "core/compute/kernels/common.clh"

// out[i] = factor * in[i] for i < count; `visits` counts work-items, also those beyond count.
kernel void scale_values(global const float* in, global float* out, global int* visits, const float factor,
                         const int count) {
  const int i = get_global_id(0);
  atomic_inc(visits);
  if (i >= count) return;
  out[i] = factor * in[i];
}

#ifdef OFFSET
kernel void add_offset(global float* values, const int count) {
  const int i = get_global_id(0);
  if (i < count) values[i] += OFFSET;
}
#endif

// out = T * p, by the shared helper.
kernel void move_point(global float4* point, const float16 T) {
  point[0] = (float4)(transform_point(T, point[0].xyz), 1);
}

kernel void mark_pixels(global int* image, const int width, const int height) {
  const int x = get_global_id(0);
  const int y = get_global_id(1);
  if (x < width && y < height) image[y * width + x] = 1000 * y + x;
}
