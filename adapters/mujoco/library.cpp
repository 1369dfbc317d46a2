// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/mujoco/library.hpp"

#include <cstring>
#include <mutex>
#include <stdexcept>

namespace rigor::mujoco {
namespace {

/// MuJoCo ends the process after its handler returns.
[[noreturn]] void throwError(const char* message) {
    throw std::runtime_error(std::string("MuJoCo error: ") + message);
}

void ignoreWarning(const char*) {}

/// Nonzero: no contact between these two geoms.
int filterContact(const mjModel* model, mjData* data, int geom1, int geom2) {
    const ContactFilterData* filter = nullptr;
    if (model->nuserdata < 1) return 0;
    std::memcpy(&filter, data->userdata, sizeof filter);
    if (filter == nullptr) return 0;
    const auto &a = filter->shapes[geom1], &b = filter->shapes[geom2];
    return filter->pairs->mayCollide(a.body, b.body) &&
                   filter->pairs->shapesMayTouch(a.body, a.shape, b.body, b.shape)
               ? 0
               : 1;
}

}  // namespace

void useLibrary() {
    static std::once_flag once;
    std::call_once(once, [] {
        mju_user_error = throwError;
        mju_user_warning = ignoreWarning;
        mjcb_contactfilter = filterContact;
    });
}

void setFilter(mjData& data, const ContactFilterData* filter) {
    static_assert(sizeof filter <= sizeof(mjtNum));
    std::memcpy(data.userdata, &filter, sizeof filter);
}

ModelOwner compile(const std::string& mjcf) {
    static std::mutex mutex;  // the compiler keeps the last model in a global
    const std::lock_guard lock(mutex);
    const auto files = std::make_unique_for_overwrite<mjVFS>();  // 2 MB
    mj_defaultVFS(files.get());
    const char* name = "scenario.xml";
    const int size = static_cast<int>(mjcf.size());
    if (mj_makeEmptyFileVFS(files.get(), name, size) != 0)
        throw std::runtime_error("MuJoCo: the model's text does not fit into its file system");
    std::memcpy(files->filedata[mj_findFileVFS(files.get(), name)], mjcf.data(), mjcf.size());
    char error[1000] = "";
    ModelOwner model(mj_loadXML(name, files.get(), error, sizeof error));
    mj_deleteVFS(files.get());
    mj_freeLastXML();
    if (!model) throw std::runtime_error(std::string("MuJoCo's compiler: ") + error);
    return model;
}

}  // namespace rigor::mujoco
