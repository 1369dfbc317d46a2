// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/narrowphase/narrowphases.hpp"

#include <cstring>

#include "engine/core/error.hpp"

namespace rigor::engine {
namespace {

template <class S>
class TableNarrowPhase final : public NarrowPhase<S> {
  public:
    explicit TableNarrowPhase(CollideFunction<S> function) : function_(function) {}
    void collide(const Shape<S>& a, const Pose<S>& Xa, const Shape<S>& b, const Pose<S>& Xb,
                 typename S::Real speculativeDistance, Manifold<S>& out) const override {
        function_(a, Xa, b, Xb, speculativeDistance, out);
    }
    bool manyThreads() const override { return true; }

  private:
    CollideFunction<S> function_;
};

}  // namespace

std::span<const NarrowPhaseEntry> narrowPhases() {
    static constexpr NarrowPhaseEntry kTable[] = {
#define ALGORITHM(name, function, summary) {#name, summary},
#include "engine/narrowphase/narrowphases.def"
    };
    return kTable;
}

template <class S>
CollideFunction<S> findNarrowPhase(const char* name) {
#define ALGORITHM(entry, function, summary) \
    if (std::strcmp(name, #entry) == 0) return &function<S>;
#include "engine/narrowphase/narrowphases.def"
    return nullptr;
}

template <class S>
std::shared_ptr<const NarrowPhase<S>> makeNarrowPhase(const std::string& name) {
    if (const CollideFunction<S> function = findNarrowPhase<S>(name.c_str()))
        return std::make_shared<TableNarrowPhase<S>>(function);
    std::string known;
    for (const NarrowPhaseEntry& entry : narrowPhases())
        known += (known.empty() ? "" : ", ") + std::string(entry.name);
    throw EngineError("unknown_algorithm", "narrow_phase \"" + name + "\", known: " + known);
}

#define INSTANTIATE(S)                                        \
    template CollideFunction<S> findNarrowPhase(const char*); \
    template std::shared_ptr<const NarrowPhase<S>> makeNarrowPhase(const std::string&);
RIGOR_FOR_ALL_SPACES(INSTANTIATE)
#undef INSTANTIATE

}  // namespace rigor::engine
