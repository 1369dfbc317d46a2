// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A process may be forked for a case if it is in the state in which a process is that has just loaded the module by
// itself. A fork keeps memory, but no other thread; it shares open files, shared memory and children of the process.
// None of these may be there, and loading may not have changed the floating-point environment, which a process that
// loads the module itself reports. The program and HDF5 do none of this.
#include "validation/runner/serve.hpp"

#include <fcntl.h>
#include <linux/sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/random.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>

#include "adapters/interface/registry.hpp"
#include "scenarios/loader/loader.hpp"
#include "scenarios/loader/schema_check.hpp"
#include "validation/results/hdf5_file.hpp"
#include "validation/runner/child.hpp"
#include "validation/runner/descendants.hpp"
#include "validation/runner/start_program.hpp"

namespace rigor::validation {
namespace {

namespace fs = std::filesystem;
constexpr std::size_t kMostBytes = 1 << 16;  ///< bytes of a request

/// Places in the memory of this process (proc(5)): its arguments, as the list of processes shows them, and its heap.
class OwnMemory {
  public:
    OwnMemory() {
        std::ifstream in("/proc/self/stat");
        std::string text((std::istreambuf_iterator<char>(in)), {});
        std::istringstream fields(text.substr(text.rfind(')') + 1));
        std::string skipped;
        constexpr int kBeforeHeap = 44;  // fields 3 to 46
        for (int i = 0; i < kBeforeHeap; ++i) fields >> skipped;
        std::uintptr_t heap = 0, begin = 0, end = 0;
        if (!(fields >> heap >> begin >> end) || begin == 0 || end <= begin) return;
        heap_ = reinterpret_cast<char*>(heap);
        begin_ = reinterpret_cast<char*>(begin);
        size_ = end - begin;
    }
    std::string program() const { return begin_ == nullptr ? "" : begin_; }
    void write(const std::vector<std::string>& arguments) {
        std::string line;
        for (const std::string& argument : arguments) line += argument + '\0';
        if (line.size() < size_) {
            std::memset(begin_, 0, size_);
            std::memcpy(begin_, line.data(), line.size());
        }
    }

    /// Copies the pages of the heap that a fork shares with its server, all at once. Each of them would otherwise be
    /// copied when it is first written, with a page fault of its own. A system that cannot do this does that.
    void copyHeap() const {
        const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
        const auto begin = reinterpret_cast<std::uintptr_t>(heap_) / page * page;
        const auto end = reinterpret_cast<std::uintptr_t>(sbrk(0));
        if (begin != 0 && end > begin)
            (void)madvise(reinterpret_cast<void*>(begin), end - begin, MADV_POPULATE_WRITE);
    }

  private:
    char *begin_ = nullptr, *heap_ = nullptr;
    std::size_t size_ = 0;
};

/// Counts of what a process shares with its forks, or does not hand on to them.
struct Footprint {
    std::ptrdiff_t threads = 0, files = 0, sharedMemory = 0, children = 0;

    Footprint() {
        threads = std::distance(fs::directory_iterator("/proc/self/task"), {});
        files = std::distance(fs::directory_iterator("/proc/self/fd"), {});
        std::ifstream maps("/proc/self/maps");
        for (std::string line; std::getline(maps, line);) {
            const auto rights = line.find(' ') + 1;  // "rw-s"
            if (line.compare(rights + 1, 1, "w") == 0 && line.compare(rights + 3, 1, "s") == 0)
                ++sharedMemory;
        }
        std::ifstream list("/proc/self/task/" + std::to_string(getpid()) + "/children");
        for (pid_t child = 0; list >> child;) ++children;
    }
    bool isClean(const Footprint& before) const {
        return threads == 1 && files == before.files && sharedMemory == before.sharedMemory && children == 0;
    }
};

/// Records of the C library about this thread: its number, and the list of locks that the kernel opens at its end. In a
/// fork that the library did not make they are those of another thread.
struct ThreadRecords {
    int* number = nullptr;
    void* locks = nullptr;
    std::size_t locksSize = 0;

    bool find() {
        return prctl(PR_GET_TID_ADDRESS, &number, 0, 0, 0) == 0 && number != nullptr && *number == getpid() &&
               syscall(SYS_get_robust_list, 0, &locks, &locksSize) == 0;
    }
};

/// Forks this process, which has one thread: the new one is a child of this one's parent. fork() cannot do that.
pid_t forkForParent(const ThreadRecords& thread) {
    clone_args call{};
    call.flags =
        CLONE_PARENT | CLONE_CHILD_SETTID | CLONE_CHILD_CLEARTID;  // it ends with this one's signal, SIGCHLD
    call.child_tid = reinterpret_cast<std::uintptr_t>(thread.number);
    const auto pid = static_cast<pid_t>(syscall(SYS_clone3, &call, sizeof call));
    if (pid == 0) syscall(SYS_set_robust_list, thread.locks, thread.locksSize);
    return pid;
}

/// Does what every case would do first: HDF5 makes its tables and an empty file, and the schema of scenarios is compiled.
void prepareLibraries() {
    results::prepareHdf5File();
    try {
        scenario::checkScenarioSchema(scenario::parseDocument("{}", ""), "");
    } catch (const scenario::LoadError&) {  // it is no scenario
    }
}

/// Loads a module and reads its options, as every case does first. False if that changes the floating-point environment.
bool isLoadedCleanly(const fs::path& module) {
    const adapter::LoadedEngine engine(module);
    (void)engine->options();
    return engine.environmentChanges().empty();
}

ForkRequest receiveRequest(int socket) {
    static char bytes[kMostBytes];  // Forks touch no more of it than the request.
    iovec part{bytes, sizeof bytes};
    alignas(cmsghdr) char control[CMSG_SPACE(sizeof(int))];
    msghdr message{};
    message.msg_iov = &part;
    message.msg_iovlen = 1;
    message.msg_control = control;
    message.msg_controllen = sizeof control;
    ssize_t n = 0;
    do n = recvmsg(socket, &message, MSG_CMSG_CLOEXEC);
    while (n < 0 && errno == EINTR);
    const cmsghdr* header = n > 0 ? CMSG_FIRSTHDR(&message) : nullptr;
    if (header == nullptr || header->cmsg_type != SCM_RIGHTS) _exit(n == 0 ? 0 : kExitEnvironment);
    ForkRequest request;
    std::memcpy(&request.output, CMSG_DATA(header), sizeof request.output);
    std::memcpy(&request.memoryMiB, bytes, sizeof request.memoryMiB);
    for (auto at = sizeof request.memoryMiB; at < static_cast<std::size_t>(n);) {
        request.arguments.emplace_back(bytes + at);
        at += request.arguments.back().size() + 1;
    }
    return request;
}

bool report(int socket, pid_t pid) {
    const ForkAnswer answer{pid};
    return send(socket, &answer, sizeof answer, MSG_NOSIGNAL) == static_cast<ssize_t>(sizeof answer);
}

/// Moves the heap and later mappings by a random number of pages. A started program has them at random addresses; in
/// forks at the same ones an engine whose results depend on addresses would look deterministic.
void moveAddresses() {
    constexpr std::uintptr_t kMostPages = 1024;
    std::array<std::uint16_t, 2> random{};
    if (getrandom(random.data(), sizeof random, 0) != static_cast<ssize_t>(sizeof random)) return;
    const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
    (void)sbrk(static_cast<std::intptr_t>((1 + random[0] % kMostPages) * page));
    (void)mmap(nullptr, (1 + random[1] % kMostPages) * page, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
}

/// The first steps of a forked child. A parent that gave up waiting for its report starts the case anew: then this
/// process must not go on. From the report on it is one that others may look for and stop.
void becomeChild(const ForkRequest& request, OwnMemory& memory, pid_t parent, int socket) {
    settleChild(parent, request.memoryMiB);
    dup2(request.output, STDOUT_FILENO);
    dup2(request.output, STDERR_FILENO);
    close(request.output);
    if (char* mark = std::getenv(kAncestorVariable)) setMarkedChild(mark, getpid());
    if (!report(socket, getpid())) _exit(kExitEnvironment);
    close(socket);
    memory.copyHeap();
    moveAddresses();
    memory.write(request.arguments);
}

}  // namespace

bool sendRequest(int socket, const ForkRequest& request) {
    std::string bytes(reinterpret_cast<const char*>(&request.memoryMiB), sizeof request.memoryMiB);
    for (const std::string& argument : request.arguments) bytes += argument + '\0';
    if (bytes.size() > kMostBytes) return false;
    iovec part{bytes.data(), bytes.size()};
    alignas(cmsghdr) char control[CMSG_SPACE(sizeof(int))]{};
    msghdr message{};
    message.msg_iov = &part;
    message.msg_iovlen = 1;
    message.msg_control = control;
    message.msg_controllen = sizeof control;
    cmsghdr* header = CMSG_FIRSTHDR(&message);
    header->cmsg_level = SOL_SOCKET;
    header->cmsg_type = SCM_RIGHTS;
    header->cmsg_len = CMSG_LEN(sizeof(int));
    std::memcpy(CMSG_DATA(header), &request.output, sizeof(int));
    return sendmsg(socket, &message, MSG_NOSIGNAL | MSG_DONTWAIT) == static_cast<ssize_t>(bytes.size());
}

std::vector<std::string> serveRequests(const fs::path& module, int socket) {
    fcntl(socket, F_SETFD, FD_CLOEXEC);
    unsetenv(kBindNow);
    const pid_t parent = getppid();
    OwnMemory memory;
    ThreadRecords thread;
    const Footprint before;
    prepareLibraries();
    bool isClean = thread.find();
    if (!module.empty()) isClean &= isLoadedCleanly(module);
    isClean &= Footprint().isClean(before);
    memory.write({memory.program(), kServeCommand, module.string()});
    std::fflush(nullptr);
    (void)send(socket, &isClean, sizeof isClean, MSG_NOSIGNAL);
    for (;;) {
        const ForkRequest request = receiveRequest(socket);
        const pid_t child = forkForParent(thread);
        if (child == 0) {
            becomeChild(request, memory, parent, socket);
            return {request.arguments.begin() + 1, request.arguments.end()};
        }
        close(request.output);
        if (child < 0) (void)report(socket, -1);
    }
}

}  // namespace rigor::validation
