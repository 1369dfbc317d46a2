// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Messages about values of options: numbers, empty texts, names.
#include <gtest/gtest.h>

#include <filesystem>

#include "cli/tests/program.hpp"

namespace {

using rigor::cli_test::Result;
using rigor::cli_test::rigor;

TEST(Options, MessagesOfNumericOptionsSayWhatIsExpected) {
    struct Row {
        const char *arguments, *message;
    };
    for (const auto& [arguments, message] :
         {Row{"solve x --iterations ten",
              "--iterations: found 'ten', expected a whole number from 1 to 100000000"},
          Row{"validate -j 0", "--jobs: found '0', expected a whole number from 1 to 1024"},
          Row{"compare a b --tolerance 11", "--tolerance: found '11', expected a number from 0 to 10"},
          Row{"compare a b --limit -1", "--limit: found '-1', expected a whole number, 0 or greater"},
          Row{"draw x --at abc", "--at: found 'abc', expected a number"},
          Row{"draw x --at nan", "--at: found 'nan', expected a number"},
          Row{"import mesh x --floor low", "--floor: found 'low', expected a number"},
          Row{"validate --reference-limit 0",
              "--reference-limit: found '0', expected a number greater than 0"},
          Row{"freeze x --out y --time -1", "--time: found '-1', expected a number, 0 or greater"}}) {
        const Result result = rigor(arguments);
        EXPECT_EQ(result.code, 2) << arguments;
        EXPECT_NE(result.out.find(message), std::string::npos) << arguments << "\n" << result.out;
    }
}

TEST(Options, AnEmptyTextIsNoOptionThatWasLeftOut) {
    const Result out = rigor("validate smoke --out ''");
    EXPECT_EQ(out.code, 2);
    EXPECT_NE(out.out.find("validate: --out: found '', expected a text that is not empty"), std::string::npos)
        << out.out;
    EXPECT_EQ(rigor("compare a ''").code, 2);
}

TEST(Options, ANewEngineHasANameThatIsFree) {
    const auto folder = std::filesystem::path(testing::TempDir()) / "taken_name";
    const Result taken = rigor("new engine bullet --folder " + folder.string());
    EXPECT_EQ(taken.code, 2);
    EXPECT_NE(taken.out.find("found 'bullet', which is that of an engine"), std::string::npos) << taken.out;
    EXPECT_FALSE(std::filesystem::exists(folder));
}

TEST(Options, OnlyNearNamesAreSuggested) {
    EXPECT_EQ(rigor("conform nope").out.find("did you mean"), std::string::npos);
    EXPECT_NE(rigor("conform bulet").out.find("did you mean 'bullet'?"), std::string::npos);
}

}  // namespace
