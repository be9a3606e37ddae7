// Removes the pixels under a mask of another size. The mask's pixel of (x, y) in an image of width * height is
//   (floor(x mask_width / width), floor(y mask_height / height)); pixels where it is not 0 are removed.
// One work-item: one pixel of the image, which has the size of the launch. mask: mask_width * mask_height.

inline int is_left_out(global const uchar* mask, const int mask_width, const int mask_height) {
  const int x = (int)get_global_id(0) * mask_width / (int)get_global_size(0);
  const int y = (int)get_global_id(1) * mask_height / (int)get_global_size(1);
  return mask[y * mask_width + x] != 0;
}

// from, to: metres, 0 = no reading.
kernel void leave_out_depth(global const uchar* restrict mask, const int mask_width, const int mask_height,
                            global const float* restrict from, global float* restrict to) {
  const int i = (int)get_global_id(1) * (int)get_global_size(0) + (int)get_global_id(0);
  to[i] = is_left_out(mask, mask_width, mask_height) ? 0.0f : from[i];
}

// vertices, normals: in/out; all 0 = no surface.
kernel void leave_out_surface(global const uchar* restrict mask, const int mask_width, const int mask_height,
                              global float4* restrict vertices, global float4* restrict normals) {
  const int i = (int)get_global_id(1) * (int)get_global_size(0) + (int)get_global_id(0);
  if (!is_left_out(mask, mask_width, mask_height)) return;
  vertices[i] = (float4)(0.0f);
  normals[i] = (float4)(0.0f);
}
