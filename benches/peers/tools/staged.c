/* A grid staged by hand: each row has two constants, p and q, and the angles have tables. A width is the root of
   p along + q across (`_2`: two tables) or of p along + q (`_1`: a table of cos 2φ, near 0 no less than 0).

   With -DPAST_CACHES whole packs are stored past the caches, as a grid too large for them is best written. */
#include <immintrin.h>
#include <stdint.h>

#ifdef __AVX512F__
typedef __m512d pack;
#define LOAD _mm512_loadu_pd
#define SQRT _mm512_sqrt_pd
#define MAX _mm512_max_pd
#define ALL _mm512_set1_pd
#define STREAM _mm512_stream_pd
#else
typedef __m256d pack;
#define LOAD _mm256_loadu_pd
#define SQRT _mm256_sqrt_pd
#define MAX _mm256_max_pd
#define ALL _mm256_set1_pd
#define STREAM _mm256_stream_pd
#endif
#define LANES (sizeof(pack) / sizeof(double))

#ifdef PAST_CACHES
/* The loop `point` up to the first whole pack of the row and from its last one on; the packs between past the caches. */
#define ROW(point, packs)                                                                                              \
  size_t to = (sizeof(pack) - (uintptr_t)row % sizeof(pack)) % sizeof(pack) / sizeof(double), j = 0;                   \
  for (; j < m && j < to; j++) row[j] = point;                                                                         \
  for (; j + LANES <= m; j += LANES) STREAM(row + j, packs);                                                           \
  for (; j < m; j++) row[j] = point;
#define DONE _mm_sfence();
#else
#define ROW(point, packs)                                                                                              \
  _Pragma("omp simd") for (size_t j = 0; j < m; j++) row[j] = point;
#define DONE
#endif

void staged_grid_2(size_t n, size_t m, const double *restrict first, const double *restrict second,
                   const double *restrict along, const double *restrict across, double *restrict out) {
#pragma omp parallel for
  for (size_t i = 0; i < n; i++) {
    double p = first[i], q = second[i], *restrict row = out + i * m;
    ROW(sqrt(p * along[j] + q * across[j]), SQRT(ALL(p) * LOAD(along + j) + ALL(q) * LOAD(across + j)))
    DONE
  }
}

void staged_grid_1(size_t n, size_t m, const double *restrict first, const double *restrict second,
                   const double *restrict along, double *restrict out) {
#pragma omp parallel for
  for (size_t i = 0; i < n; i++) {
    double p = first[i], q = second[i], *restrict row = out + i * m;
    ROW(sqrt(fmax(p * along[j] + q, 0.0)), SQRT(MAX(ALL(p) * LOAD(along + j) + ALL(q), ALL(0.0))))
    DONE
  }
}

void staged_greatest_2(size_t n, size_t m, const double *restrict first, const double *restrict second,
                       const double *restrict along, const double *restrict across, double *restrict out) {
  for (size_t i = 0; i < n; i++) {
    double p = first[i], q = second[i], top = 0.0;
#pragma omp simd reduction(max : top)
    for (size_t j = 0; j < m; j++) {
      double square = p * along[j] + q * across[j];
      top = square > top ? square : top;
    }
    out[i] = sqrt(top);
  }
}

void staged_greatest_1(size_t n, size_t m, const double *restrict first, const double *restrict second,
                       const double *restrict along, double *restrict out) {
  for (size_t i = 0; i < n; i++) {
    double p = first[i], q = second[i], top = 0.0;
#pragma omp simd reduction(max : top)
    for (size_t j = 0; j < m; j++) {
      double square = p * along[j] + q;
      top = square > top ? square : top;
    }
    out[i] = sqrt(top);
  }
}
