#pragma once

namespace cpslam {

/// Instruction sets the pixel kernels are compiled for. The baseline is whatever the compiler targets anyway;
/// both give the same results to the bit.
enum class Simd { kBaseline, kAvx2 };

#if defined(__GNUC__) && defined(__x86_64__)
#define CPSLAM_TARGET_AVX2 __attribute__((target("avx2")))
[[nodiscard]] inline bool cpu_has_avx2() {
  return __builtin_cpu_supports("avx2") != 0;
}
[[nodiscard]] inline bool cpu_has_popcnt() {
  return __builtin_cpu_supports("popcnt") != 0;
}
#define CPSLAM_TARGET_POPCNT __attribute__((target("popcnt")))
#else
#define CPSLAM_TARGET_AVX2
#define CPSLAM_TARGET_POPCNT
[[nodiscard]] inline bool cpu_has_avx2() {
  return false;
}
[[nodiscard]] inline bool cpu_has_popcnt() {
  return false;
}
#endif

/// A kernel is one always-inlined function of plain loops; a wrapper per instruction set makes the compiler
/// vectorise its own copy. Unlike files compiled with -mavx2, no inline function of a header can leak out.
#define CPSLAM_KERNEL __attribute__((always_inline)) inline

[[nodiscard]] inline Simd best_simd() {
  return cpu_has_avx2() ? Simd::kAvx2 : Simd::kBaseline;
}

}  // namespace cpslam
