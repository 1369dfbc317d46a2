// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/python/bindings.hpp"

#include "engine/python/any_batch.hpp"
#include "engine/python/rows.hpp"

namespace rigor::engine::python {
namespace {

/// EngineError of Python: a ValueError with the attribute `id`.
void bindError(py::module_& module) {
    static const auto error = new py::exception<EngineError>(module, "EngineError", PyExc_ValueError);
    error->attr("__doc__") =
        "The engine refused an argument. `id` is a stable name of the reason: 'body_mass', "
        "'unknown_algorithm', ...";
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            if (thrown) std::rethrow_exception(thrown);
        } catch (const EngineError& caught) {
            const py::object instance = py::reinterpret_borrow<py::object>(*error)(caught.what());
            instance.attr("id") = caught.id();
            PyErr_SetObject(error->ptr(), instance.ptr());
        }
    });
}

}  // namespace

WorldClass bindEngine(py::module_& module) {
    registerRows();
    bindError(module);
    bindShapes(module);
    bindJoints(module);
    WorldClass world = bindWorld(module);
    bindBatch(module);
    // The package shows the classes under its own name.
    for (const char* name : {"EngineError", "Shape", "JointAxis", "World", "WorldBatch"})
        module.attr(name).attr("__module__") = "rigor";
    return world;
}

}  // namespace rigor::engine::python
