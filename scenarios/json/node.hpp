// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A JSON value together with its pointer. Getters check type, range and dimension; what is wrong becomes a
// Problem and a harmless default, so that one pass finds every mistake. The caller throws in the end; nothing
// half-loads.
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "scenarios/json/json_text.hpp"
#include "scenarios/model/math.hpp"

namespace rigor::scenario {

/// Larger magnitudes are mistakes, and overflow when squared in single precision.
inline constexpr double kLargestNumber = 1e15;

/// Data shared by the nodes of one file.
struct ReadContext {
    std::string file;
    const JsonDocument* document = nullptr;
    std::vector<Problem> problems;
    int dimension = 3;
    Vec3 gravity{};                                    ///< gravity of the scene, for generators [m/s^2]
    std::optional<int> size{};                         ///< size of the scene, for Node::scaled
    std::unordered_map<std::string, int> bodyIndex{};  ///< index of each body by its name, for readBodyName
    std::unordered_set<std::string> jointNames{};
};

class Node {
  public:
    Node(const Json& value, std::string pointer, ReadContext& context)
        : value_(&value), pointer_(std::move(pointer)), context_(&context) {}

    const Json& json() const { return *value_; }
    const std::string& pointer() const { return pointer_; }
    ReadContext& context() const { return *context_; }
    int dimension() const { return context_->dimension; }

    void problem(const std::string& id, const std::string& expected) const {
        problem(id, describe(*value_), expected);
    }
    void problem(const std::string& id, const std::string& found, const std::string& expected) const;

    /// True for an object whose keys are all among `keys`; reports otherwise (unknown keys are named one by
    /// one).
    bool isObject(std::initializer_list<const char*> keys) const;
    bool isArray() const;
    bool has(const char* key) const { return value_->is_object() && value_->contains(key); }
    Node operator[](const std::string& key) const;
    Node operator[](std::size_t index) const;
    std::optional<Node> find(const char* key) const;
    /// The member, or null (reported) when it is missing.
    std::optional<Node> require(const char* key) const;
    std::vector<Node> items() const;                            ///< elements of an array; anything else is
                                                                ///< reported as a problem
    std::vector<std::pair<std::string, Node>> members() const;  ///< members of an object; anything else is
                                                                ///< reported as a problem

    double number(double min, double max) const;
    double positive() const;
    /// Seconds from 1e-7 to 1: a number, or text as on the command line ("1/60").
    double timeStep() const;
    int integer(int min, int max) const;
    bool boolean() const;
    std::string text() const;
    /// A name: letters, digits and _ - . : not empty, at most 64 characters.
    std::string name() const;
    std::vector<std::string> texts() const;
    std::vector<double> numbers(std::size_t count) const;  ///< exactly `count` finite numbers
    /// [x, y, z] in 3D, [x, y] in 2D.
    Vec3 vector() const;
    Vec3 unitVector() const;
    /// A vector in 3D, a number about +z in 2D.
    Vec3 angularVector() const;

    /// A number, or {"size": f, "power": p, "plus": c}, which is f N^p + c with N the scene's size (power 1,
    /// plus 0 where not given). Its result must be within the range. (scaled.cpp)
    double scaled(double min, double max) const;
    /// The same, to the nearest whole number.
    int scaledInteger(int min, int max) const;
    /// A vector of such numbers.
    Vec3 scaledVector() const;

  private:
    std::optional<double> ofSize() const;  ///< the object's value; nothing (reported) where it has none

    const Json* value_;
    std::string pointer_;
    ReadContext* context_;
};

}  // namespace rigor::scenario
