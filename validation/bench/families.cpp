// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/bench/timed_work.hpp"

namespace rigor::validation {

#define BENCH_FAMILY(name, plan, make, title)                    \
    std::vector<PlannedBench> plan(const BenchRequest& request); \
    std::unique_ptr<TimedWork> make(const PlannedBench& planned);
#include "validation/bench/families.def"
#undef BENCH_FAMILY

const std::vector<BenchFamily>& benchFamilies() {
#define BENCH_FAMILY(name, plan, make, title) {#name, title, plan, make},
    static const std::vector<BenchFamily> table{
#include "validation/bench/families.def"
    };
#undef BENCH_FAMILY
    return table;
}

}  // namespace rigor::validation
