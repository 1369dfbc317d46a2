// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/runner/fork_server.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdint>

#include "validation/results/files.hpp"
#include "validation/runner/descendants.hpp"
#include "validation/runner/serve.hpp"
#include "validation/runner/start_program.hpp"

namespace rigor::validation {
namespace {

constexpr int kMostFailures = 2;
/// A server that needs longer to load its module is used once it has done so.
constexpr std::chrono::milliseconds kLoading{2000};

bool isReadable(int socket, std::chrono::milliseconds limit) {
    const auto end = std::chrono::steady_clock::now() + limit;
    for (;;) {
        const auto left =
            std::chrono::ceil<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
        pollfd file{socket, POLLIN, 0};
        const int found = poll(&file, 1, static_cast<int>(std::max<std::int64_t>(left.count(), 0)));
        if (found >= 0 || errno != EINTR) return found > 0;
    }
}

/// The process that a server forked for a request; negative if it did not.
pid_t answerOf(int socket, std::chrono::milliseconds mostSilence) {
    if (!isReadable(socket, mostSilence))
        shutdown(socket, SHUT_RDWR);  // a child cannot report itself from here on
    ForkAnswer answer;
    ssize_t n = 0;
    do n = recv(socket, &answer, sizeof answer, MSG_DONTWAIT);
    while (n < 0 && errno == EINTR);
    return n == static_cast<ssize_t>(sizeof answer) ? answer.pid : -1;
}

}  // namespace

std::optional<std::filesystem::path> servedModule(const adapter::EngineSpec& spec) {
    try {
        auto module = adapter::moduleFor(spec);
        if (module.extension() == ".so") return module;
    } catch (const adapter::BadInput&) {  // the child says what is wrong
    }
    return std::nullopt;
}

ForkServers::~ForkServers() {
    endAll();
}

void ForkServers::endAll() {
    for (auto& [module, server] : servers_) end(server);
    servers_.clear();
}

void ForkServers::end(Server& server) {
    if (server.pid < 0) return;
    kill(-server.pid, SIGKILL);
    while (waitpid(server.pid, nullptr, 0) < 0 && errno == EINTR) {
    }
    killDescendants(server.pid);
    close(server.socket);
    server.pid = server.socket = -1;
    server.isReady = false;
}

void ForkServers::launch(Server& server, const std::string& binary, const std::filesystem::path& module) {
    int ends[2];
    const int null = open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (null < 0 || socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) {
        if (null >= 0) close(null);
        return;
    }
    try {
        server.pid = startProgram({binary, kServeCommand, module.string(), std::to_string(ends[1]),
                                   std::string(kRoomForArguments, ' ')},
                                  null, 0, {ends[1]}, std::string(kBindNow) + "=1");
        server.socket = ends[0];
    } catch (const results::EnvironmentError&) {
        close(ends[0]);
    }
    close(ends[1]);
    close(null);
}

bool ForkServers::makeReady(Server& server, const std::string& binary, const std::filesystem::path& module) {
    if (server.isReady) return true;
    const bool isNew = server.pid < 0;
    if (isNew) {
        if (server.failures >= kMostFailures) return false;
        launch(server, binary, module);
        if (server.pid < 0) return false;
    }
    if (!isReadable(server.socket, isNew ? kLoading : std::chrono::milliseconds(0))) return false;
    bool isClean = false;
    const ssize_t n = recv(server.socket, &isClean, sizeof isClean, MSG_DONTWAIT);
    server.isReady = n == 1 && isClean;
    if (!server.isReady) {
        end(server);
        server.failures = n == 1 ? kMostFailures : server.failures + 1;
    }
    return server.isReady;
}

std::optional<pid_t> ForkServers::start(const std::filesystem::path& module,
                                        const std::vector<std::string>& arguments, int output,
                                        std::size_t memoryMiB) {
    if (isSanitized()) return std::nullopt;  // a sanitizer has to know of every fork
    Server& server = servers_[module];
    while (makeReady(server, arguments.front(), module)) {
        if (sendRequest(server.socket, {arguments, memoryMiB, output}))
            if (const pid_t pid = answerOf(server.socket, mostSilence_); pid > 0) return pid;
        end(server);
        ++server.failures;
    }
    return std::nullopt;
}

}  // namespace rigor::validation
