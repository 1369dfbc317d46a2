// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Siconos Numerics: solvers of contact problems, without bodies or collisions.
#include "adapters/interface/options.hpp"
#include "adapters/siconos/solvers.hpp"

namespace rigor::siconos {
namespace {

class SiconosEngine final : public adapter::Engine {
  public:
    adapter::EngineInfo info() const override {
        const std::string version = RIGOR_SICONOS_VERSION, package = RIGOR_SICONOS_PACKAGE;
        return {"siconos", version, "f64", "Siconos Numerics", "", package == version ? "" : package};
    }
    adapter::Capabilities capabilities() const override {
        adapter::Capabilities c;
        c.dimensions = {2, 3};
        c.contactSolvers = true;
        c.libraryLacks = {{"dynamics", "siconos/numerics: solvers alone; siconos/kernel has the simulation"}};
        return c;
    }
    std::vector<adapter::Option> options() const override {
        return {
            adapter::choice("solver", solvers_.solvers(), "nsgs", "nsgs",
                            "non-smooth Gauss-Seidel, semi-smooth Newton (Alart-Curnier, Fischer-Burmeister, "
                            "natural map), ADMM, proximal point, Tresca's fixed point, and in 2D others")};
    }
    const adapter::ContactSolverEngine* contactSolvers() const override { return &solvers_; }

  private:
    SiconosContactSolvers solvers_;
};

std::unique_ptr<adapter::Engine> createEngine() {
    return std::make_unique<SiconosEngine>();
}

}  // namespace
}  // namespace rigor::siconos

RIGOR_ADAPTER_MODULE(rigor::siconos::createEngine)
