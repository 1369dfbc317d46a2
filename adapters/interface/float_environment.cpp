// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/interface/float_environment.hpp"

#include <cfenv>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace rigor::adapter {
namespace {

constexpr std::uint32_t kSseRounding = 0x6000, kSseFlushToZero = 0x8000, kSseDenormalsAreZero = 0x0040,
                        kSseMasks = 0x1f80;
constexpr std::uint32_t kSseControl = kSseRounding | kSseFlushToZero | kSseDenormalsAreZero | kSseMasks;
constexpr std::uint16_t kX87Masks = 0x003f, kX87Precision = 0x0300, kX87Rounding = 0x0c00;

#if defined(__SSE2__)
std::uint32_t sseControl() {
    return _mm_getcsr() & kSseControl;
}
void setSseControl(std::uint32_t control) {
    _mm_setcsr((_mm_getcsr() & ~kSseControl) | control);
}
#else
std::uint32_t sseControl() {
    return 0;
}
void setSseControl(std::uint32_t) {}
#endif

#if defined(__x86_64__) || defined(__i386__)
std::uint16_t x87Control() {
    std::uint16_t word = 0;
    __asm__ volatile("fnstcw %0" : "=m"(word));
    return word & (kX87Masks | kX87Precision | kX87Rounding);
}
void setX87Control(std::uint16_t control) {
    std::uint16_t word = 0;
    __asm__ volatile("fnstcw %0" : "=m"(word));
    word = static_cast<std::uint16_t>((word & ~(kX87Masks | kX87Precision | kX87Rounding)) | control);
    __asm__ volatile("fnclex\n\tfldcw %0" : : "m"(word));
}
// The rounding of both units stands in their control words.
int rounding() {
    return 0;
}
void setRounding(int) {}
#else
std::uint16_t x87Control() {
    return 0;
}
void setX87Control(std::uint16_t) {}
int rounding() {
    return std::fegetround();
}
void setRounding(int direction) {
    std::fesetround(direction);
}
#endif

/// Direction of rounding by the two bits that both units use.
const char* directionName(std::uint32_t bits) {
    constexpr const char* kNames[] = {"rounds to nearest", "rounds downward", "rounds upward",
                                      "rounds towards zero"};
    return kNames[bits & 3u];
}

void add(std::string& text, const std::string& more) {
    text += (text.empty() ? "" : ", ") + more;
}

}  // namespace

FloatEnvironment::FloatEnvironment() : rounding_(rounding()), sse_(sseControl()), x87_(x87Control()) {}

std::string FloatEnvironment::restore() const {
    const std::uint32_t sse = sseControl();
    const std::uint16_t x87 = x87Control();
    const int direction = rounding();
    if (sse == sse_ && x87 == x87_ && direction == rounding_) return "";
    std::string found;
    const std::uint32_t changed = sse ^ sse_, changedX87 = static_cast<std::uint32_t>(x87 ^ x87_);
    if (changed & kSseRounding)
        add(found, directionName(sse >> 13));
    else if (changedX87 & kX87Rounding)
        add(found, std::string(directionName(x87 >> 10)) + " (x87)");
    if (direction != rounding_) add(found, "rounds otherwise");
    if (changed & kSseFlushToZero)
        add(found, sse & kSseFlushToZero ? "flushes denormals" : "makes denormals");
    if (changed & kSseDenormalsAreZero)
        add(found, sse & kSseDenormalsAreZero ? "reads denormals as zero" : "reads denormals");
    if (changedX87 & kX87Precision) add(found, "another precision (x87)");
    if ((changed & kSseMasks) != 0 || (changedX87 & kX87Masks) != 0) add(found, "other traps");
    setX87Control(x87_);
    setSseControl(sse_);
    setRounding(rounding_);
    return found;
}

}  // namespace rigor::adapter
