// Warped SSD with local shifts between queries and views (Torralba et al. 2008), relative to their energy:
//   D = 2 sum (q(x + t) - v(x))^2 / (sum q(x + t)^2 + sum v(x)^2)        0 = the same, 2 = unrelated
// over the three channels. score_warps: D at 16 x 16 for every warp of every pair. refine_matches: the best of these,
// then the best of +-1 pixel at 32 x 32, then each pixel uses the best of its 3 x 3 neighbours.
// Sums are integers; 3 * 32 * 32 * 254^2 fits into 32 bits. The bytes of 700,000 views do not, so their offsets are size_t.
#include "core/catalogue/kernels/thumbnail_layout.h"

inline int sum16(const int16 v) {
  const int8 a = v.lo + v.hi;
  const int4 b = a.lo + a.hi;
  return b.x + b.y + b.z + b.w;
}

inline float quotient(const int ssd, const int energy) { return energy == 0 ? 2.0f : 2.0f * (float)ssd / (float)energy; }

// One work-item: one warp of one pair; global = (54, pairs). pairs: (query, view). scores: [pair][54].
// queries: [query][variant][3][18][18]; views: [view][3][16][16].
kernel void score_warps(global const char* queries, global const char* views, global const int2* pairs,
                        global float* scores, const int pair_count) {
  const int warp = get_global_id(0), pair = get_global_id(1);
  if (warp >= THUMBNAIL_WARPS || pair >= pair_count) return;
  const int variant = warp / THUMBNAIL_SHIFTS, shift = warp % THUMBNAIL_SHIFTS;
  global const char* q = queries + (pairs[pair].x * THUMBNAIL_VARIANTS + variant) * COARSE_QUERY_BYTES +
                         (shift / 3) * COARSE_STRIDE + shift % 3;
  global const char* v = views + (size_t)pairs[pair].y * COARSE_VIEW_BYTES;
  int16 ssd = 0, energy = 0;
  for (int c = 0; c < 3; ++c) {
    for (int y = 0; y < COARSE_SIDE; ++y) {
      const int16 a = convert_int16(vload16(0, q + (c * COARSE_STRIDE + y) * COARSE_STRIDE));
      const int16 b = convert_int16(vload16(0, v + (c * COARSE_SIDE + y) * COARSE_SIDE));
      const int16 d = a - b;
      ssd += d * d;
      energy += a * a + b * b;
    }
  }
  scores[pair * THUMBNAIL_WARPS + warp] = quotient(sum16(ssd), sum16(energy));
}

// D at 32 x 32; q points to the pixel that corresponds to the first one of v.
inline float fine_distance(global const char* q, global const char* v, int* energy_out) {
  int16 ssd = 0, energy = 0;
  for (int row = 0; row < 3 * FINE_SIDE; ++row) {
    global const char* line = q + (row / FINE_SIDE * FINE_STRIDE + row % FINE_SIDE) * FINE_STRIDE;
    for (int part = 0; part < 2; ++part) {
      const int16 a = convert_int16(vload16(part, line));
      const int16 b = convert_int16(vload16(part, v + row * FINE_SIDE));
      const int16 d = a - b;
      ssd += d * d;
      energy += a * a + b * b;
    }
  }
  *energy_out = sum16(energy);
  return quotient(sum16(ssd), *energy_out);
}

inline int shifted_ssd(global const char* q, global const char* v) {
  int16 ssd = 0;
  for (int y = 0; y < FINE_SIDE; ++y) {
    for (int part = 0; part < 2; ++part) {
      int16 best = 0x7fffffff;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          int16 sum = 0;
          for (int c = 0; c < 3; ++c) {
            const int16 a = convert_int16(vload16(part, q + (c * FINE_STRIDE + y + dy) * FINE_STRIDE + dx));
            const int16 b = convert_int16(vload16(part, v + (c * FINE_SIDE + y) * FINE_SIDE));
            const int16 d = a - b;
            sum += d * d;
          }
          best = min(best, sum);
        }
      }
      ssd += best;
    }
  }
  return sum16(ssd);
}

// One work-item: one pair; global = (pairs). queries: [query][variant][3][40][40]; views: [view][3][32][32];
// distances: [pair].
kernel void refine_matches(global const char* queries, global const char* views, global const int2* pairs,
                           global const float* scores, global float* distances, const int pair_count) {
  const int pair = get_global_id(0);
  if (pair >= pair_count) return;
  int warp = 0;
  float smallest = scores[pair * THUMBNAIL_WARPS];
  for (int i = 1; i < THUMBNAIL_WARPS; ++i) {
    const float score = scores[pair * THUMBNAIL_WARPS + i];
    if (score < smallest) {
      smallest = score;
      warp = i;
    }
  }
  const int shift = warp % THUMBNAIL_SHIFTS;
  global const char* v = views + (size_t)pairs[pair].y * FINE_VIEW_BYTES;
  global const char* q = queries + (pairs[pair].x * THUMBNAIL_VARIANTS + warp / THUMBNAIL_SHIFTS) * FINE_QUERY_BYTES +
                         (FINE_RIM + 2 * (shift / 3 - 1)) * FINE_STRIDE + FINE_RIM + 2 * (shift % 3 - 1);
  smallest = MAXFLOAT;
  int offset = 0, energy = 0;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      int here;
      const float distance = fine_distance(q + dy * FINE_STRIDE + dx, v, &here);
      if (distance < smallest) {
        smallest = distance;
        offset = dy * FINE_STRIDE + dx;
        energy = here;
      }
    }
  }
  distances[pair] = quotient(shifted_ssd(q + offset, v), energy);
}
