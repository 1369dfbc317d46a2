// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "scenarios/exchange/common/report.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

namespace rigor::models {
namespace {

using nlohmann::json;

constexpr std::array<const char*, 4> kKinds{"changed", "no_physics", "left_out", "refused"};

std::string timesText(int count) {
    return count > 1 ? " (" + std::to_string(count) + " times)" : "";
}

}  // namespace

std::string Place::text() const {
    return line > 0 ? file + ":" + std::to_string(line) : file;
}

void Report::add(Remark remark) {
    for (Remark& old : remarks_)
        if (old.kind == remark.kind && old.element == remark.element && old.text == remark.text) {
            ++old.count;
            return;
        }
    remarks_.push_back(std::move(remark));
}

void Report::changed(const std::string& element, const Place& place, const std::string& text) {
    add({RemarkKind::Changed, element, text, "", place});
}

void Report::noPhysics(const std::string& element, const Place& place, const std::string& text) {
    add({RemarkKind::NoPhysics, element, text, "", place});
}

void Report::refuse(const std::string& element, const Place& place, const std::string& text) {
    add({RemarkKind::Refused, element, text, "", place});
}

bool Report::leavesOut(const std::string& feature, const std::string& element, const Place& place,
                       const std::string& text) {
    const bool out = without_.contains(feature);
    if (out) used_.insert(feature);
    add({out ? RemarkKind::LeftOut : RemarkKind::Refused, element, text, feature, place});
    return out;
}

bool Report::isRefused() const {
    return std::any_of(remarks_.begin(), remarks_.end(),
                       [](const Remark& r) { return r.kind == RemarkKind::Refused; });
}

std::vector<std::string> Report::unusedWords() const {
    std::vector<std::string> unused;
    std::set_difference(without_.begin(), without_.end(), used_.begin(), used_.end(),
                        std::back_inserter(unused));
    return unused;
}

json Report::json() const {
    nlohmann::json list = nlohmann::json::array();
    for (const Remark& r : remarks_)
        list.push_back({{"kind", kKinds[static_cast<std::size_t>(r.kind)]},
                        {"element", r.element},
                        {"text", r.text},
                        {"feature", r.feature},
                        {"file", r.place.file},
                        {"line", r.place.line},
                        {"count", r.count}});
    return {{"remarks", list}, {"unused_words", unusedWords()}, {"without", without_}};
}

Report Report::fromJson(const nlohmann::json& from) {
    Report report(from.at("without").get<std::set<std::string>>());
    for (const auto& unused : from.at("unused_words")) (void)unused;
    report.used_ = report.without_;
    for (const auto& unused : from.at("unused_words")) report.used_.erase(unused.get<std::string>());
    for (const auto& r : from.at("remarks")) {
        const auto kind = std::find(kKinds.begin(), kKinds.end(), r.at("kind").get<std::string>());
        report.remarks_.push_back({static_cast<RemarkKind>(kind - kKinds.begin()),
                                   r.at("element").get<std::string>(),
                                   r.at("text").get<std::string>(),
                                   r.at("feature").get<std::string>(),
                                   {r.at("file").get<std::string>(), r.at("line").get<int>()},
                                   r.at("count").get<int>()});
    }
    return report;
}

std::string Report::text() const {
    std::string out;
    for (const Remark& r : remarks_)
        if (r.kind == RemarkKind::Refused) {
            out += r.place.text() + ": " + r.element + ": " + r.text + timesText(r.count);
            if (!r.feature.empty()) out += "; leave out with --without " + r.feature;
            out += "\n";
        }
    const auto list = [&](RemarkKind kind, const std::string& title) {
        std::string lines;
        for (const Remark& r : remarks_)
            if (r.kind == kind)
                lines += "  " + r.place.text() + ": " + r.element + ": " + r.text + timesText(r.count) + "\n";
        if (!lines.empty()) out += title + ":\n" + lines;
    };
    list(RemarkKind::Changed, "Said in another way");
    list(RemarkKind::LeftOut, "Left out by --without");
    list(RemarkKind::NoPhysics, "Not part of the physics");
    for (const std::string& word : unusedWords())
        out += "--without " + word + ": the file has nothing of this name to leave out\n";
    return out;
}

}  // namespace rigor::models
