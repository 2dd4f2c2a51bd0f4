/// Finds datasets of a stored result and numbers in them.
#pragma once

#include "store/result_file.hpp"

#include <string>
#include <vector>

namespace bemcal::report {

/// A group of datasets: a study of a building, say.
class Group {
  public:
    Group(const store::ResultFile& result, std::string path)
        : result_(&result), path_(std::move(path)) {}

    const std::string& path() const { return path_; }
    bool has(const std::string& leaf) const { return find(leaf) != nullptr; }
    /// Empty where the dataset is not there.
    const std::vector<double>& values(const std::string& leaf) const;
    const std::vector<std::string>& texts(const std::string& leaf) const;
    std::vector<std::size_t> shape(const std::string& leaf) const;
    /// Groups anywhere below this one that have a dataset of that name.
    std::vector<Group> groups_below(const std::string& leaf) const;
    const std::string& unit(const std::string& leaf) const;  ///< as it is stored
    double value(const std::string& leaf) const;  ///< NaN where it is not there
    /// Another group of the same result.
    Group elsewhere(std::string path) const { return {*result_, std::move(path)}; }
    Group inner(const std::string& name) const { return {*result_, path_ + "/" + name}; }

  private:
    const study::Dataset* find(const std::string& leaf) const;

    const store::ResultFile* result_;
    std::string path_;
};

/// The groups that have a dataset of that name, in the order of the file.
std::vector<Group> groups_with(const store::ResultFile& result, const std::string& leaf);

}  // namespace bemcal::report
