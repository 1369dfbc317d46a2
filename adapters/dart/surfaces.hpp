// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Triangle meshes from both sides. What DART's narrow phases find at a mesh, measured with bodies on either side of it
// (plain_programs/dart/sides.cpp):
//     ode            boxes from both sides; balls, capsules and cylinders from the front alone; hulls from both, with
//                    normals through the surface from behind
//     fcl_primitive  balls and boxes from both sides; cylinders and hulls with normals through the surface from behind
//     fcl_mesh       everything with normals through the surface from behind
// So a mesh is given twice, the second time with its triangles reversed. Where normals may lead through the surface, those
// that push the middle of the other shape there are dropped, and with FCL, whose contacts name their triangle, all of
// triangles that the middle is behind: where a box covers such a triangle by less than its own height, the normal lies in
// the surface and would stop a box that slides.
#pragma once

#include <dart/collision/Contact.hpp>
#include <dart/dynamics/ShapeFrame.hpp>
#include <string>
#include <unordered_map>

namespace rigor::dart_adapter {

class Surfaces {
  public:
    explicit Surfaces(std::string narrowPhase) : narrowPhase_(std::move(narrowPhase)) {}

    void add(const dart::dynamics::ShapeFrame* mesh, bool back) { isBack_[mesh] = back; }
    /// False for the back of a mesh and a shape that this narrow phase finds from both sides of the front.
    bool mayMeet(const dart::dynamics::ShapeFrame* one, const dart::dynamics::ShapeFrame* two) const;
    /// False where a contact pushes the middle of a shape through a mesh, or is with a triangle that it is behind.
    bool pushesOut(const dart::collision::Contact& contact) const;

  private:
    bool findsBothSides(const dart::dynamics::ShapeFrame* of) const;
    bool findsWrongSide(const dart::dynamics::ShapeFrame* of) const;

    std::string narrowPhase_;
    std::unordered_map<const dart::dynamics::ShapeFrame*, bool> isBack_;
};

}  // namespace rigor::dart_adapter
