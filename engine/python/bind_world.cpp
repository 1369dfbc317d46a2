// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/python/any_batch.hpp"

namespace rigor::engine::python {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

constexpr const char* kWorld = R"(A world of rigid bodies in the in-house engine.

    World("box_stack", "rigor:solver=nsgs")          a scenario (a name of the library, a file, or a dictionary) and a spec
    World(dimension=3, gravity=(0, -9.81, 0))        an empty world, to be built by add_body, add_shape, add_joint

Units are SI, angles in radians. Vectors have as many numbers as the dimension; in 2D angular velocities, torques and
orientations are one number about +z. Positions are those of the body frame's origin in the world frame; orientations turn the
body's axes into the world's (unit quaternion w, x, y, z; 2D: angle); velocities are those of the centre of mass, angular
velocities in the world frame.

Bodies, shapes, joints and materials are named by the number in which they were added, bodies, joints and materials also by
their names. A copy of a world has the same future, bit for bit. Two worlds share nothing and may be used by two threads; one
world by one at a time. Python's lock is released while steps are made.)";

constexpr const char* kInit = R"(An empty world.

dimension: 2 or 3.      gravity: [m/s^2], default 9.81 along -y.      dt: what step() advances by [s].
precision: 'f64' or 'f32', number type of state and computation.
preset: 'default', or 'fast' for large scenes.
settings: keys and values as in a spec, over those of the preset: {"solver": "nsgs", "substeps": 4}; `settings` lists all.)";

constexpr const char* kStates =
    R"(States of all bodies as one array of bodies x 13, in the order in which they were added.

Columns: position of the body frame [m] 0:3, orientation w, x, y, z 3:7, velocity of the centre of mass [m/s] 7:10, angular
velocity [rad/s] 10:13, all in the world frame. 2D, bodies x 6: position 0:2, angle [rad] 2, velocity 3:5, angular velocity 5.
The type is that of the world's precision.

The array shows the engine's own memory without a copy: it is filled at the end of each step() and of each call that moves
bodies. It is read-only; assign an array of the same shape to put bodies elsewhere: world.states = array (bodies whose numbers
do not change keep their contacts). An array that is kept outlives the world; add_body() begins a new one.)";

constexpr const char* kContacts = R"(Contact points that the last step acted upon, as a structured array.

body_a, body_b, shape_a, shape_b: numbers, A is the body that was added first; point_a, point_b: on the surfaces, world frame [m];
normal: unit, from A to B; depth: > 0 where they overlap [m]; normal_impulse: of the step [N s], >= 0, pushes B along the normal;
friction_impulse: on B [N s]. Places are those at the beginning of the step.)";

constexpr const char* kAddBody = R"(Adds a body and returns its number.

type: 'dynamic', 'static' or 'kinematic' (moves at its velocity, whatever it meets).
position [m], orientation: of the body frame, world frame. velocity [m/s]: of the centre of mass; angular_velocity [rad/s].
mass [kg], center_of_mass [m] (body frame), inertia [kg m^2] about it in body axes (3 x 3, or the diagonal; 2D: one number): by
    default those of its shapes, by their densities; a mass alone scales these.
linear_velocity_kept, angular_velocity_kept: fraction kept per second, (0, 1]. gravity_scale: factor on gravity.
collides: False: no contacts. continuous: True: a bullet (continuous collision), None: as the world's settings say.)";

constexpr const char* kAddShape = R"(Adds a shape to a body and returns its number.

position [m], orientation: of the shape in the body frame. material: a number or name, by default 1 (friction 0.6, restitution
0; 0 is without friction). density [kg/m^3] (2D: [kg/m^2]). sensor: finds what overlaps it, touches nothing.
surface_velocity [m/s], surface_angular_velocity [rad/s]: of the surface over its body, body axes: belts and turntables.
layers, mask: bits; two shapes collide if each has a layer of the other in its mask. group: of one group, a positive one
always, a negative one never.)";

constexpr const char* kAddJoint = R"(Adds a joint between two bodies (None: the world) and returns its number.

type: ball, cone_twist (3D), distance, fixed, hinge, six_dof, slider, wheel.
anchor_a, anchor_b [m], axis_a, axis_b (unit): in the frames of the bodies. spin_axis_b: of a wheel. normal_a: of a six_dof.
length: of a distance joint [m]. collide_connected: whether the two bodies collide with each other.
axes: JointAxis of each coordinate: hinge: angle; slider: travel; distance: distance; ball: angle between the axes; cone_twist:
    twist, angle between the axes; six_dof: three travels, twist, two swings (2D: two travels, angle); wheel: travel, spin.
break_force [N], break_torque [N m]: the joint is removed at the end of a step in which it carried more.
The relative pose of the moment in which it is added is its zero.)";

constexpr const char* kHit =
    " A hit has: body, shape, piece (of a mesh, chain or field; else -1), fraction of the translation, "
    "distance [m], point and "
    "normal (unit), world frame, inside.";

void defineBuilding(WorldClass& world) {
    world.def(
        "add_material",
        [](AnyWorld& w, double friction, double restitution, double staticFriction, double rolling,
           double torsional, const std::string& name) {
            return w.addMaterial({friction, restitution, staticFriction, rolling, torsional}, name);
        },
        py::arg("friction"), py::arg("restitution") = 0.0, py::kw_only(), py::arg("static_friction") = 0.0,
        py::arg("rolling_friction") = 0.0, py::arg("torsional_friction") = 0.0, py::arg("name") = "",
        "Adds a material and returns its number. static_friction 0: as friction; rolling and torsional "
        "friction are lengths "
        "[m]. Two materials have friction sqrt(a b) and restitution min(a, b), unless set_pair says "
        "otherwise.");
    world.def(
        "set_pair",
        [](AnyWorld& w, const Key& a, const Key& b, double friction, double restitution,
           double staticFriction, double rolling, double torsional) {
            w.setPair(a, b, {friction, restitution, staticFriction, rolling, torsional});
        },
        py::arg("a"), py::arg("b"), py::arg("friction"), py::arg("restitution") = 0.0, py::kw_only(),
        py::arg("static_friction") = 0.0, py::arg("rolling_friction") = 0.0,
        py::arg("torsional_friction") = 0.0, "Coefficients of two materials.");
    world.def(
        "add_body",
        [](AnyWorld& w, const std::string& name, const std::string& type, const MaybeNumbers& position,
           const MaybeNumbers& orientation, const MaybeNumbers& velocity, const MaybeNumbers& angular,
           double mass, const MaybeNumbers& center, const MaybeNumbers& inertia, double linearKept,
           double angularKept, double gravityScale, bool collides, std::optional<bool> continuous) {
            return w.addBody({name, type, position, orientation, velocity, angular, center, inertia, mass,
                              linearKept, angularKept, gravityScale, collides, continuous});
        },
        py::kw_only(), py::arg("name") = "", py::arg("type") = "dynamic", py::arg("position") = py::none(),
        py::arg("orientation") = py::none(), py::arg("velocity") = py::none(),
        py::arg("angular_velocity") = py::none(), py::arg("mass") = 0.0,
        py::arg("center_of_mass") = py::none(), py::arg("inertia") = py::none(),
        py::arg("linear_velocity_kept") = 1.0, py::arg("angular_velocity_kept") = 1.0,
        py::arg("gravity_scale") = 1.0, py::arg("collides") = true, py::arg("continuous") = py::none(),
        kAddBody);
    world.def(
        "add_shape",
        [](AnyWorld& w, const Key& body, const ShapeArgs& shape, const MaybeNumbers& position,
           const MaybeNumbers& orientation, const Key& material, double density, bool sensor,
           const MaybeNumbers& surface, const MaybeNumbers& turning, std::uint32_t layers, std::uint32_t mask,
           int group) {
            return w.addShape(
                body, shape,
                {position, orientation, surface, turning, material, density, sensor, layers, mask, group});
        },
        py::arg("body"), py::arg("shape"), py::kw_only(), py::arg("position") = py::none(),
        py::arg("orientation") = py::none(), py::arg("material") = Key(py::ssize_t{1}),
        py::arg("density") = 1000.0, py::arg("sensor") = false, py::arg("surface_velocity") = py::none(),
        py::arg("surface_angular_velocity") = py::none(), py::arg("layers") = 1u,
        py::arg("mask") = 0xffffffffu, py::arg("group") = 0, kAddShape);
    world.def(
        "add_joint",
        [](AnyWorld& w, const std::string& type, const MaybeKey& a, const MaybeKey& b,
           const MaybeNumbers& anchorA, const MaybeNumbers& anchorB, const MaybeNumbers& axisA,
           const MaybeNumbers& axisB, const MaybeNumbers& spinAxisB, const MaybeNumbers& normalA,
           double length, bool collideConnected, const std::vector<AxisArgs>& axes, double breakForce,
           double breakTorque, const std::string& name) {
            return w.addJoint({type, anchorA, anchorB, axisA, axisB, spinAxisB, normalA, length,
                               collideConnected, axes, breakForce, breakTorque},
                              a, b, name);
        },
        py::arg("type"), py::arg("body_a"), py::arg("body_b"), py::kw_only(),
        py::arg("anchor_a") = py::none(), py::arg("anchor_b") = py::none(), py::arg("axis_a") = py::none(),
        py::arg("axis_b") = py::none(), py::arg("spin_axis_b") = py::none(), py::arg("normal_a") = py::none(),
        py::arg("length") = 0.0, py::arg("collide_connected") = false,
        py::arg("axes") = std::vector<AxisArgs>{}, py::arg("break_force") = kInfinity,
        py::arg("break_torque") = kInfinity, py::arg("name") = "", kAddJoint);
    world.def("add_constant_force", &AnyWorld::addConstantForce, py::arg("body"), py::arg("force"),
              py::arg("torque") = py::none(), py::kw_only(), py::arg("start") = 0.0,
              py::arg("end") = kInfinity,
              "A force [N] and torque [N m] at the centre of mass, world frame, from `start` to `end` [s].");
    world.def("add_drag", &AnyWorld::addDrag, py::arg("body"), py::kw_only(), py::arg("linear") = 0.0,
              py::arg("quadratic") = 0.0,
              "The force -linear v - quadratic |v| v at the centre of mass [N s/m], [N s^2/m^2].");
    world.def("add_spring", &AnyWorld::addSpring, py::arg("body_a"), py::arg("body_b"), py::kw_only(),
              py::arg("anchor_a") = py::none(), py::arg("anchor_b") = py::none(), py::arg("stiffness"),
              py::arg("damping") = 0.0, py::arg("length") = 0.0,
              "A spring [N/m] and damper [N s/m] between two anchors in body frames [m]; None: the world.");
}

void defineRunning(WorldClass& world) {
    world.def("step", &AnyWorld::step, py::arg("steps") = 1, py::kw_only(), py::arg("dt") = py::none(),
              "Advances by so many steps of dt [s] (default: the world's own). Ctrl-C ends it between two "
              "steps. Raises "
              "FloatingPointError where a velocity or pose is no longer finite.");
    world.def("apply_force", &AnyWorld::applyForce, py::arg("body"), py::arg("force"),
              py::arg("torque") = py::none(),
              "Force [N] and torque [N m] at the centre of mass, world frame, during the next step alone. "
              "Adds up.");
    world.def("apply_impulse", &AnyWorld::applyImpulse, py::arg("body"), py::arg("impulse"),
              py::arg("angular_impulse") = py::none(),
              "Changes linear [N s] and angular [N m s] momentum at once, world frame.");
    world.def("apply_wrenches", &AnyWorld::applyWrenches, py::arg("wrenches"),
              "apply_force for all bodies: bodies x 6 (2D: 3), force [N] then torque [N m]. Static bodies "
              "are left out.");
    world.def("set_pose", &AnyWorld::setPose, py::arg("body"), py::arg("position"),
              py::arg("orientation") = py::none(),
              "Puts a body elsewhere, without a way between; its velocity stays, its contacts begin anew.");
    world.def(
        "set_velocity", &AnyWorld::setVelocity, py::arg("body"), py::arg("velocity"),
        py::arg("angular_velocity") = py::none(),
        "Sets the velocity of the centre of mass [m/s] and the angular velocity [rad/s] (None: as it is).");
    world.def("snapshot", &AnyWorld::snapshot,
              "The state as bytes. Restored into this world, or one built alike, it has the same future, bit "
              "for bit.");
    world.def(
        "restore", &AnyWorld::restore, py::arg("snapshot"),
        "Goes back to a snapshot. Raises EngineError, and changes nothing, where it is of another world.");
    world.def("copy", &AnyWorld::copy, "A world of its own with the same state and future.");
    world.def("__copy__", &AnyWorld::copy);
    world.def(
        "__deepcopy__", [](const AnyWorld& w, const py::dict&) { return w.copy(); }, py::arg("memo"));
    world.def("batch", &AnyWorld::batch, py::arg("count"), py::arg("threads") = 1,
              "So many copies of this world as a WorldBatch.");
}

void defineReading(WorldClass& world) {
    world.def_property_readonly("dimension", &AnyWorld::dimension, "2 or 3.");
    world.def_property_readonly("precision", &AnyWorld::precision, "'f32' or 'f64'.");
    world.def_property_readonly("settings", &AnyWorld::settings,
                                "Every setting of the engine, by the keys of a spec.");
    world.def_property("dt", &AnyWorld::timeStep, &AnyWorld::setTimeStep, "What step() advances by [s].");
    world.def_property("gravity", &AnyWorld::gravity, &AnyWorld::setGravity, "[m/s^2], world frame.");
    world.def_property_readonly("time", &AnyWorld::time, "The sum of all steps [s].");
    world.def_property_readonly(
        "bodies", [](const AnyWorld& w) { return w.bodies().all(); },
        "Names of the bodies, in the order of `states`.");
    world.def_property_readonly(
        "joints", [](const AnyWorld& w) { return w.joints().all(); },
        "Names of the joints, broken ones too.");
    world.def_property_readonly(
        "materials", [](const AnyWorld& w) { return w.materials().all(); }, "Names of the materials.");
    world.def(
        "index", [](const AnyWorld& w, const Key& body) { return w.bodies().find(body); }, py::arg("body"),
        "Number of a body by its name. Raises KeyError.");
    world.def("body", &AnyWorld::body, py::arg("body"),
              "A body's name, type, mass [kg], center_of_mass [m] (body frame), inertia about it [kg m^2] "
              "(body axes), "
              "gravity_scale, asleep.");
    world.def_property("states", &AnyWorld::states, &AnyWorld::setStates, kStates);
    world.def_property_readonly("contacts", &AnyWorld::contacts, kContacts);
    world.def_property_readonly(
        "events", &AnyWorld::events,
        "Contacts and overlaps with sensors that began or ended in the last step: kind, body_a, body_b, "
        "normal (from A to B), depth [m], impulse [N s].");
    world.def_property_readonly(
        "last_step", &AnyWorld::lastStep,
        "The last step: pairs, contacts, rows, iterations, residuals of each iteration [m/s], seconds "
        "by phase, joints that broke, bodies asleep.");
    world.def(
        "energy", &AnyWorld::energy,
        "Kinetic energy, and potential energy of gravity with its zero at the origin [J]; without springs.");
    world.def("state_hash", &AnyWorld::stateHash, "Hash of everything that decides the future.");
    world.def("__repr__", [](const AnyWorld& w) {
        return "<rigor.World: " + std::to_string(w.dimension()) + "D " + w.precision() + ", " +
               std::to_string(w.bodies().size()) + " bodies, " + std::to_string(w.joints().size()) +
               " joints>";
    });
}

void defineJoints(WorldClass& world) {
    world.def("joint_holds", &AnyWorld::jointHolds, py::arg("joint"),
              "False once it has broken or was removed.");
    world.def("joint_coordinate", &AnyWorld::jointCoordinate, py::arg("joint"), py::arg("axis") = 0,
              "[m], or [rad] counted over turns; add_joint lists the coordinates.");
    world.def("joint_speed", &AnyWorld::jointSpeed, py::arg("joint"), py::arg("axis") = 0,
              "Rate of the coordinate [m/s] or [rad/s].");
    world.def("joint_force", &AnyWorld::jointForce, py::arg("joint"),
              "Mean force of A on B at B's anchor in the last step, world frame [N].");
    world.def("joint_torque", &AnyWorld::jointTorque, py::arg("joint"),
              "Mean torque of A on B about B's anchor in the last step, world frame [N m].");
    world.def("set_joint_axis", &AnyWorld::setJointAxis, py::arg("joint"), py::arg("axis"),
              py::arg("control"), "Replaces the limits, motor and spring of a coordinate by a JointAxis.");
    world.def("set_joint_motor", &AnyWorld::setJointMotor, py::arg("joint"), py::arg("axis"),
              py::arg("speed"), py::arg("max_force"),
              "Motor of a coordinate: speed [m/s] or [rad/s], largest force [N] or torque [N m] (0: none).");
    world.def("set_joint_target", &AnyWorld::setJointTarget, py::arg("joint"), py::arg("axis"),
              py::arg("target"), "Rest value of a coordinate's spring [m] or [rad].");
    world.def("remove_joint", &AnyWorld::removeJoint, py::arg("joint"), "Removes a joint.");
}

void defineQueries(WorldClass& world) {
    const auto hit = [](const char* text) { return std::string(text) + kHit; };
    world.def(
        "cast_ray", &AnyWorld::castRay, py::arg("origin"), py::arg("translation"),
        hit("The nearest hit of a ray from `origin` along `translation` [m], world frame, or None.").c_str());
    world.def("cast_rays", &AnyWorld::castRays, py::arg("origins"), py::arg("translations"),
              hit("The same for many rays (rays x dimension; translations: as many, or one) as a structured "
                  "array; where a ray "
                  "hits nothing, body is -1 and distance infinite.")
                  .c_str());
    world.def("cast_shape", &AnyWorld::castShape, py::arg("shape"), py::arg("position"),
              py::arg("translation"), py::arg("orientation") = py::none(),
              hit("The first touch of a convex shape that is moved from `position` along `translation` [m] "
                  "without turning, or "
                  "None; the normal points from it to what it touches.")
                  .c_str());
    world.def("overlapping", &AnyWorld::overlapping, py::arg("shape"), py::arg("position"),
              py::arg("orientation") = py::none(),
              "Numbers of the bodies and shapes that overlap a posed convex shape, in the order in which "
              "they were added: an "
              "array of hits x (body, shape).");
    world.def("nearest", &AnyWorld::nearest, py::arg("point"), py::arg("within"),
              hit("The shape nearest to a point [m], if any is within a distance [m], or None: signed "
                  "distance, point on the "
                  "shape, normal from the point to it.")
                  .c_str());
}

}  // namespace

WorldClass bindWorld(py::module_& module) {
    WorldClass world(module, "World", kWorld);
    // A positional argument: pybind11 tries overloads with keywords alone without conversions.
    world.def(py::init(&makeWorld), py::arg("dimension") = 3, py::kw_only(), py::arg("precision") = "f64",
              py::arg("preset") = "default", py::arg("gravity") = py::none(), py::arg("dt") = 1.0 / 60,
              py::arg("settings") = py::dict(), kInit);
    defineBuilding(world);
    defineRunning(world);
    defineReading(world);
    defineJoints(world);
    defineQueries(world);
    return world;
}

}  // namespace rigor::engine::python
