/// A thin layer over HDF5's C interface: files, text attributes, arrays of doubles and
/// texts, and dimension scales as netCDF-4 wants them. hdf5.cpp is the only file that
/// includes hdf5.h.
///
/// Strings are variable-length UTF-8 (fixed-length ones crash some netCDF readers), no
/// object keeps time stamps, and HDF5's file locks are off: they fail on network file
/// systems, and our files are written under a temporary name anyway. Leaves out: chunks,
/// compression, other types.
///
/// What is read may be of anyone: links to other files are not followed, types and shapes
/// are looked at first, and no more is taken than the file can hold. HDF5 itself crashes
/// on some damaged files; result_reading keeps that apart. Not HighFive: what is looked
/// at here has to be asked of HDF5 itself.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace bemcal::store::hdf5 {

/// What HDF5 says went wrong, innermost reason first.
struct Error : std::runtime_error {
    using std::runtime_error::runtime_error;
};

using Shape = std::vector<std::size_t>;

/// Of datasets, by what refers to them. HDF5 looks through the whole file for the name of
/// one reference.
using ScaleNames = std::map<std::uint64_t, std::string>;

struct Array {
    Shape shape;
    /// Names of the attached scales, "" where there is none.
    std::vector<std::string> dims;
    std::vector<double> values;  ///< row-major; empty where texts is used
    std::vector<std::string> texts;
};

class File {
  public:
    static File create(const std::filesystem::path& path);  ///< overwrites
    /// To read. Throws Error where it is no HDF5 file.
    static File open(const std::filesystem::path& path);
    ~File();
    File(const File&) = delete;
    File& operator=(const File&) = delete;
    File(File&& other) noexcept;
    void flush();
    void close();  ///< flushes; throws where the disk does not take it

    /// Objects are named by their path from the root; missing groups on the way are made.
    bool has(const std::string& path) const;
    void make_group(const std::string& path);
    void write_attribute(const std::string& object, const std::string& name,
                         const std::string& text);
    void write(const std::string& path, const Shape& shape,
               std::span<const double> values);
    void write(const std::string& path, const Shape& shape,
               std::span<const std::string> texts);
    void write_bare_dimension(const std::string& path, std::size_t size);  ///< no values
    void make_scale(const std::string& path);
    void attach_scale(const std::string& path, unsigned axis, const std::string& scale);

    /// Texts; attributes of other types are passed over. Throws Error where one is a
    /// list.
    std::map<std::string, std::string> attributes(const std::string& object) const;
    std::vector<std::string> dataset_paths() const;  ///< sorted, without bare dimensions
    /// Throws Error where it is neither numbers nor texts, lies in another file, or is
    /// larger than the file can hold.
    Array read(const std::string& path);

  private:
    explicit File(std::int64_t id, double size = 0) : id_(id), size_(size) {}
    void take(const std::string& path, const Shape& shape, double bytes, double most);
    const ScaleNames& scale_names();

    std::int64_t id_;
    double size_ = 0, taken_ = 0;  ///< of the file, and of what was read of it [bytes]
    ScaleNames scales_;            ///< of all datasets, once they are asked for
};

}  // namespace bemcal::store::hdf5
