// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/python/any_batch.hpp"

namespace rigor::engine::python {
namespace {

constexpr const char* kBatch =
    R"(Many worlds of one scene, stepped side by side on threads: for sweeps, fits and learning.

Made by World.batch(count, threads), or of worlds that may differ in all but their bodies: WorldBatch([world, ...], threads).
Each world has the bits that it has alone, for any number of threads; Python's lock is released while they are stepped.

A world that fails (a state that it refuses, a number that is not finite) is left out until reset(), and the others go on:
step() and the other calls that change worlds then return False, and failures() says which failed, and why.)";

constexpr const char* kBatchStates =
    R"(States of all bodies as one array of worlds x bodies x 13 (2D: 6), columns as World.states.

The array shows the engine's own memory without a copy, and is filled at the end of each step(). It is read-only; assign an
array of the same shape to put bodies elsewhere: batch.states = array. A body whose numbers are those it has is left as it is.)";

std::shared_ptr<AnyBatch> batchOf(const std::vector<std::shared_ptr<AnyWorld>>& worlds, int threads) {
    if (worlds.empty()) throw EngineError("batch_size", "a batch has one world at least");
    return worlds.front()->batchOf(worlds, threads);
}

}  // namespace

void bindBatch(py::module_& module) {
    py::class_<AnyBatch, std::shared_ptr<AnyBatch>> batch(module, "WorldBatch", kBatch);
    batch.def(py::init(&batchOf), py::arg("worlds"), py::arg("threads") = 1,
              "Copies of these worlds, which have one dimension, one precision and as many bodies each.");
    batch.def("__len__", &AnyBatch::size, "Number of worlds.");
    batch.def("__getitem__", &AnyBatch::world, py::arg("index"), "A copy of one of the worlds, as a World.");
    batch.def("step", &AnyBatch::step, py::arg("steps") = 1, py::kw_only(), py::arg("dt") = py::none(),
              "Advances every world by so many steps of dt [s] (default: the worlds' own). False where a "
              "world has failed.");
    batch.def_property("states", &AnyBatch::states, &AnyBatch::setStates, kBatchStates);
    batch.def("set_states", &AnyBatch::setStates, py::arg("states"),
              "As assigning to `states`; False where a world has failed.");
    batch.def("apply_wrenches", &AnyBatch::applyWrenches, py::arg("wrenches"),
              "Forces [N] and torques [N m] at the centres of mass, world frame, during the next step: "
              "worlds x bodies x 6 "
              "(2D: 3).");
    batch.def("set_joint_motors", &AnyBatch::setJointMotors, py::arg("joint"), py::arg("axis"),
              py::arg("speeds"), py::arg("max_force"),
              "Speed of a joint's motor in each world [m/s] or [rad/s], and its largest force [N] or torque "
              "[N m].");
    batch.def("set_joint_targets", &AnyBatch::setJointTargets, py::arg("joint"), py::arg("axis"),
              py::arg("targets"), "Rest value of a joint's spring in each world [m] or [rad].");
    batch.def("state_hashes", &AnyBatch::stateHashes, "World.state_hash() of each world.");
    batch.def("failures", &AnyBatch::failures, "Worlds that have failed, as (index, message).");
    batch.def("reset", &AnyBatch::reset, py::arg("worlds") = py::none(),
              "Leads worlds (their indices; default: all) back to where they began.");
}

}  // namespace rigor::engine::python
