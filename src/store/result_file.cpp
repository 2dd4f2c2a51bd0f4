/// Writes a result under a temporary name, to the disk, and renames it when complete;
/// and hashes all but /run.
/// Source: netCDF-4's conventions (hdf5). Datasets are held in memory whole; a result is
/// never changed afterwards. The hash finds differences, not forgery. Reading is
/// result_reading's.
#include "store/result_file.hpp"

#include "base/disk.hpp"
#include "base/error.hpp"
#include "base/hash.hpp"
#include "store/dataset_path.hpp"
#include "store/hdf5.hpp"
#include "store/layout.hpp"
#include "store/result_reading.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

namespace bemcal::store {
namespace {

using study::Dataset;
using Texts = std::map<std::string, std::string>;

std::vector<const Dataset*> by_path(const std::vector<Dataset>& datasets) {
    std::vector<const Dataset*> sorted;
    sorted.reserve(datasets.size());
    for (const Dataset& dataset : datasets) sorted.push_back(&dataset);
    std::ranges::sort(sorted, {}, &Dataset::path);
    return sorted;
}

void hash_dataset(Hasher& hasher, const Dataset& dataset) {
    hasher.add(std::string_view(dataset.path));
    for (std::size_t k = 0; k < dataset.dims.size(); ++k) {
        hasher.add(std::string_view(dataset.dims[k]));
        const std::uint64_t size = dataset.shape[k];
        hasher.add(&size, sizeof size);
    }
    hasher.add(std::span<const double>(dataset.values));
    for (const std::string& text : dataset.texts) hasher.add(std::string_view(text));
}

std::string join(const std::string& group, const std::string& leaf) {
    return group.empty() ? leaf : group + "/" + leaf;
}

/// Where each dimension of the result lies. A dataset named as its only dimension is its
/// coordinate; a dimension without one is made, without values, in the dataset's group.
class Dimensions {
  public:
    explicit Dimensions(const std::vector<const Dataset*>& datasets) {
        for (const Dataset* dataset : datasets)
            if (is_coordinate(*dataset)) sizes_[dataset->path] = dataset->shape[0];
    }

    static bool is_coordinate(const Dataset& dataset) {
        return dataset.dims.size() == 1 && dataset.dims[0] == leaf_of(dataset.path);
    }

    /// The scale of a dataset's axis: in its group or the nearest one above.
    const std::string& scale_of(hdf5::File& file, const Dataset& dataset,
                                std::size_t axis) {
        const std::string& name = dataset.dims[axis];
        std::string group = group_of(dataset.path);
        for (;; group = group_of(group)) {
            const auto found = sizes_.find(join(group, name));
            if (found != sizes_.end() && found->second == dataset.shape[axis])
                return found->first;
            if (group.empty()) return make(file, dataset, axis);
        }
    }

  private:
    const std::string& make(hdf5::File& file, const Dataset& dataset, std::size_t axis) {
        const std::string path = join(group_of(dataset.path), dataset.dims[axis]);
        require(!sizes_.contains(path), "a group has one dimension with two sizes");
        file.write_bare_dimension(path, dataset.shape[axis]);
        return sizes_.emplace(path, dataset.shape[axis]).first->first;
    }

    std::map<std::string, std::size_t> sizes_;
};

/// As it is written.
std::string unit_of(const Dataset& dataset) {
    return dataset.unit.empty() ? layout_of(dataset).unit : dataset.unit;
}

void write_values(hdf5::File& file, const Dataset& dataset) {
    const LayoutRow& row = layout_of(dataset);
    if (row.kind == Kind::text)
        file.write(dataset.path, dataset.shape,
                   std::span<const std::string>(dataset.texts));
    else
        file.write(dataset.path, dataset.shape, std::span<const double>(dataset.values));
    file.write_attribute(dataset.path, "units", unit_of(dataset));
    file.write_attribute(dataset.path, "long_name", row.meaning);
    if (Dimensions::is_coordinate(dataset)) file.make_scale(dataset.path);
}

void write_content(hdf5::File& file, const ResultFile& result) {
    const auto datasets = by_path(result.datasets);
    for (const Dataset* dataset : datasets) write_values(file, *dataset);
    Dimensions dimensions(datasets);
    for (const Dataset* dataset : datasets)
        for (std::size_t axis = 0; axis < dataset->dims.size(); ++axis)
            if (!Dimensions::is_coordinate(*dataset))
                file.attach_scale(dataset->path, static_cast<unsigned>(axis),
                                  dimensions.scale_of(file, *dataset, axis));
    for (const auto& [name, text] : result.attributes)
        file.write_attribute("/", name, text);
    file.make_group(run_group);
    for (const auto& [name, text] : result.run)
        file.write_attribute(run_group, name, text);
}

/// To the disk, without the names of its content.
void sync_file(const std::filesystem::path& path) {
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    int error = file < 0 || ::fsync(file) != 0 ? errno : 0;
    if (file >= 0 && ::close(file) != 0 && error == 0) error = errno;
    if (error != 0 && error != EINVAL) fail_at(path, "write to the disk", error);
}

void hash_texts(Hasher& hasher, const Texts& texts) {
    for (const auto& [name, text] : texts) {
        hasher.add(std::string_view(name));
        hasher.add(std::string_view(text));
    }
}

void hash_unit(Hasher& hasher, const std::string& path, const std::string& unit) {
    hasher.add(std::string_view(path));
    hasher.add(std::string_view(unit));
}

/// Of what a result's hash leaves out, as it is written.
std::string labels_hash_of(const Texts& run, const std::vector<Dataset>& datasets) {
    Hasher hasher;
    hash_texts(hasher, run);
    for (const Dataset* dataset : by_path(datasets))
        hash_unit(hasher, dataset->path, unit_of(*dataset));
    return hasher.hex();
}

/// The hashes and the mark come when the rest is on the disk.
void write_file(const std::filesystem::path& file, const ResultFile& result,
                const std::string& hash) {
    const auto begin = std::chrono::steady_clock::now();
    hdf5::File out = hdf5::File::create(file);
    write_content(out, result);
    out.flush();
    sync_file(file);
    const std::chrono::duration<double> seconds =
        std::chrono::steady_clock::now() - begin;
    Texts run = result.run;
    run["seconds_store"] = fmt::format("{:.3f}", seconds.count());
    out.write_attribute(run_group, "seconds_store", run["seconds_store"]);
    out.write_attribute("/", labels_mark, labels_hash_of(run, result.datasets));
    out.write_attribute("/", hash_mark, hash);
    out.write_attribute("/", complete_mark, "yes");
    out.close();
}

/// Follows a result that is read, and tells whether it is what was written.
class Check {
  public:
    void take(const ResultFile& head) {
        is_complete_ = head.complete;
        hash_ = head.hash;
        labels_hash_ = head.labels_hash;
        hash_texts(content_, head.attributes);
        hash_texts(labels_, head.run);
    }
    void take(const Dataset& dataset) {
        hash_dataset(content_, dataset);
        hash_unit(labels_, dataset.path, dataset.unit);
    }
    bool is_sound() const {
        return is_complete_ && content_.hex() == hash_ &&
               (labels_hash_.empty() || labels_.hex() == labels_hash_);
    }
    const std::string& hash() const { return hash_; }

  private:
    bool is_complete_ = false;
    std::string hash_, labels_hash_;
    Hasher content_, labels_;
};

/// A file of ours, a dataset at a time.
bool reads_back(const std::filesystem::path& file, const std::string& hash) {
    Check check;
    read_each_here(
        file, [&](const ResultFile& head) { check.take(head); },
        [&](const Dataset& dataset) { check.take(dataset); });
    return check.is_sound() && check.hash() == hash;
}

}  // namespace

std::string result_hash(const ResultFile& result) {
    Hasher hasher;
    hash_texts(hasher, result.attributes);
    for (const Dataset* dataset : by_path(result.datasets))
        hash_dataset(hasher, *dataset);
    return hasher.hex();
}

bool is_sound(const ResultFile& result) {
    Check check;
    check.take(result);
    for (const Dataset* dataset : by_path(result.datasets)) check.take(*dataset);
    return check.is_sound();
}

std::string write_result(const std::filesystem::path& file, const ResultFile& result,
                         const Placing& placing) {
    const std::string hash = result_hash(result);
    const bool is_beside = placing.folder.empty();
    FreshFile fresh(is_beside ? folder_of(file) : placing.folder,
                    is_beside ? file.filename().string() : "result");
    try {
        write_file(fresh.path(), result, hash);
        if (!reads_back(fresh.path(), hash))
            throw hdf5::Error("what was written reads back as something else");
    } catch (const hdf5::Error& error) {
        throw UserError(ExitCode::io, fmt::format("{}: cannot write the result: {}",
                                                  file.string(), error.what()));
    }
    fresh.move_to(file, placing.replace);
    return hash;
}

ResultFile read_result(const std::filesystem::path& file, const std::string& group) {
    if (!std::filesystem::exists(file))
        throw UserError(ExitCode::no_input,
                        fmt::format("{}: no such file", file.string()));
    if (std::filesystem::is_directory(file))
        throw UserError(
            ExitCode::no_input,
            fmt::format("{}: is a folder; expected a result file", file.string()));
    if (!std::filesystem::is_regular_file(file))
        throw UserError(
            ExitCode::no_input,
            fmt::format("{}: is no regular file; expected a result file", file.string()));
    return read_apart(file, group);
}

ResultFile read_head(const std::filesystem::path& file) {
    return read_result(file, no_group);
}

}  // namespace bemcal::store
