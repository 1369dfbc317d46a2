// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The module rigor._engine.
#include "adapters/interface/types.hpp"
#include "adapters/rigor/python/scenario_world.hpp"
#include "engine/python/bindings.hpp"
#include "scenarios/json/problem.hpp"

namespace rigor::adapter {
namespace {

constexpr const char* kInit = R"(A scenario's world, as a run of `rigor` builds it.

scenario: a name of the library, a file, or the content of one as a dictionary (scenarios/FORMAT.md).
spec: 'rigor', with keys and values as on the command line: 'rigor:preset=matched,solver=nsgs'.
dt: what step() advances by [s]; default: the scenario's first time step.
set: values of the scenario to replace: {"bodies.block.velocity": [3.1, 0, 0.2]}.

Bodies, joints and materials have the scenario's names and numbers; its forces and scheduled impulses act.)";

void translateErrors() {
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            if (thrown) std::rethrow_exception(thrown);
        } catch (const Unsupported& error) {
            PyErr_SetString(PyExc_NotImplementedError, error.what());
        } catch (const BadInput& error) {
            PyErr_SetString(PyExc_ValueError, error.what());
        } catch (const scenario::LoadError& error) {
            PyErr_SetString(PyExc_ValueError, error.what());
        }
    });
}

}  // namespace
}  // namespace rigor::adapter

PYBIND11_MODULE(_engine, module) {
    module.doc() =
        "The in-house engine of Rigor; import it as rigor.World, rigor.WorldBatch, rigor.Shape, "
        "rigor.JointAxis.";
    auto world = rigor::engine::python::bindEngine(module);
    rigor::adapter::translateErrors();
    world.def(pybind11::init(&rigor::adapter::makeScenarioWorld), pybind11::arg("scenario"),
              pybind11::arg("spec") = "rigor", pybind11::kw_only(), pybind11::arg("dt") = pybind11::none(),
              pybind11::arg("set") = pybind11::dict(), rigor::adapter::kInit);
}
