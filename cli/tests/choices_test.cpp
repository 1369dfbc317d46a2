// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The menu of the in-house engine as the user sees it: everything of it is listed, and every listed choice
// runs by its spec, from a study file and from a scenario file.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "cli/tests/program.hpp"

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using rigor::cli_test::rigor;

json listed() {
    static const json list = json::parse(rigor("list algorithms --json", false).out);
    return list;
}

/// The design's menu, stage by stage.
TEST(Choices, TheWholeMenuIsListed) {
    const std::map<std::string, std::set<std::string>> menu{
        {"integrator", {"explicit_euler", "symplectic_euler", "moreau_midpoint", "velocity_verlet", "rk4"}},
        {"orientation_update", {"first_order", "exponential_map"}},
        {"rotation", {"none", "explicit", "implicit", "lie_midpoint", "moser_veselov"}},
        {"broad_phase",
         {"brute_force", "sweep_and_prune", "sweep_and_prune_all_axes", "uniform_grid", "octree",
          "dynamic_aabb_tree"}},
        {"bounding_volume", {"aabb", "bounding_sphere", "aabb_and_sphere"}},
        {"narrow_phase", {"sat", "gjk_epa", "mpr"}},
        {"manifold", {"deepest", "clipped", "persistent"}},
        {"solver",
         {"single_pass", "jacobi", "pgs", "pgs_soft", "tgs_soft", "xpbd", "block", "dantzig", "lemke",
          "nsgs"}},
        {"warm_starting", {"on", "off"}},
        {"position_correction",
         {"none", "baumgarte", "split_impulse", "ngs", "processed_rattle", "rattle", "soft"}},
        {"friction", {"pyramid", "pyramid_2", "cone"}},
        {"friction_combine", {"geometric_mean", "average", "min", "max", "multiply"}},
        {"restitution", {"newton", "poisson", "none"}},
        {"continuous_collision", {"none", "speculative", "conservative_advancement"}},
        {"sleeping", {"off", "islands"}},
        {"precision", {"f32", "f64"}},
        {"shape",
         {"sphere", "box", "capsule", "cylinder", "cone", "hull", "half_space", "triangle_mesh",
          "height_field", "circle", "polygon", "segment", "chain", "half_plane", "compound"}},
        {"joint", {"ball", "hinge", "slider", "fixed", "distance", "cone_twist", "six_dof", "wheel"}},
        {"query", {"ray_cast", "shape_cast", "overlap", "closest_points"}}};
    std::map<std::string, std::set<std::string>> found;
    for (const json& entry : listed()) found[entry.at("stage")].insert(entry.at("name").get<std::string>());
    for (const auto& [stage, names] : menu)
        for (const std::string& name : names)
            EXPECT_TRUE(found[stage].contains(name)) << stage << " " << name;
    std::map<std::string, int> defaults;
    for (const json& entry : listed())
        if (entry.contains("spec")) defaults[entry.at("stage")] += entry.at("default").get<bool>() ? 1 : 0;
    for (const auto& [stage, count] : defaults) EXPECT_EQ(count, 1) << stage;
}

/// One study whose variants are all the specs of the list.
TEST(Choices, EveryOneRunsFromAStudyFile) {
    json variants = json::array();
    std::set<std::string> faults;
    for (const json& entry : listed()) {
        if (!entry.contains("spec")) continue;
        variants.push_back(entry.at("spec"));
        if (entry.at("stage") == "fault") faults.insert(entry.at("spec").get<std::string>());
    }
    ASSERT_GT(variants.size(), 70u);
    const fs::path folder = fs::path(testing::TempDir()) / "choices";
    fs::remove_all(folder);
    fs::create_directories(folder);
    const auto file = folder / "choices.json";
    std::ofstream(file) << json{{"rigor_study", 1},
                                {"name", "choices"},
                                {"parts", json::array({{{"name", "all"},
                                                        {"scenarios", {"slide_and_stop"}},
                                                        {"set", {"duration=0.2"}},
                                                        {"dt", {0.01}},
                                                        {"metrics", {"position_max"}},
                                                        {"variants", variants}}})}};
    const auto ran =
        rigor("study " + file.string() + " -q -j 2 --json --out " + (folder / "run").string(), false);
    const json out = json::parse(ran.out, nullptr, false);
    ASSERT_FALSE(out.is_discarded()) << ran.out;
    const json& rows = out.at("parts").at(0).at("rows");
    EXPECT_EQ(rows.size(), variants.size());
    for (const json& row : rows) {
        const bool faulty = faults.contains(row.at("variant").get<std::string>());
        EXPECT_TRUE(faulty || row.at("outcome") == "completed") << row.dump();
    }
}

/// A scenario names a choice itself; the command line has the last word.
TEST(Choices, AScenarioFileNamesThem) {
    const auto write = [](const json& engines) {
        json scenario = json::parse(R"({"rigor": 1, "name": "mine", "title": "mine", "dimension": 3,
            "gravity": [0, -9.81, 0], "duration": 0.5, "dt": [0.01], "materials": {"stuff": {"friction": 0.5}},
            "bodies": [{"name": "floor", "type": "static", "shapes": [{"half_space": {"normal": [0, 1, 0]}}]},
                       {"name": "box", "mass": 1, "position": [0, 0.6, 0], "velocity": [1, 0, 0],
                        "angular_velocity": [0.3, 2, 1], "shapes": [{"box": {"half_extents": [0.5, 0.5, 0.5]}}]}]})");
        if (!engines.is_null()) scenario["engines"] = engines;
        const auto file = (fs::path(testing::TempDir()) / "names_solver.json").string();
        std::ofstream(file) << scenario;
        return file;
    };
    const auto run = [](const std::string& file, const std::string& engine) {
        return rigor("run " + file + " --csv - --engine " + engine, false);
    };
    const auto plain = run(write(nullptr), "rigor");
    const auto single = run(write(nullptr), "rigor:solver=single_pass,friction=pyramid");
    EXPECT_NE(plain.out, single.out);
    const auto file = write({{"rigor", {{"solver", "single_pass"}, {"friction", "pyramid"}}}});
    EXPECT_EQ(run(file, "rigor").out, single.out);
    EXPECT_EQ(run(file, "rigor:solver=block,friction=cone").out, plain.out);
    const auto unknown = rigor("run " + write({{"rigor", {{"solver", "magic"}}}}));
    EXPECT_EQ(unknown.code, 2) << unknown.out;
    EXPECT_NE(unknown.out.find("magic"), std::string::npos);
    const auto form = rigor("check " + write({{"rigor", {{"solver", json::array({1})}}}}));
    EXPECT_EQ(form.code, 2);
    EXPECT_NE(form.out.find("/engines/rigor/solver"), std::string::npos) << form.out;
}

}  // namespace
