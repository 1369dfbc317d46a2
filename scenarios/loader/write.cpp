// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "scenarios/loader/write.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

namespace rigor::scenario {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kNever = 1e299;  ///< limits and strengths beyond it are none
constexpr double kLatest = 1e6;   ///< [s] largest time that a file can name

class Writer {
  public:
    explicit Writer(const Scenario& scenario) : s_(scenario), solid_(scenario.dimension == 3) {}

    Json write() const {
        Json out{{"rigor", 1},
                 {"name", s_.name},
                 {"title", s_.title},
                 {"description", s_.description},
                 {"source", s_.source},
                 {"isolates", s_.isolates},
                 {"tags", s_.tags},
                 {"dimension", s_.dimension},
                 {"gravity", vector(s_.gravity)},
                 {"duration", s_.duration},
                 {"dt", s_.timeSteps},
                 {"time_limit", s_.timeLimit},
                 {"materials", materials()},
                 {"pairs", pairs()},
                 {"bodies", Json::array()},
                 {"joints", Json::array()},
                 {"forces", Json::array()},
                 {"events", Json::array()},
                 {"observe", Json::array()}};
        for (const Body& b : s_.bodies) out["bodies"].push_back(body(b));
        for (const Joint& j : s_.joints) out["joints"].push_back(joint(j));
        for (const Force& f : s_.forces)
            out["forces"].push_back(std::visit([this](const auto& one) { return force(one); }, f));
        for (const Event& e : s_.events)
            out["events"].push_back({{"time", e.time},
                                     {"body", bodyName(e.body)},
                                     {"impulse", vector(e.impulse)},
                                     {"angular_impulse", angular(e.angularImpulse)}});
        for (const int b : s_.observed) out["observe"].push_back(bodyName(b));
        if (!s_.layers.empty()) out["layers"] = std::vector(s_.layers.begin() + 1, s_.layers.end());
        if (s_.size) out["size"] = *s_.size;
        if (s_.bench) out["bench"] = bench(*s_.bench);
        return out;
    }

  private:
    Json vector(const Vec3& v) const { return solid_ ? Json{v.x, v.y, v.z} : Json{v.x, v.y}; }
    Json angular(const Vec3& v) const { return solid_ ? vector(v) : Json(v.z); }
    std::string bodyName(int index) const { return index == kNone ? "world" : s_.bodies[index].name; }
    const std::string& materialName(int index) const { return s_.materials[index].name; }
    Json points(const std::vector<Vec3>& list) const {
        Json out = Json::array();
        for (const Vec3& p : list) out.push_back(vector(p));
        return out;
    }
    void pose(Json& out, const Pose& pose) const {
        out["position"] = vector(pose.position);
        const Quat& q = pose.orientation;
        if (solid_)
            out["orientation"] = {q.w, q.x, q.y, q.z};
        else
            // angles may exceed a turn: q and -q are distinguished
            out["angle"] = 2.0 * std::atan2(q.z, q.w);
    }

    template <class Surface>
    static Json coefficients(const Surface& m) {
        Json out{{"friction", m.friction}, {"restitution", m.restitution}};
        if (m.staticFriction > 0.0) out["static_friction"] = m.staticFriction;
        if (m.rollingFriction > 0.0) out["rolling_friction"] = m.rollingFriction;
        if (m.torsionalFriction > 0.0) out["torsional_friction"] = m.torsionalFriction;
        return out;
    }
    static Json bench(const BenchPlan& plan) {
        Json quality = Json::object();
        for (const QualityBound& bound : plan.quality) {
            Json range = Json::object();
            if (std::isfinite(bound.min)) range["min"] = bound.min;
            if (std::isfinite(bound.max)) range["max"] = bound.max;
            quality[std::string(nameOf(bound.quantity).key)] = range;
        }
        Json out{{"warm_up_steps", plan.warmUpSteps},
                 {"timed_steps", plan.timedSteps},
                 {"quality_step", plan.qualityStep}};
        if (!plan.sizes.empty()) out["sizes"] = plan.sizes;
        out["quality"] = quality;
        return out;
    }
    Json materials() const {
        Json out = Json::object();
        for (const Material& m : s_.materials) {
            out[m.name] = coefficients(m);
            out[m.name]["density"] = m.density;
        }
        return out;
    }
    Json pairs() const {
        Json out = Json::array();
        for (const MaterialPair& p : s_.pairs) {
            Json one = coefficients(p);
            one["a"] = materialName(p.a);
            one["b"] = materialName(p.b);
            out.push_back(std::move(one));
        }
        return out;
    }

    // ------------------------------------------------------------------------------------------ bodies
    Json geometry(const Sphere& g) const { return {{"radius", g.radius}}; }
    Json geometry(const Box& g) const { return {{"half_extents", vector(g.halfExtents)}}; }
    Json geometry(const Ellipsoid& g) const { return {{"half_axes", vector(g.halfAxes)}}; }
    Json geometry(const Capsule& g) const { return round(g); }
    Json geometry(const Cylinder& g) const { return round(g); }
    Json geometry(const Cone& g) const { return round(g); }
    Json geometry(const ConvexHull& g) const { return {{"vertices", points(g.vertices)}}; }
    Json geometry(const HalfSpace& g) const { return {{"normal", vector(g.normal)}, {"offset", g.offset}}; }
    Json geometry(const Segment& g) const { return {{"a", vector(g.a)}, {"b", vector(g.b)}}; }
    Json geometry(const Chain& g) const { return {{"vertices", points(g.vertices)}, {"loop", g.loop}}; }
    Json geometry(const TriangleMesh& g) const {
        return {{"vertices", points(g.vertices)}, {"triangles", g.triangles}};
    }
    Json geometry(const HeightField& g) const {
        Json rows = Json::array();
        for (int k = 0; k < g.rows; ++k) {
            const auto first = g.heights.begin() + static_cast<std::ptrdiff_t>(k) * g.columns;
            rows.push_back(std::vector<double>(first, first + g.columns));
        }
        return {{"spacing", {g.spacingX, g.spacingZ}}, {"heights", rows}, {"thickness", g.thickness}};
    }
    template <class Round>
    static Json round(const Round& g) {
        return {{"radius", g.radius}, {"half_length", g.halfLength}};
    }
    Json shape(const Shape& s) const {
        Json out;
        out[geometryName(s.geometry, s_.dimension)] =
            std::visit([this](const auto& g) { return geometry(g); }, s.geometry);
        out["material"] = materialName(s.material);
        pose(out, s.pose);
        if (s.surfaceVelocity.moves())
            out["surface_velocity"] = {{"linear", vector(s.surfaceVelocity.linear)},
                                       {"angular", angular(s.surfaceVelocity.angular)}};
        filter(out, s.filter);
        return out;
    }
    Json layerNames(std::uint32_t bits) const {
        Json names = Json::array();
        for (std::size_t k = 0; k < s_.layers.size(); ++k)
            if ((bits >> k) & 1U) names.push_back(s_.layers[k]);
        return names;
    }
    void filter(Json& out, const ContactFilter& f) const {
        if (f.layers != ContactFilter{}.layers) out["layers"] = layerNames(f.layers);
        if (f.collidesWith != kAllLayers) out["collides_with"] = layerNames(f.collidesWith);
        if (f.group != 0) out["group"] = f.group;
    }
    static const char* typeName(BodyType type) {
        if (type == BodyType::Static) return "static";
        return type == BodyType::Kinematic ? "kinematic" : "dynamic";
    }
    Json body(const Body& b) const {
        Json out{{"name", b.name}, {"type", typeName(b.type)}};
        pose(out, b.pose);
        if (b.type != BodyType::Static) {
            out["velocity"] = vector(b.velocity);
            out["angular_velocity"] = angular(b.angularVelocity);
        }
        if (b.type == BodyType::Dynamic) {
            const MassProperties& m = b.massProperties;
            out["mass"] = m.mass;
            out["center_of_mass"] = vector(m.centerOfMass);
            out["inertia"] = solid_ ? Json(m.inertia.m) : Json(m.inertia(2, 2));
        }
        out["shapes"] = Json::array();
        for (const Shape& s : b.shapes) out["shapes"].push_back(shape(s));
        out["collides"] = b.collides;
        out["gravity_scale"] = b.gravityScale;
        out["damping"] = {{"linear_kept_per_second", b.linearVelocityKept},
                          {"angular_kept_per_second", b.angularVelocityKept}};
        return out;
    }

    // ------------------------------------------------------------------------------------------ joints
    /// "limits", "motor" and "spring" of one coordinate.
    static Json control(const Joint& j, const JointAxis& axis, const std::string& name) {
        const bool angle = name != "x" && name != "y" && name != "z" && name != "travel" && name != "length";
        Json out = Json::object();
        const auto end = [](double value) { return std::abs(value) < kNever ? Json(value) : Json(nullptr); };
        if (axis.mode == AxisMode::Limited) out["limits"] = {end(axis.lower), end(axis.upper)};
        if (axis.hasMotor())
            out["motor"] = {{"speed", axis.motorSpeed},
                            {angle ? "max_torque" : "max_force", axis.motorMaxForce}};
        if (!axis.hasSpring()) return out;
        Json& spring = out["spring"];
        if (axis.frequency > 0.0)
            spring = {{"frequency", axis.frequency}, {"damping_ratio", axis.dampingRatio}};
        else
            spring = {{"stiffness", axis.stiffness}, {"damping", axis.damping}};
        if (axis.target != 0.0 || j.type == JointType::Distance) spring["target"] = axis.target;
        return out;
    }
    void axes(Json& out, const Joint& j) const {
        const bool single = jointAxisName(j.type, s_.dimension, 0) != nullptr &&
                            jointAxisName(j.type, s_.dimension, 1) == nullptr && j.type != JointType::Ball;
        if (single) {
            const Json one = control(j, j.axes[0], jointAxisName(j.type, s_.dimension, 0));
            for (const auto& [key, value] : one.items()) out[key] = value;
            return;
        }
        Json list = Json::object();
        for (std::size_t k = 0; const char* name = jointAxisName(j.type, s_.dimension, k); ++k) {
            const Json one = control(j, j.axes[k], name);
            if (!one.empty())
                list[name] = one;
            else if (j.type == JointType::SixDof && j.axes[k].mode == AxisMode::Free)
                list[name] = "free";
            else if (j.type == JointType::SixDof && j.axes[k].mode == AxisMode::Locked)
                list[name] = "locked";
        }
        if (!list.empty()) out["axes"] = list;
    }
    Quat orientationOf(int index) const {
        return index == kNone ? Quat{} : s_.bodies[index].pose.orientation;
    }
    Json joint(const Joint& j) const {
        Json out{{"name", j.name},
                 {"type", jointName(j.type)},
                 {"a", bodyName(j.bodyA)},
                 {"b", bodyName(j.bodyB)},
                 {"anchor_a", vector(j.anchorA)},
                 {"anchor_b", vector(j.anchorB)},
                 {"collide_connected", j.collideConnected}};
        if (j.type == JointType::Distance) out["length"] = j.length;
        const bool cone = j.type == JointType::Ball && j.axes[0].mode != AxisMode::Usual;
        const bool directed = j.type == JointType::Slider || j.type == JointType::Wheel ||
                              j.type == JointType::SixDof || j.type == JointType::ConeTwist || cone ||
                              (j.type == JointType::Hinge && solid_);
        if (directed) out["axis"] = vector(rotate(orientationOf(j.bodyA), j.axisA));
        if (solid_ && j.type == JointType::SixDof)
            out["normal"] = vector(rotate(orientationOf(j.bodyA), j.normalA));
        if (solid_ && j.type == JointType::Wheel)
            out["spin_axis"] = vector(rotate(orientationOf(j.bodyB), j.spinAxisB));
        if (j.breakForce < kNever) out["break_force"] = j.breakForce;
        if (j.breakTorque < kNever) out["break_torque"] = j.breakTorque;
        axes(out, j);
        return out;
    }

    // ------------------------------------------------------------------------------------------ forces
    Json force(const ConstantForce& f) const {
        Json out{{"body", bodyName(f.body)},
                 {"force", vector(f.force)},
                 {"torque", angular(f.torque)},
                 {"start", f.start}};
        if (f.end <= kLatest) out["end"] = f.end;
        return {{"constant", out}};
    }
    Json force(const SpringForce& f) const {
        return {{"spring",
                 {{"a", bodyName(f.bodyA)},
                  {"b", bodyName(f.bodyB)},
                  {"anchor_a", vector(f.anchorA)},
                  {"anchor_b", vector(f.anchorB)},
                  {"stiffness", f.stiffness},
                  {"damping", f.damping},
                  {"rest_length", f.restLength}}}};
    }
    Json force(const DragForce& f) const {
        return {{"drag",
                 {{"body", bodyName(f.body)}, {"coefficient", f.coefficient}, {"quadratic", f.quadratic}}}};
    }

    const Scenario& s_;
    bool solid_;
};

}  // namespace

std::string scenarioText(const Scenario& scenario) {
    return Writer(scenario).write().dump(1) + "\n";
}

}  // namespace rigor::scenario
