// picked: values[from] where negative, except in lane 2; else 100 * row + column of the lane in its block.
// any: not 0 if a work-item has a negative value. One work-item: LANES values.
#include "core/compute/kernels/lanes.clh"

kernel void pick_negative(global const float* values, global const int* from, global float* picked, global int* any) {
  const int item = (int)get_global_id(0);
  const intN place = EACH_LANE(intN, ELEMENT_AT, from, LANES * item + LANE);
  const floatN value = GATHER(floatN, values, place);
  const intN negative = value < 0.0f;
  const intN second = LANE == 2;
  const floatN block = convert_floatN(100 * LANE_Y + LANE_X);
  any[item] = any_lane(negative);
  STORE((negative & ~second) ? value : block, picked + LANES * item);
}

// Elements of two, one and four bytes at the indices `from`; for four bytes they are byte offsets.
kernel void gather_each(global const short* shorts, global const uchar* bytes, global const int* from,
                        global int* of_shorts, global int* of_bytes, global uint* words) {
  const int first = LANES * (int)get_global_id(0);
  const intN place = GATHER(intN, from, first + LANE);
  STORE(GATHER_SHORT(shorts, place), of_shorts + first);
  STORE(GATHER_UCHAR(bytes, place), of_bytes + first);
  STORE(GATHER_BYTES(bytes, place), words + first);
}
