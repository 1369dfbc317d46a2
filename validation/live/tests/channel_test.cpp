// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/live/channel.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace rigor::validation {
namespace {

Packet example() {
    Packet packet;
    packet.header["name"] = "stück";
    packet.arrays.add("large", std::vector<double>(200000, 0.5));  // more than a socket holds
    return packet;
}

TEST(Channels, CarryPacketsAndKnowTheirEnd) {
    auto [here, file] = makeChannel();
    {
        Channel there(file);
        std::thread sender([&there] { EXPECT_TRUE(there.send(example())); });
        Packet got;
        EXPECT_EQ(here.receive(got, Channel::Clock::now() + std::chrono::seconds(5)),
                  Channel::Received::Packet);
        sender.join();
        EXPECT_EQ(got.header["name"], "stück");
        EXPECT_EQ(got.arrays.doubles("large").size(), 200000u);
        EXPECT_EQ(here.receive(got, Channel::Clock::now() + std::chrono::milliseconds(20)),
                  Channel::Received::Timeout);
    }
    Packet got;
    EXPECT_EQ(here.receive(got, Channel::Clock::now() + std::chrono::seconds(5)), Channel::Received::End);
    EXPECT_FALSE(here.send(example()));
}

}  // namespace
}  // namespace rigor::validation
