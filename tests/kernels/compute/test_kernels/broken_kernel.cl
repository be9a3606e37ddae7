// Does not compile on purpose: the error below is on line 7 of this file.
#include "core/compute/kernels/common.clh"

kernel void broken_kernel(global float* out) {
  const int i = get_global_id(0);

  out[i] = no_such_value + i;
}
