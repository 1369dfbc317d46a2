// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <algorithm>

#include "adapters/guest/frame.hpp"
#include "adapters/interface/capability_fields.hpp"
#include "validation/fuzz/targets.hpp"

namespace rigor::fuzz {

void readFrames(const std::string& bytes) {
    if (bytes.empty()) return;
    const std::size_t piece = 1 + static_cast<unsigned char>(bytes[0]);
    guest::FrameReader reader;
    try {
        for (std::size_t at = 1; at < bytes.size(); at += piece) {
            reader.append(bytes.data() + at, std::min(piece, bytes.size() - at));
            while (const auto frame = reader.next()) {
                (void)guest::encode(*frame);
                try {
                    const guest::Table states = frame->table("states", 13);
                    if (states.values.size() != states.rows * states.columns)
                        throw std::logic_error("a table without its values");
                } catch (const guest::BadFrame&) {
                    // The array is missing or has another shape.
                }
                try {
                    (void)frame->bytes("snapshot");
                } catch (const guest::BadFrame&) {
                    // As above.
                }
                try {
                    (void)adapter::capabilitiesFromJson(
                        frame->header.value("capabilities", guest::Json::object()));
                } catch (const guest::Json::exception&) {
                    // A description that lacks something.
                }
            }
        }
    } catch (const guest::BadFrame&) {
        // The bytes were refused.
    }
}

}  // namespace rigor::fuzz
