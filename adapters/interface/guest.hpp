// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Guests: engines that are programs of their own, in any language (adapters/guest/PROTOCOL.md). A guest is described by
// a manifest `rigor_adapter_<name>.json`, which is looked for where modules are. A module of its own, the guest host,
// starts the program and speaks with it.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "adapters/interface/engine.hpp"

namespace rigor::adapter {

/// Version of the protocol between the guest host and guests.
inline constexpr int kGuestProtocol = 1;

/// Kind of the limit on a guest's memory. Programs that reserve far more addresses than they use (WebAssembly does) need
/// the second.
enum class GuestMemory { AddressSpace, Resident };

/// A manifest after reading.
struct GuestManifest {
    std::filesystem::path file;
    std::string name;                  ///< name of the engine, and of the file
    std::string title;                 ///< shown while the guest is not installed
    std::vector<std::string> command;  ///< a program of PATH or of the folder, and its arguments
    std::filesystem::path folder;      ///< the program's working folder
    std::string precision, licence;    ///< "f32" or "f64"; SPDX expression of the engine
    std::string clock;                 ///< label of its timings: "native", "wasm", "interpreted"
    GuestMemory memory = GuestMemory::AddressSpace;
    double startSeconds = 20.0;      ///< longest time until the answer to the first request [s]
    double replySeconds = 60.0;      ///< longest time until any other answer [s]
    std::vector<std::string> needs;  ///< files that have to be there, relative to `folder`
    bool keepAlive = false;          ///< may serve several cases, one after the other
    std::string install;             ///< command that installs the missing files, for messages

    /// The first thing that is missing for the guest to run, or "".
    std::string missing() const;
};

/// Throws BadInput naming the file, the key, what was found and what was expected.
GuestManifest readGuestManifest(const std::filesystem::path& file);

/// Manifests on the path whose guests are not installed, sorted by name.
std::vector<GuestManifest> absentGuests();

/// The guest host's entry point, `rigorGuestHost`, in the module `rigor_guest_host.so`.
struct GuestHost {
    int abi = 0;
    std::unique_ptr<Engine> (*open)(const GuestManifest& manifest) = nullptr;
};

}  // namespace rigor::adapter
