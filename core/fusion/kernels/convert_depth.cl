// depth_m(u) = units(u) * metres_per_unit where that lies in [min_depth, max_depth], else 0.
// One work-item: one pixel. units, depth_m: `count` elements, row by row.
kernel void convert_depth(global const ushort* restrict units, const int count, const float metres_per_unit,
                          const float min_depth, const float max_depth, global float* restrict depth_m) {
  const int i = (int)get_global_id(0);
  if (i >= count) return;
  const float z = (float)units[i] * metres_per_unit;
  depth_m[i] = (z >= min_depth && z <= max_depth) ? z : 0.0f;
}
