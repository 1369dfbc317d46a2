// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/interface/missing.hpp"

#include <algorithm>

namespace rigor::adapter {
namespace {

using scenario::JointType;

std::vector<std::string> shapesOf(int dimension) {
    std::vector<Geometry> geometries{scenario::Sphere{}, scenario::Box{}, scenario::Capsule{},
                                     scenario::ConvexHull{}, scenario::HalfSpace{}};
    if (dimension == 2)
        geometries.insert(geometries.end(), {scenario::Segment{}, scenario::Chain{}});
    else
        geometries.insert(geometries.end(), {scenario::Cylinder{}, scenario::Cone{}, scenario::TriangleMesh{},
                                             scenario::HeightField{}, scenario::Ellipsoid{}});
    std::vector<std::string> names;
    for (const Geometry& geometry : geometries) names.emplace_back(geometryName(geometry, dimension));
    return names;
}

std::vector<std::string> jointsOf(int dimension) {
    std::vector<std::string> names;
    for (const JointType type :
         {JointType::Ball, JointType::Hinge, JointType::Slider, JointType::Fixed, JointType::Distance,
          JointType::ConeTwist, JointType::SixDof, JointType::Wheel}) {
        const bool only3d = type == JointType::Ball || type == JointType::ConeTwist;
        if (dimension == 2 && only3d) continue;
        const std::string name = jointName(type);
        names.push_back(name);
        if (scenario::jointAxisName(type, dimension, 0) != nullptr)
            for (const char* feature : {".limit", ".motor", ".spring"})
                if (type != JointType::Ball || feature != std::string(".motor"))
                    names.push_back(name + feature);
        names.push_back(name + ".break");
    }
    return names;
}

}  // namespace

std::vector<std::string> notInAdapterYet(const Capabilities& capabilities) {
    std::vector<std::string> missing;
    const auto look = [&](const std::vector<std::string>& requested, const std::vector<std::string>& known) {
        for (const std::string& name : requested) {
            const auto has = [&](const std::vector<std::string>& names) {
                return std::find(names.begin(), names.end(), name) != names.end();
            };
            const std::string type = name.substr(0, name.find('.'));
            if (!has(known) && !has(missing) && !capabilities.libraryLacks.contains(name) &&
                !capabilities.libraryLacks.contains(type))
                missing.push_back(name);
        }
    };
    for (const int dimension : {2, 3}) {
        const auto& native = capabilities.dimensions;
        const bool runs = std::find(native.begin(), native.end(), dimension) != native.end() ||
                          (dimension == 2 && capabilities.planar);
        if (!runs) continue;
        if (capabilities.dynamics || capabilities.collision) look(shapesOf(dimension), capabilities.shapes);
        if (capabilities.dynamics) look(jointsOf(dimension), capabilities.joints);
    }
    return missing;
}

}  // namespace rigor::adapter
