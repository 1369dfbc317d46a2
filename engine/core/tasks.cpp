// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/core/tasks.hpp"

#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <exception>
#include <mutex>
#include <numeric>
#include <utility>
#include <vector>

#include "engine/core/stages.hpp"

namespace rigor::engine {
namespace {

/// The parts of a share of a range that nobody has taken, [next, end), in one number, so that whoever takes a
/// part knows of which range it is: [range 24 | end 20 | next 20]. Both ends move by one for everybody who
/// comes too late, up to kLate.
constexpr std::uint64_t kPartBits = 20, kLate = 4096, kMostParts = (1u << kPartBits) - 2 * kLate;
constexpr std::uint64_t kTakeNext = 1, kTakeLast = -(std::uint64_t(1) << kPartBits);  // to be added
constexpr std::uint64_t tickets(std::uint64_t range, std::uint64_t first, std::uint64_t end) {
    return range << (2 * kPartBits) | (end + kLate) << kPartBits | (first + kLate);
}
constexpr std::size_t fieldOf(std::uint64_t tickets) {
    return (tickets & ((1u << kPartBits) - 1)) - kLate;
}
constexpr std::size_t nextOf(std::uint64_t tickets) {
    return fieldOf(tickets);
}
constexpr std::size_t endOf(std::uint64_t tickets) {
    return fieldOf(tickets >> kPartBits);
}

}  // namespace

/// An arena of its own keeps a world from borrowing threads that another one was given. While somebody has
/// entered, its threads stay together and look for parts of the next range: to send for them anew, with
/// parallel_for, costs more than most ranges of a step. Each thread has a share of every range, about the
/// same for ranges of the same size, so that it finds what it worked on last time in its own cache; who is
/// ready with his own takes parts of the others', from their end, which moves little from range to range.
struct Tasks::Arena {
    using Work = std::function<void(std::size_t, std::size_t)>;

    explicit Arena(int threads)
        : arena(threads),
          stages(static_cast<std::size_t>(threads)),
          before(static_cast<std::size_t>(threads)),
          shares_(static_cast<std::size_t>(threads)) {
        weigh();
    }

    void weigh() {
        const std::vector<double>& weights = stages.weights();
        std::exclusive_scan(weights.begin(), weights.end(), before.begin(), 0.0);
    }
    void enter(const std::function<void()>& work);
    void share(std::size_t n, std::size_t part, const Work& work);
    bool inPart() const { return working == this; }

    oneapi::tbb::task_arena arena;
    Stages stages;
    std::vector<double> before;  ///< parts of the work that belong before each share
    bool entered = false;

    /// Works on a part while it lives.
    struct Inside {
        explicit Inside(const Arena* arena) : before(std::exchange(working, arena)) {}
        ~Inside() { working = before; }
        Inside(const Inside&) = delete;
        Inside& operator=(const Inside&) = delete;
        const Arena* before;
    };

  private:
    struct alignas(64) Share {
        std::atomic<std::uint64_t> tickets{0};
    };
    /// The first part of a share, or of what follows the last one.
    std::size_t firstPart(std::size_t share) const {
        if (share == shares_.size()) return parts_;
        return static_cast<std::size_t>(static_cast<double>(parts_) * before[share] + 0.5);
    }
    void stay(std::size_t self);
    /// What a thread that keeps company is sent with; named for cmake/tsan.supp.
    struct Companion {
        Arena* arena;
        std::size_t self;
        void operator()() const { arena->stay(self); }
    };
    bool takeParts(std::size_t self);
    void run(std::size_t part);

    static thread_local const Arena* working;  ///< on a part of this one

    std::vector<Share> shares_;
    std::atomic<bool> together_{false};
    alignas(64) std::atomic<std::size_t> done_{0};
    // --- of the range that is shared; read by those who have taken a part of it
    alignas(64) const Work* work_ = nullptr;
    std::size_t n_ = 0, size_ = 0, parts_ = 0;  ///< indices, of a part; parts
    std::uint64_t range_ = 0;
    std::mutex failing_;
    std::exception_ptr error_;
};

thread_local const Tasks::Arena* Tasks::Arena::working = nullptr;

void Tasks::Arena::enter(const std::function<void()>& work) {
    if (inPart() || entered) return work();
    weigh();
    arena.execute([&] {
        oneapi::tbb::task_group others;
        entered = together_ = true;
        for (std::size_t i = 1; i < shares_.size(); ++i) others.run(Companion{this, i});
        const auto leave = [&] {
            entered = together_ = false;
            others.wait();
        };
        try {
            work();
        } catch (...) {
            leave();
            throw;
        }
        leave();
    });
}

void Tasks::Arena::stay(std::size_t self) {
    for (int waits = 0; together_.load(std::memory_order_acquire); ++waits)
        if (stages.help(self) || takeParts(self))
            waits = 0;
        else
            pauseThread(waits);
}

void Tasks::Arena::share(std::size_t n, std::size_t size, const Work& work) {
    size_ = std::max<std::size_t>({size, 1, n / kMostParts + 1});
    n_ = n;
    parts_ = (n_ + size_ - 1) / size_;
    work_ = &work;
    error_ = nullptr;
    done_.store(0, std::memory_order_relaxed);
    ++range_;
    for (std::size_t k = 0; k < shares_.size(); ++k)
        shares_[k].tickets.store(tickets(range_, firstPart(k), firstPart(k + 1)), std::memory_order_release);
    takeParts(0);
    for (int waits = 0; done_.load(std::memory_order_acquire) < parts_; ++waits) pauseThread(waits);
    if (error_) std::rethrow_exception(error_);
}

bool Tasks::Arena::takeParts(std::size_t self) {
    bool some = false;
    for (std::size_t k = 0; k < shares_.size(); ++k) {
        const std::size_t share = (self + k) % shares_.size();
        std::atomic<std::uint64_t>& left = shares_[share].tickets;
        std::size_t done = 0;  // told at once: until then the range is the same
        for (;;) {
            std::uint64_t now = left.load(std::memory_order_relaxed);
            if (nextOf(now) >= endOf(now)) break;
            // The range may be another one by now: this says which part, and keeps its range from ending.
            now = left.fetch_add(share == self ? kTakeNext : kTakeLast, std::memory_order_acq_rel);
            if (nextOf(now) >= endOf(now)) break;
            run(share == self ? nextOf(now) : endOf(now) - 1);
            ++done;
        }
        if (done == 0) continue;
        done_.fetch_add(done, std::memory_order_release);
        some = true;
    }
    return some;
}

void Tasks::Arena::run(std::size_t part) {
    const Inside inside(this);
    try {
        (*work_)(part * size_, std::min(n_, (part + 1) * size_));
    } catch (...) {
        const std::lock_guard lock(failing_);
        if (!error_) error_ = std::current_exception();
    }
}

Tasks::Tasks(int threads)
    : threads_(threads), arena_(threads > 1 ? std::make_unique<Arena>(threads) : nullptr) {}
Tasks::Tasks(const Tasks& other) : Tasks(other.threads_) {}
Tasks& Tasks::operator=(const Tasks& other) {
    if (this != &other) *this = Tasks(other);
    return *this;
}
Tasks::Tasks(Tasks&&) noexcept = default;
Tasks& Tasks::operator=(Tasks&&) noexcept = default;
Tasks::~Tasks() = default;

const Tasks& Tasks::one() {
    static const Tasks tasks(1);
    return tasks;
}

void Tasks::shared(std::size_t n, std::size_t grain,
                   const std::function<void(std::size_t, std::size_t)>& work) const {
    if (arena_->inPart()) return work(0, n);
    // A few parts for each thread even out what they cost; more only cost themselves.
    constexpr std::size_t kPartsPerThread = 4;
    const std::size_t part = std::max(grain / 2, n / (kPartsPerThread * static_cast<std::size_t>(threads_)));
    const auto share = [&] { arena_->share(n, part, work); };
    arena_->enter(std::cref(share));
}

void Tasks::sharedStages(std::size_t count, const std::function<void(std::size_t, std::size_t)>& work) const {
    const Stages::Work part = [&](std::size_t stage, std::size_t share) {
        const Arena::Inside inside(arena_.get());
        work(stage, share);
    };
    const auto all = [&] {
        if (!arena_->inPart()) return arena_->stages.run(count, part);
        for (std::size_t stage = 0; stage < count; ++stage)
            for (std::size_t share = 0; share < static_cast<std::size_t>(threads_); ++share)
                work(stage, share);
    };
    arena_->enter(std::cref(all));
}

double Tasks::before(std::size_t share) const {
    return share == 0 ? 0.0 : share >= static_cast<std::size_t>(threads_) ? 1.0 : arena_->before[share];
}

void Tasks::entered(const std::function<void()>& work) const {
    arena_->enter(work);
}

}  // namespace rigor::engine
