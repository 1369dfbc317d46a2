// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The floating-point environment of a thread: direction of rounding, treatment of denormals, precision of the x87 unit,
// traps. Metrics and the exact oracle are computed in the process that a module runs in, and a module may change it: by
// a call, or by being loaded (libraries linked with -ffast-math flush denormals from then on).
#pragma once

#include <cstdint>
#include <string>

namespace rigor::adapter {

class FloatEnvironment {
  public:
    FloatEnvironment();  ///< as it is now

    /// Puts it back where it has changed. Returns what had become of it ("rounds upward"), "" if nothing had.
    std::string restore() const;

  private:
    int rounding_;
    std::uint32_t sse_ = 0;  ///< control bits of MXCSR
    std::uint16_t x87_ = 0;  ///< control word
};

/// Puts the environment back at the end of a block.
class KeepFloatEnvironment {
  public:
    KeepFloatEnvironment() = default;
    ~KeepFloatEnvironment() { (void)before_.restore(); }
    KeepFloatEnvironment(const KeepFloatEnvironment&) = delete;
    KeepFloatEnvironment& operator=(const KeepFloatEnvironment&) = delete;

  private:
    FloatEnvironment before_;
};

}  // namespace rigor::adapter
