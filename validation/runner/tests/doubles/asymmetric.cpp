// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The honest engine of rigid.hpp and, by its option "fault", the same engine with one symmetry broken.
// validation/studies/tests/symmetry_faults_test.cpp says which column has to find each of them.
#include <chrono>
#include <map>

#include "validation/runner/tests/doubles/rigid.hpp"

namespace rigor::doubles {
namespace {

class AsymmetricWorld : public RigidWorld {
  public:
    AsymmetricWorld(const Scenario& scenario, double dt, const Settings& settings)
        : RigidWorld(scenario, dt, settings), threads_(integerSetting(settings, "threads")) {}

  protected:
    void endOfStep() override {
        for (std::size_t i = 0; i < bodies_.size(); ++i)
            if (isDynamic(i)) injectFault(i, bodies_[i]);
    }
    virtual void injectFault(std::size_t, Moving&) const {}
    double time() const { return steps_ * dt_; }
    int threads_;
};

/// Air at rest, in a scene without any.
struct AbsoluteDrag : AsymmetricWorld {
    using AsymmetricWorld::AsymmetricWorld;
    void injectFault(std::size_t, Moving& m) const override { m.velocity = (1.0 - 0.1 * dt_) * m.velocity; }
};
/// A pull along the world's x.
struct PreferredAxis : AsymmetricWorld {
    using AsymmetricWorld::AsymmetricWorld;
    void injectFault(std::size_t, Moving& m) const override { m.velocity += dt_ * Vec3{0.1, 0, 0}; }
};
/// The later a dynamic body is listed, the heavier.
struct OrderDependent : AsymmetricWorld {
    using AsymmetricWorld::AsymmetricWorld;
    Vec3 gravityOn(std::size_t i) const override {
        int before = 0;
        for (std::size_t k = 0; k < i; ++k) before += isDynamic(k) ? 1 : 0;
        return (1.0 + 0.1 * before) * RigidWorld::gravityOn(i);
    }
};
/// The body that is listed first is taken as the ground.
struct InsertionDependent : AsymmetricWorld {
    using AsymmetricWorld::AsymmetricWorld;
    Vec3 gravityOn(std::size_t i) const override {
        return (isDynamic(0) ? 1.1 : 1.0) * RigidWorld::gravityOn(i);
    }
};
/// A seed from the clock.
struct HiddenRandom : AsymmetricWorld {
    using AsymmetricWorld::AsymmetricWorld;
    void injectFault(std::size_t, Moving& m) const override { m.position += Vec3{noise_, 0, 0}; }
    double noise_ = 1e-12 * (std::chrono::system_clock::now().time_since_epoch().count() % 9973 + 1);
};
/// Sums in another order on more threads.
struct ThreadDependent : AsymmetricWorld {
    using AsymmetricWorld::AsymmetricWorld;
    void injectFault(std::size_t, Moving& m) const override {
        m.velocity = (1.0 + 1e-12 * (threads_ - 1)) * m.velocity;
    }
};
/// Positions in single precision.
struct FloatPositions : AsymmetricWorld {
    using AsymmetricWorld::AsymmetricWorld;
    void injectFault(std::size_t, Moving& m) const override {
        const auto round = [](double x) { return static_cast<double>(static_cast<float>(x)); };
        m.position = {round(m.position.x), round(m.position.y), round(m.position.z)};
    }
};
/// Everything that turns is driven along its axis, like a screw.
struct Screw : AsymmetricWorld {
    using AsymmetricWorld::AsymmetricWorld;
    void injectFault(std::size_t i, Moving& m) const override {
        m.velocity += 0.1 * dt_ * spin(i, m.orientation);
    }
};
/// A length of its own: large bodies fall more slowly.
struct OwnLength : AsymmetricWorld {
    using AsymmetricWorld::AsymmetricWorld;
    Vec3 gravityOn(std::size_t i) const override {
        const auto* ball = std::get_if<Sphere>(&scenario_.bodies[i].shapes[0].geometry);
        return (1.0 - (ball != nullptr ? 0.1 * ball->radius : 0.0)) * RigidWorld::gravityOn(i);
    }
};
/// Gravity grows with the age of the world.
struct Ageing : AsymmetricWorld {
    using AsymmetricWorld::AsymmetricWorld;
    Vec3 gravityOn(std::size_t i) const override { return (1.0 + 0.5 * time()) * RigidWorld::gravityOn(i); }
};

template <class W>
std::unique_ptr<World> make(const Scenario& scenario, double dt, const Settings& settings) {
    return std::make_unique<W>(scenario, dt, settings);
}
using Maker = std::unique_ptr<World> (*)(const Scenario&, double, const Settings&);

const std::map<std::string, Maker> kFaults{{"none", &make<AsymmetricWorld>},
                                           {"absolute_drag", &make<AbsoluteDrag>},
                                           {"ageing", &make<Ageing>},
                                           {"float_positions", &make<FloatPositions>},
                                           {"hidden_random", &make<HiddenRandom>},
                                           {"insertion_dependent", &make<InsertionDependent>},
                                           {"order_dependent", &make<OrderDependent>},
                                           {"own_length", &make<OwnLength>},
                                           {"preferred_axis", &make<PreferredAxis>},
                                           {"screw", &make<Screw>},
                                           {"thread_dependent", &make<ThreadDependent>}};

class AsymmetricDynamics : public DynamicsEngine {
  public:
    std::unique_ptr<World> build(const Scenario& scenario, double dt,
                                 const Settings& settings) const override {
        return kFaults.at(textSetting(settings, "fault"))(scenario, dt, settings);
    }
};

class AsymmetricDouble : public Engine {
  public:
    EngineInfo info() const override { return doubleInfo(); }
    Capabilities capabilities() const override {
        Capabilities c = doubleCapabilities();
        c.dynamics = c.contactImpulses = true;
        return c;
    }
    std::vector<Option> options() const override {
        std::vector<std::string> names;
        for (const auto& [name, maker] : kFaults) names.push_back(name);
        return {{"fault", names, 0.0, 0.0, false, "none", "none", "the symmetry that is broken"},
                {"threads", {}, 1.0, 64.0, true, "1", "1", "does nothing, as it should"}};
    }
    const DynamicsEngine* dynamics() const override { return &dynamics_; }

  private:
    AsymmetricDynamics dynamics_;
};

std::unique_ptr<Engine> makeAsymmetricDouble() {
    return std::make_unique<AsymmetricDouble>();
}

}  // namespace
}  // namespace rigor::doubles

RIGOR_ADAPTER_MODULE(rigor::doubles::makeAsymmetricDouble)
