// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The side of a fork server (fork_server.hpp) that forks, and what the two sides send each other.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace rigor::validation {

inline constexpr const char* kServeCommand = "__serve";

/// A child that is to be forked. The first argument is the program's file.
struct ForkRequest {
    std::vector<std::string> arguments;
    std::size_t memoryMiB = 0;  ///< limit of its address space; 0: none
    int output = -1;            ///< its stdout and stderr
};
/// The forked process, by itself; negative, by the server, if there is none.
struct ForkAnswer {
    pid_t pid = -1;
};

/// Bytes of a server's last argument: a child writes its own arguments over those of its server, so that the list of
/// processes shows what it does.
inline constexpr std::size_t kRoomForArguments = 512;

/// A variable of the environment, by which the loader looks up all functions of a server's libraries when it starts.
/// Otherwise each child would look up by itself those that it calls.
inline constexpr const char* kBindNow = "LD_BIND_NOW";

/// False if the server has ended, or takes nothing.
bool sendRequest(int socket, const ForkRequest& request);

/// Loads `module` ("": none) and says on `socket` by one byte whether this process is clean. Then it forks for every
/// request, and returns in each child with its arguments, without the program's file. Ends this process at the end of
/// the requests.
std::vector<std::string> serveRequests(const std::filesystem::path& module, int socket);

}  // namespace rigor::validation
