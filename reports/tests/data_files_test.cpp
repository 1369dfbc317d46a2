// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "reports/encoding/data_files.hpp"

#include <gtest/gtest.h>

namespace rigor::report {
namespace {

TEST(DataFiles, Base64IsThatOfRfc4648) {
    EXPECT_EQ(base64(""), "");
    EXPECT_EQ(base64("f"), "Zg==");
    EXPECT_EQ(base64("fo"), "Zm8=");
    EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
    EXPECT_EQ(base64(std::string("\xff\xfe\x00", 3)), "//4A");
}

TEST(DataFiles, AreGzipInAScript) {
    const std::string file = dataFile("scenario-3", std::string(100000, 'x'));
    EXPECT_TRUE(file.starts_with("rigorData(\"scenario-3\",\"H4sI")) << file.substr(0, 60);
    EXPECT_TRUE(file.ends_with("\");\n"));
    EXPECT_LT(file.size(), 1000u);
}

TEST(DataFiles, NamesCannotLeaveTheScript) {
    EXPECT_THROW(dataFile("a\"b", ""), std::invalid_argument);
    EXPECT_THROW(dataFile("../a", ""), std::invalid_argument);
}

}  // namespace
}  // namespace rigor::report
