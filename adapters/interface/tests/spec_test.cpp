// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <gtest/gtest.h>

#include "adapters/interface/options.hpp"
#include "adapters/interface/presets.hpp"
#include "adapters/interface/registry.hpp"

namespace rigor::adapter {
namespace {

/// An engine that is nothing but its options.
class OptionsOnly final : public EngineWithPresets {
  public:
    EngineInfo info() const override { return {"toy", "1", "f64", "Toy", ""}; }
    Capabilities capabilities() const override { return {}; }
    std::vector<Option> options() const override {
        return {choice("solver", {"fast", "exact"}, "fast", "exact", ""),
                integer("iterations", 1, 100, "10", "50", ""), number("slop", 0, 1, "0.01", "0", "")};
    }
    std::vector<Preset> presets() const override {
        return {{"rough", {{"iterations", "3"}, {"slop", "0.1"}}}};
    }
};

std::string messageOf(const std::string& spec) {
    try {
        (void)resolveSettings(parseSpec(spec), OptionsOnly());
    } catch (const BadInput& error) {
        return error.what();
    }
    return "";
}

TEST(Spec, TextIsStableWhateverTheOrderOfKeys) {
    EXPECT_EQ(parseSpec("ode").text(), "ode");
    EXPECT_EQ(parseSpec("ode:stepper=quickstep,iterations=50").text(), "ode:iterations=50,stepper=quickstep");
    EXPECT_EQ(parseSpec("ode:iterations=50,stepper=quickstep").text(), "ode:iterations=50,stepper=quickstep");
}

TEST(Spec, ListsKeepOptionsWithTheirEngine) {
    const auto specs = parseSpecList("rigor,ode:stepper=quickstep,iterations=50,bullet,box2d:preset=matched");
    ASSERT_EQ(specs.size(), 4u);
    EXPECT_EQ(specs[0].text(), "rigor");
    EXPECT_EQ(specs[1].text(), "ode:iterations=50,stepper=quickstep");
    EXPECT_EQ(specs[2].text(), "bullet");
    EXPECT_EQ(specs[3].preset(), "matched");
}

TEST(Spec, MalformedTextIsRefused) {
    for (const char* text :
         {"", ":", "ode:", "ode:=1", "ode:a", "ode:a=", "ode:a=1,a=2", "o de", "ode:a=1,,b=2", "../x"})
        EXPECT_THROW((void)parseSpec(text), BadInput) << text;
    EXPECT_THROW((void)parseSpecList("rigor,,ode"), BadInput);
    EXPECT_THROW((void)parseSpecList("a=1"), BadInput);
}

TEST(Spec, PresetsFillWhatIsNotGiven) {
    const auto shipped = resolveSettings(parseSpec("toy"), OptionsOnly());
    EXPECT_EQ(shipped, (Settings{{"preset", "default"},
                                 {"precision", "f64"},
                                 {"solver", "fast"},
                                 {"iterations", "10"},
                                 {"slop", "0.01"}}));
    const auto matched = resolveSettings(parseSpec("toy:preset=matched,iterations=7"), OptionsOnly());
    EXPECT_EQ(matched, (Settings{{"preset", "matched"},
                                 {"precision", "f64"},
                                 {"solver", "exact"},
                                 {"iterations", "7"},
                                 {"slop", "0"}}));
}

TEST(Spec, AFurtherPresetStandsOnTheMatchedOne) {
    const auto rough = resolveSettings(parseSpec("toy:preset=rough,slop=0.2"), OptionsOnly());
    EXPECT_EQ(rough, (Settings{{"preset", "rough"},
                               {"precision", "f64"},
                               {"solver", "exact"},
                               {"iterations", "3"},
                               {"slop", "0.2"}}));
}

TEST(Spec, WrongKeysAndValuesNameWhatIsAllowed) {
    EXPECT_NE(messageOf("toy:sover=fast").find("did you mean 'solver'?"), std::string::npos);
    EXPECT_NE(messageOf("toy:solver=exakt").find("did you mean 'exact'?"), std::string::npos);
    EXPECT_NE(messageOf("toy:preset=matchd").find("did you mean 'matched'?"), std::string::npos);
    EXPECT_NE(messageOf("toy:solver=slow").find("fast, exact"), std::string::npos);
    EXPECT_NE(messageOf("toy:preset=best").find("'best', expected one of default, matched, rough"),
              std::string::npos);
    EXPECT_NE(messageOf("toy:precision=f16").find("f32, f64"), std::string::npos);
    for (const char* spec :
         {"toy:iterations=0", "toy:iterations=101", "toy:iterations=1.5", "toy:iterations=ten",
          "toy:slop=nan", "toy:slop=-1", "toy:slop=0x1", "toy:slop=1e999"})
        EXPECT_NE(messageOf(spec), "") << spec;
    EXPECT_EQ(messageOf("toy:iterations=100,slop=1e-3"), "");
}

TEST(Settings, NumbersAreReadExactly) {
    const Settings settings{{"a", "0.1"}, {"b", "1e-10"}, {"n", "12"}, {"bad", "1.5"}, {"text", "abc"}};
    EXPECT_EQ(numberSetting(settings, "a"), 0.1);
    EXPECT_EQ(numberSetting(settings, "b"), 1e-10);
    EXPECT_EQ(integerSetting(settings, "n"), 12);
    EXPECT_THROW((void)integerSetting(settings, "bad"), BadInput);
    EXPECT_THROW((void)numberSetting(settings, "text"), BadInput);
    EXPECT_THROW((void)numberSetting(settings, "absent"), BadInput);
}

TEST(Registry, AnEngineThatIsNotInstalledIsSaid) {
    try {
        (void)moduleFor(parseSpec("no_such_engine"));
        FAIL();
    } catch (const BadInput& error) {
        EXPECT_NE(std::string(error.what()).find("no_such_engine"), std::string::npos);
    }
}

}  // namespace
}  // namespace rigor::adapter
