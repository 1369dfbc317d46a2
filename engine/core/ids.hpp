// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Stable handles. A handle names an object for its whole life; the dense index behind it may change when
// other objects are removed, and a stale handle never names a newer object.
#pragma once

#include <cstdint>
#include <type_traits>
#include <vector>

namespace rigor::engine {

/// Index that refers to no element of an array.
inline constexpr std::uint32_t kNullIndex = 0xffffffffu;

/// index 0 is "none" (for bodies: the world); the generation distinguishes re-used slots.
template <class Tag>
struct Id {
    std::uint32_t index = 0;
    std::uint32_t generation = 0;
    explicit operator bool() const { return index != 0; }
    friend bool operator==(const Id&, const Id&) = default;
};
struct BodyTag {
    static constexpr const char* kName = "body";
};
struct ShapeTag {
    static constexpr const char* kName = "shape";
};
struct JointTag {
    static constexpr const char* kName = "joint";
};
struct ForceTag {
    static constexpr const char* kName = "force";
};
using BodyId = Id<BodyTag>;
using ShapeId = Id<ShapeTag>;
using JointId = Id<JointTag>;
using ForceId = Id<ForceTag>;

/// A handle that names nothing in a table, and what the table has in its slot.
struct UnknownHandle {
    const char* kind;
    std::uint32_t index, generation;
    std::uint32_t slots;           ///< slots of the table, with that of "none"
    std::uint32_t slotGeneration;  ///< generation that the slot is at; 0 where there is no such slot
    bool taken;                    ///< another object has the slot
};
/// Throws EngineError "null_handle" for index 0, else "stale_handle": the message says which handle it is, and whether
/// its object was removed or never was in this world.
[[noreturn]] void throwUnknownHandle(const UnknownHandle& handle);

/// Handle -> dense index. The order of the free list is part of the state: two copies give out equal handles.
template <class Tag>
class IdTable {
  public:
    IdTable() : slots_(1) {}

    Id<Tag> add(std::uint32_t dense) {
        std::uint32_t index = freeHead_;
        if (index != 0) {
            freeHead_ = slots_[index].dense;
        } else {
            index = static_cast<std::uint32_t>(slots_.size());
            slots_.emplace_back();
        }
        slots_[index].dense = dense;
        slots_[index].alive = true;
        return {index, slots_[index].generation};
    }
    bool contains(Id<Tag> id) const {
        return id.index != 0 && id.index < slots_.size() && slots_[id.index].alive &&
               slots_[id.index].generation == id.generation;
    }
    /// Throws EngineError "null_handle" or "stale_handle" where contains() is false; so do move() and remove().
    std::uint32_t dense(Id<Tag> id) const {
        requireKnown(id);
        return slots_[id.index].dense;
    }
    void move(Id<Tag> id, std::uint32_t dense) {
        requireKnown(id);
        slots_[id.index].dense = dense;
    }
    void remove(Id<Tag> id) {
        requireKnown(id);
        Slot& slot = slots_[id.index];
        slot.alive = false;
        ++slot.generation;
        slot.dense = freeHead_;
        freeHead_ = id.index;
    }

    /// Shows `archive` everything there is to the table (state/archive.hpp); Table may be const.
    template <class Archive, class Table>
    static void visit(Archive& archive, Table& table) {
        table.visitSlots([&](auto& slots, auto& freeHead) {
            const std::size_t count = archive.size(slots.size());
            if constexpr (!std::is_const_v<Table>) slots.resize(count);
            for (auto& slot : slots) {
                archive.scalar(slot.dense);
                archive.scalar(slot.generation);
                archive.scalar(slot.alive);
            }
            archive.scalar(freeHead);
        });
    }
    /// False for what only damaged bytes can make of a table.
    bool sound() const {
        if (slots_.empty() || freeHead_ >= slots_.size()) return false;
        for (const Slot& slot : slots_)
            if (!slot.alive && slot.dense >= slots_.size()) return false;
        return true;
    }

  private:
    void requireKnown(Id<Tag> id) const {
        if (contains(id)) [[likely]]
            return;
        const bool exists = id.index < slots_.size();
        const Slot slot = exists ? slots_[id.index] : Slot{};
        throwUnknownHandle({Tag::kName, id.index, id.generation, static_cast<std::uint32_t>(slots_.size()),
                            slot.generation, slot.alive});
    }
    template <class F>
    void visitSlots(F f) {
        f(slots_, freeHead_);
    }
    template <class F>
    void visitSlots(F f) const {
        f(slots_, freeHead_);
    }
    struct Slot {
        std::uint32_t dense = 0;  ///< alive: dense index; free: next free slot
        std::uint32_t generation = 0;
        bool alive = false;
    };
    std::vector<Slot> slots_;
    std::uint32_t freeHead_ = 0;
};

}  // namespace rigor::engine
