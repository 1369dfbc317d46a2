// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Wrapper of the HDF5 functions in use, with handles that close themselves and failures that are exceptions. The
// library works on a copy of the file in memory; this project reads and writes the file itself, so that errors of
// the disk have an errno and a path and never end inside the library.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace rigor::results {

/// The content of an HDF5 file; paths are absolute ("/bodies/block/position"). Every member throws std::runtime_error
/// naming the path. It must not be used from several threads: the library is not built for that.
class Hdf5File {
  public:
    static Hdf5File create();                                 ///< an empty one, in memory
    static Hdf5File open(const std::filesystem::path& file);  ///< read only
    static Hdf5File fromImage(const std::string& bytes);      ///< read only
    Hdf5File(Hdf5File&& other) noexcept;
    Hdf5File& operator=(Hdf5File&&) = delete;
    ~Hdf5File();
    /// Ends writing and returns the bytes of the file.
    std::string finish();

    void createGroup(const std::string& path);
    bool exists(const std::string& path) const;
    std::vector<std::string> children(const std::string& path) const;  ///< link names, sorted

    /// Row-major, `columns` > 0 divides the number of values; one column makes a one-dimensional dataset.
    /// Large sets are chunked and deflated.
    void writeDoubles(const std::string& path, const std::vector<double>& values, int columns,
                      const std::string& unit);
    void writeIntegers(const std::string& path, const std::vector<int>& values, int columns,
                       const std::string& unit);
    std::vector<double> readDoubles(const std::string& path, int& columns) const;
    std::vector<int> readIntegers(const std::string& path, int& columns) const;

    /// A text as a dataset of its own, of fixed length.
    void writeText(const std::string& path, const std::string& text);
    std::string readText(const std::string& path) const;

    /// Attributes of a group or dataset.
    void setText(const std::string& path, const char* name, const std::string& text);
    void setInteger(const std::string& path, const char* name, int value);
    void setDouble(const std::string& path, const char* name, double value);
    std::string text(const std::string& path, const char* name) const;
    int integer(const std::string& path, const char* name) const;
    double number(const std::string& path, const char* name) const;

  private:
    struct Image;
    Hdf5File(std::int64_t id, std::unique_ptr<Image> image);
    void keepOpen(std::int64_t object, const std::string& path) const;
    std::int64_t objectAt(const std::string& path) const;

    std::int64_t id_;
    std::unique_ptr<Image> image_;  ///< null when reading
    /// The object that was used last stays open: most are used several times in a row, and the library opens each slowly.
    mutable std::int64_t object_ = -1;
    mutable std::string objectPath_;
};

/// Makes the file that the next create() gives. The library clears half a megabyte for each file: a process that is forked
/// for one case gets it from its parent, and only copies the pages that it uses.
void prepareHdf5File();

}  // namespace rigor::results
