// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Guests as a user meets them: a new engine in every language, the conformance kit, and the commands that take engines.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/mman.h>

#include <filesystem>
#include <fstream>

#include "cli/tests/program.hpp"

namespace rigor::cli_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A ball that nothing touches.
constexpr const char* kFlight = R"({"rigor": 1, "name": "flight", "title": "A thrown ball", "dimension": 3,
  "isolates": ["integrator"], "source": "Galilei 1638", "gravity": [0.5, -3.75, 0.25], "duration": 0.5, "dt": [0.0078125],
  "materials": {"steel": {"friction": 0.1, "restitution": 0.5}},
  "bodies": [{"name": "ball", "mass": 2, "position": [1, 2, 3], "velocity": [4, 5, -6], "collides": false,
    "shapes": [{"sphere": {"radius": 0.1}}]}],
  "observe": ["ball"], "reference": {"free_flight": {"body": "ball"}}, "metrics": ["scheme_position_max"],
  "accept": {"*": {"scheme_position_max": 1e-11, "position_max": 0.0075, "velocity_max": 1e-11}}})";

std::string textOf(const fs::path& file) {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
}

class GuestCommands : public testing::Test {
  protected:
    void SetUp() override {
        std::string name = testing::TempDir() + "guest-commands-XXXXXX";
        ASSERT_NE(mkdtemp(name.data()), nullptr);
        folder_ = name;
        before_ = getenv("RIGOR_ADAPTER_PATH") == nullptr ? "" : getenv("RIGOR_ADAPTER_PATH");
    }
    void TearDown() override {
        if (before_.empty())
            unsetenv("RIGOR_ADAPTER_PATH");
        else
            setenv("RIGOR_ADAPTER_PATH", before_.c_str(), 1);
        fs::remove_all(folder_);
    }
    /// Writes a new engine and puts it on the path.
    void write(const std::string& name, const std::string& language) const {
        const auto written = rigor("new engine " + name + " --language " + language + " --folder " +
                                   (folder_ / name).string());
        ASSERT_EQ(written.code, 0) << written.out;
        EXPECT_THAT(written.out, HasSubstr("conform " + name));
        setenv("RIGOR_ADAPTER_PATH", (folder_ / name).c_str(), 1);
    }
    fs::path folder_;
    std::string before_;
};

/// Scenes of the library in which bodies fly alone have no contacts that an engine would need: the beginning of an engine
/// has a first report at once.
TEST_F(GuestCommands, ANewEngineRunsTheScenesOfFreeBodies) {
    write("mine", "python");
    for (const std::string scene :
         {"free_flight", "free_flight_2d", "linear_drag", "quadratic_drag_2d", "spring_oscillator",
          "spring_pendulum", "two_body_spring", "symmetric_top"}) {
        const auto run = rigor("run " + scene + " --engine mine");
        EXPECT_EQ(run.code, 0) << run.out;
    }
}

TEST_F(GuestCommands, ANewEngineOfEveryGuestLanguageConforms) {
    for (const std::string language : {"python", "javascript"}) {
        SCOPED_TRACE(language);
        const std::string name = "mine_in_" + language;
        write(name, language);
        const auto first = rigor("conform " + name + " --only description,build,motion");
        EXPECT_EQ(first.code, 0) << first.out;
        EXPECT_THAT(first.out, HasSubstr("conforms: all "));
        const fs::path scene = folder_ / "flight.json";
        std::ofstream(scene) << kFlight;
        const auto validated =
            rigor("validate " + scene.string() + " --engines " + name +
                  ":preset=matched --no-audit --json --out " + (folder_ / "run").string() + language);
        EXPECT_EQ(validated.code, 0) << validated.out;
        EXPECT_THAT(validated.out, HasSubstr("\"outcome\": \"completed\""));
        EXPECT_THAT(validated.out, HasSubstr("\"verdict\": \"pass\""));
    }
}

TEST_F(GuestCommands, RunLetsAGuestOfResidentMemoryHaveItsAddresses) {
    write("mine", "python");
    const fs::path program = folder_ / "mine/mine.py", manifest = folder_ / "mine/rigor_adapter_mine.json";
    const std::string first = textOf(program), described = textOf(manifest);
    // It reserves 8 GiB of addresses, which it does not use.
    const int privateUnreserved = MAP_PRIVATE | MAP_NORESERVE;
    std::ofstream(program) << "import mmap\nreserved = mmap.mmap(-1, 8 << 30, flags=" << privateUnreserved
                           << ")\n"
                           << first;
    std::ofstream(manifest) << described.substr(0, described.rfind('}')) << ", \"memory\": \"resident\"}";
    const fs::path scene = folder_ / "flight.json";
    std::ofstream(scene) << kFlight;
    const auto run = rigor("run " + scene.string() + " --engine mine");
    EXPECT_EQ(run.code, 0) << run.out;
}

TEST_F(GuestCommands, ConformSaysWhatFails) {
    write("mine", "python");
    const fs::path program = folder_ / "mine/mine.py";
    std::ifstream in(program);
    std::string text{std::istreambuf_iterator<char>(in), {}};
    const std::string right = "v + dt * (g + f";
    const auto at = text.find(right);
    ASSERT_NE(at, std::string::npos);
    text.replace(at, right.size(), "v + dt * (0.9 * g + f");
    std::ofstream(program) << text;
    const auto conform = rigor("conform mine --only motion");
    EXPECT_EQ(conform.code, 1);
    EXPECT_THAT(conform.out, HasSubstr("FAILED Kit/Motion.FreeFlightFollowsTheClosedFormOfTheEnginesScheme"));
    EXPECT_THAT(conform.out, HasSubstr("does not conform"));
    EXPECT_EQ(rigor("conform mine --only motions").code, 2);
}

/// An engine under the name of a guest that has a known deviation, and without it.
TEST_F(GuestCommands, ConformNamesKnownDeviationsThatAreNotNeeded) {
    write("mine", "python");
    const auto rename = [&](const char* from, const char* to) {
        std::string text = textOf(folder_ / "mine" / from);
        for (std::size_t at; (at = text.find("\"mine\"")) != std::string::npos;)
            text.replace(at, 6, "\"rapier3d\"");
        std::ofstream(folder_ / "mine" / to) << text;
    };
    rename("mine.py", "mine.py");
    rename("rigor_adapter_mine.json", "rigor_adapter_rapier3d.json");
    const auto conform = rigor("conform rapier3d --only motion");
    EXPECT_EQ(conform.code, 1);
    EXPECT_THAT(conform.out,
                HasSubstr(R"(deviations.cpp: {"rapier3d", "", "", 3, "center_of_mass_line", 0.0001})"));
    EXPECT_THAT(conform.out, HasSubstr("does not conform"));
}

TEST_F(GuestCommands, ConformTakesModules) {
    const auto conform = rigor("conform ode --only description,state --markdown");
    EXPECT_EQ(conform.code, 0) << conform.out;
    EXPECT_THAT(conform.out, HasSubstr("| section | passed | not claimed | failed |"));
}

TEST_F(GuestCommands, GuestsThatAreNotInstalledAreOneLine) {
    std::ofstream(folder_ / "rigor_adapter_absent.json")
        << R"({"rigor_guest": 1, "protocol": 1, "name": "absent", "title": "An absent engine", "precision": "f64",
              "command": ["true"], "needs": ["nothing/there"], "install": "get it"})";
    setenv("RIGOR_ADAPTER_PATH", folder_.c_str(), 1);
    const auto listed = rigor("list engines");
    EXPECT_EQ(listed.code, 0);
    EXPECT_THAT(listed.out, HasSubstr("not installed (get it)"));
    const auto run = rigor("run free_flight --engine absent");
    EXPECT_EQ(run.code, 2);
    EXPECT_THAT(run.out, HasSubstr("'absent' is not installed"));
}

TEST_F(GuestCommands, NewRefusesWhatIsNoNameOrIsThere) {
    EXPECT_EQ(rigor("new engine My-Engine").code, 2);
    EXPECT_EQ(rigor("new engine mine --language cobol").code, 2);
    write("mine", "python");
    EXPECT_EQ(rigor("new engine mine --folder " + (folder_ / "mine").string()).code, 2);
}

}  // namespace
}  // namespace rigor::cli_test
