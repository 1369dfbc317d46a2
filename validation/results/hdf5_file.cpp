// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/results/hdf5_file.hpp"

#include <hdf5.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <utility>

#include "validation/results/files.hpp"

namespace rigor::results {
namespace {

constexpr std::size_t kChunkThreshold = 8192;  ///< values; smaller sets gain nothing from compression
constexpr hsize_t kChunkValues = 16384;        ///< about 128 KiB of doubles per chunk
constexpr unsigned kDeflateLevel = 1;
constexpr hsize_t kMostValues = hsize_t{1} << 28;  ///< values of a dataset: a small file can claim any number
constexpr hsize_t kMostColumns = 1 << 16;
constexpr std::size_t kMostTextBytes = 16 << 20;
constexpr std::size_t kMemoryIncrement = 1 << 16;  ///< growth of a file in memory [bytes]

[[noreturn]] void failed(const std::string& what) {
    throw std::runtime_error("HDF5: cannot " + what);
}

class Handle {
  public:
    Handle(hid_t id, herr_t (*closer)(hid_t), const std::string& what) : id_(id), closer_(closer) {
        if (id < 0) failed(what);
    }
    ~Handle() { closer_(id_); }
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    operator hid_t() const { return id_; }

  private:
    hid_t id_;
    herr_t (*closer_)(hid_t);
};

void check(herr_t status, const std::string& what) {
    if (status < 0) failed(what);
}

/// We report failures ourselves; the library would print its stack to stderr.
void silence() {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

void setAttribute(hid_t object, const std::string& path, const char* name, hid_t type, const void* value) {
    const std::string what = "write attribute " + path + "@" + name;
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose, what);
    const Handle attribute(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, what);
    check(H5Awrite(attribute, type, value), what);
}

/// The library writes as many values as the file has, wherever they go.
void requireOne(hid_t attribute, const std::string& what) {
    const Handle space(H5Aget_space(attribute), H5Sclose, what);
    if (H5Sget_simple_extent_npoints(space) != 1) failed(what + ": it has not one value");
}

/// Length of a text of fixed size, its terminating zero included.
std::size_t textSize(hid_t type, const std::string& what) {
    const std::size_t size = H5Tget_size(type);
    if (size == 0 || size > kMostTextBytes) failed(what + ": a text of " + std::to_string(size) + " bytes");
    return size;
}

void getAttribute(hid_t object, const std::string& path, const char* name, hid_t type, void* value) {
    const std::string what = "read attribute " + path + "@" + name;
    const Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose, what);
    requireOne(attribute, what);
    check(H5Aread(attribute, type, value), what);
}

/// Returns the new dataset.
template <class T>
hid_t writeValues(hid_t file, const std::string& path, const std::vector<T>& values, int columns,
                  hid_t memoryType, hid_t fileType) {
    const std::string what = "write " + path;
    if (columns < 1 || values.size() % static_cast<std::size_t>(columns) != 0)
        failed(what + ": " + std::to_string(values.size()) + " values in " + std::to_string(columns) +
               " columns");
    const hsize_t width = columns;
    const hsize_t extent[2] = {values.size() / width, width};
    const Handle space(H5Screate_simple(columns == 1 ? 1 : 2, extent, nullptr), H5Sclose, what);
    const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, what);
    check(H5Pset_obj_track_times(properties, false), what);  // the same data makes the same file
    if (values.size() >= kChunkThreshold) {
        const hsize_t chunk[2] = {std::min<hsize_t>(extent[0], std::max<hsize_t>(1, kChunkValues / width)),
                                  width};
        check(H5Pset_chunk(properties, columns == 1 ? 1 : 2, chunk), what);
        check(H5Pset_shuffle(properties), what);
        check(H5Pset_deflate(properties, kDeflateLevel), what);
    }
    const hid_t set = H5Dcreate2(file, path.c_str(), fileType, space, H5P_DEFAULT, properties, H5P_DEFAULT);
    if (set < 0) failed(what);
    if (!values.empty() && H5Dwrite(set, memoryType, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0) {
        H5Dclose(set);
        failed(what);
    }
    return set;
}

template <class T>
std::vector<T> readValues(hid_t set, const std::string& path, int& columns, hid_t memoryType) {
    const std::string what = "read " + path;
    const Handle space(H5Dget_space(set), H5Sclose, what);
    const int rank = H5Sget_simple_extent_ndims(space);
    if (rank != 1 && rank != 2) failed(what + ": it has neither one nor two dimensions");
    hsize_t extent[2] = {0, 1};
    H5Sget_simple_extent_dims(space, extent, nullptr);
    if (extent[0] > kMostValues || extent[1] > kMostColumns || extent[0] * extent[1] > kMostValues)
        failed(what + ": " + std::to_string(extent[0]) + " rows of " + std::to_string(extent[1]) +
               " values are too many");
    columns = static_cast<int>(extent[1]);
    std::vector<T> values(extent[0] * extent[1]);
    if (!values.empty()) check(H5Dread(set, memoryType, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), what);
    return values;
}

}  // namespace

/// A file in memory, of which the library gives the content only when it closes it: it frees its buffer then.
struct Hdf5File::Image {
    std::size_t size = 0;  ///< length of the file, less than that of the buffer
    std::string bytes;
};

namespace {

void* allocateImage(std::size_t size, H5FD_file_image_op_t, void*) {
    return std::malloc(size);
}
void* copyImage(void* to, const void* from, std::size_t size, H5FD_file_image_op_t, void*) {
    return std::memcpy(to, from, size);
}
void* resizeImage(void* buffer, std::size_t size, H5FD_file_image_op_t, void*) {
    return std::realloc(buffer, size);
}
template <class Image>
herr_t take(void* buffer, H5FD_file_image_op_t when, void* image) {
    auto* target = static_cast<Image*>(image);
    if (when == H5FD_FILE_IMAGE_OP_FILE_CLOSE)
        target->bytes.assign(static_cast<const char*>(buffer), target->size);
    std::free(buffer);
    return 0;
}
void* sameImage(void* image) {
    return image;
}
herr_t keepImage(void*) {
    return 0;
}

/// A name that no other file in memory has. The library would open a second time one that is open under the name given.
std::string uniqueName() {
    static int count = 0;
    return "memory " + std::to_string(++count);
}

std::optional<Hdf5File>& preparedFile() {
    static std::optional<Hdf5File> file;
    return file;
}

}  // namespace

Hdf5File Hdf5File::create() {
    if (auto prepared = std::exchange(preparedFile(), std::nullopt)) return std::move(*prepared);
    silence();
    const std::string what = "create a file";
    const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, what);
    check(H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_V18), what);  // readable by old tools
    const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose, what);
    check(H5Pset_obj_track_times(creation, false), what);
    auto image = std::make_unique<Image>();
    check(H5Pset_fapl_core(access, kMemoryIncrement, false), what);
    H5FD_file_image_callbacks_t callbacks{allocateImage, copyImage, resizeImage, take<Image>,
                                          sameImage,     keepImage, image.get()};
    check(H5Pset_file_image_callbacks(access, &callbacks), what);
    const hid_t id = H5Fcreate(uniqueName().c_str(), H5F_ACC_TRUNC, creation, access);
    if (id < 0) failed(what);
    return Hdf5File(id, std::move(image));
}

Hdf5File Hdf5File::open(const std::filesystem::path& file) {
    return fromImage(readFile(file));
}

Hdf5File Hdf5File::fromImage(const std::string& bytes) {
    silence();
    const std::string what = "open it: it is no HDF5 file, or a damaged one";
    if (bytes.empty()) failed(what);
    const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, what);
    check(H5Pset_fapl_core(access, kMemoryIncrement, false), what);
    check(H5Pset_file_image(access, const_cast<char*>(bytes.data()), bytes.size()), what);
    const hid_t id = H5Fopen(uniqueName().c_str(), H5F_ACC_RDONLY, access);
    if (id < 0) failed(what);
    return Hdf5File(id, nullptr);
}

Hdf5File::Hdf5File(std::int64_t id, std::unique_ptr<Image> image) : id_(id), image_(std::move(image)) {}

Hdf5File::Hdf5File(Hdf5File&& other) noexcept
    : id_(std::exchange(other.id_, -1)),
      image_(std::move(other.image_)),
      object_(std::exchange(other.object_, -1)),
      objectPath_(std::move(other.objectPath_)) {}

Hdf5File::~Hdf5File() {
    keepOpen(-1, "");
    if (id_ >= 0) H5Fclose(id_);
}

void Hdf5File::keepOpen(std::int64_t object, const std::string& path) const {
    if (object_ >= 0) H5Oclose(object_);
    object_ = object;
    objectPath_ = path;
}

std::int64_t Hdf5File::objectAt(const std::string& path) const {
    if (object_ >= 0 && objectPath_ == path) return object_;
    const hid_t object = H5Oopen(id_, path.c_str(), H5P_DEFAULT);
    if (object < 0) failed("open " + path);
    keepOpen(object, path);
    return object_;
}

std::string Hdf5File::finish() {
    const std::string what = "collect the bytes of the file";
    keepOpen(-1, "");
    check(H5Fflush(id_, H5F_SCOPE_GLOBAL), what);
    // H5Fget_file_image would give the content as well, but damages the checksum of the superblock (1.10.8).
    const ssize_t size = H5Fget_file_image(id_, nullptr, 0);
    if (size < 0) failed(what);
    image_->size = static_cast<std::size_t>(size);
    check(H5Fclose(std::exchange(id_, -1)), what);
    return std::move(image_->bytes);
}

void Hdf5File::createGroup(const std::string& path) {
    const std::string what = "create group " + path;
    const Handle properties(H5Pcreate(H5P_GROUP_CREATE), H5Pclose, what);
    check(H5Pset_obj_track_times(properties, false), what);
    const hid_t group = H5Gcreate2(id_, path.c_str(), H5P_DEFAULT, properties, H5P_DEFAULT);
    if (group < 0) failed(what);
    keepOpen(group, path);
}

bool Hdf5File::exists(const std::string& path) const {
    return H5Lexists(id_, path.c_str(), H5P_DEFAULT) > 0;
}

std::vector<std::string> Hdf5File::children(const std::string& path) const {
    const std::string what = "list " + path;
    std::vector<std::string> names;
    const Handle group(H5Gopen2(id_, path.c_str(), H5P_DEFAULT), H5Gclose, what);
    const auto add = [](hid_t, const char* name, const H5L_info_t*, void* list) -> herr_t {
        static_cast<std::vector<std::string>*>(list)->push_back(name);
        return 0;
    };
    check(H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, nullptr, add, &names), what);
    return names;
}

void Hdf5File::writeDoubles(const std::string& path, const std::vector<double>& values, int columns,
                            const std::string& unit) {
    keepOpen(writeValues(id_, path, values, columns, H5T_NATIVE_DOUBLE, H5T_IEEE_F64LE), path);
    setText(path, "unit", unit);
}
void Hdf5File::writeIntegers(const std::string& path, const std::vector<int>& values, int columns,
                             const std::string& unit) {
    keepOpen(writeValues(id_, path, values, columns, H5T_NATIVE_INT, H5T_STD_I32LE), path);
    setText(path, "unit", unit);
}
std::vector<double> Hdf5File::readDoubles(const std::string& path, int& columns) const {
    return readValues<double>(objectAt(path), path, columns, H5T_NATIVE_DOUBLE);
}
std::vector<int> Hdf5File::readIntegers(const std::string& path, int& columns) const {
    return readValues<int>(objectAt(path), path, columns, H5T_NATIVE_INT);
}

void Hdf5File::writeText(const std::string& path, const std::string& text) {
    const std::string what = "write " + path;
    const Handle type(H5Tcopy(H5T_C_S1), H5Tclose, what);
    check(H5Tset_size(type, text.size() + 1), what);
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose, what);
    const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, what);
    check(H5Pset_obj_track_times(properties, false), what);
    const Handle set(H5Dcreate2(id_, path.c_str(), type, space, H5P_DEFAULT, properties, H5P_DEFAULT),
                     H5Dclose, what);
    check(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.c_str()), what);
}
std::string Hdf5File::readText(const std::string& path) const {
    const std::string what = "read " + path;
    const Handle set(H5Dopen2(id_, path.c_str(), H5P_DEFAULT), H5Dclose, what);
    const Handle type(H5Dget_type(set), H5Tclose, what);
    const Handle space(H5Dget_space(set), H5Sclose, what);
    if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0 ||
        H5Sget_simple_extent_npoints(space) != 1)
        failed(what + ": it is no plain text");
    std::string text(textSize(type, what), '\0');
    check(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()), what);
    return text.substr(0, text.find('\0'));
}

void Hdf5File::setText(const std::string& path, const char* name, const std::string& text) {
    const Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "make a string type");
    // size with the terminating zero, at least 1
    check(H5Tset_size(type, text.size() + 1), "make a string type");
    check(H5Tset_cset(type, H5T_CSET_UTF8), "make a string type");
    setAttribute(objectAt(path), path, name, type, text.c_str());
}
void Hdf5File::setInteger(const std::string& path, const char* name, int value) {
    setAttribute(objectAt(path), path, name, H5T_NATIVE_INT, &value);
}
void Hdf5File::setDouble(const std::string& path, const char* name, double value) {
    setAttribute(objectAt(path), path, name, H5T_NATIVE_DOUBLE, &value);
}

std::string Hdf5File::text(const std::string& path, const char* name) const {
    const std::string what = "read attribute " + path + "@" + name;
    const Handle attribute(H5Aopen(objectAt(path), name, H5P_DEFAULT), H5Aclose, what);
    const Handle type(H5Aget_type(attribute), H5Tclose, what);
    if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0)
        failed(what + ": it is no plain text");
    requireOne(attribute, what);
    std::string text(textSize(type, what), '\0');
    check(H5Aread(attribute, type, text.data()), what);
    return text.substr(0, text.find('\0'));
}
int Hdf5File::integer(const std::string& path, const char* name) const {
    int value = 0;
    getAttribute(objectAt(path), path, name, H5T_NATIVE_INT, &value);
    return value;
}
double Hdf5File::number(const std::string& path, const char* name) const {
    double value = 0.0;
    getAttribute(objectAt(path), path, name, H5T_NATIVE_DOUBLE, &value);
    return value;
}

void prepareHdf5File() {
    preparedFile().emplace(Hdf5File::create());
}

}  // namespace rigor::results
