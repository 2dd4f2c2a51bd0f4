/// Finds datasets of a stored result and numbers in them.
///
/// A result may be of anyone. Values are asked for by their place, and a place beyond
/// their end is a damaged result: a UserError that names the dataset and its shape.
#pragma once

#include "store/layout_check.hpp"
#include "store/result_file.hpp"
#include "study/array.hpp"

#include <concepts>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace bemcal::report {

/// The values of a dataset, none where it is not there; every place is checked.
template <class Value>
class Column {
  public:
    Column(const study::Dataset* dataset, std::string path,
           const std::vector<Value>& values)
        : dataset_(dataset), path_(std::move(path)), values_(&values) {}

    const Value& operator[](std::size_t k) const {
        if (k >= values_->size()) refuse("a value " + std::to_string(k + 1) + " is used");
        return (*values_)[k];
    }
    /// A value that counts from 0, below `end`.
    std::size_t index(std::size_t k, std::size_t end) const {
        const double value = (*this)[k];
        if (!(value >= 0 && value < static_cast<double>(end)))
            refuse("its value " + std::to_string(k + 1) + " is no place among " +
                   std::to_string(end));
        return static_cast<std::size_t>(value);
    }
    /// The number at a place along each of the dataset's dimensions.
    double at(study::Indices indices) const
        requires std::same_as<Value, double>
    {
        const auto one = dataset_ == nullptr ? std::span<const double>()
                                             : study::ArrayView(*dataset_).part(indices);
        if (one.size() != 1) refuse("a place beyond it is used");
        return one[0];
    }
    [[noreturn]] void refuse(const std::string& why) const {
        store::refuse_dataset(dataset_, path_, why);
    }

    std::size_t size() const { return values_->size(); }
    bool empty() const { return values_->empty(); }
    auto begin() const { return values_->begin(); }
    auto end() const { return values_->end(); }
    const Value& front() const { return (*this)[0]; }
    const Value& back() const { return (*this)[size() - 1]; }
    operator const std::vector<Value>&() const { return *values_; }
    friend bool operator==(const Column& a, const std::vector<Value>& b) {
        return *a.values_ == b;
    }

  private:
    const study::Dataset* dataset_;
    std::string path_;
    const std::vector<Value>* values_;
};
using Numbers = Column<double>;
using Texts = Column<std::string>;

/// A group of datasets: a study of a building, say.
class Group {
  public:
    Group(const store::ResultFile& result, std::string path)
        : result_(&result), path_(std::move(path)) {}

    const std::string& path() const { return path_; }
    const store::ResultFile& result() const { return *result_; }
    bool has(const std::string& leaf) const { return find(leaf) != nullptr; }
    /// Empty where the dataset is not there.
    Numbers values(const std::string& leaf) const;
    Texts texts(const std::string& leaf) const;
    std::vector<std::size_t> shape(const std::string& leaf) const;
    /// Those in this group itself, in the order of the file.
    std::vector<const study::Dataset*> datasets() const;
    /// Groups anywhere below this one that have a dataset of that name.
    std::vector<Group> groups_below(const std::string& leaf) const;
    const std::string& unit(const std::string& leaf) const;  ///< as it is stored
    double value(const std::string& leaf) const;  ///< NaN where it is not there
    /// Another group of the same result.
    Group elsewhere(std::string path) const { return {*result_, std::move(path)}; }
    Group inner(const std::string& name) const { return {*result_, path_ + "/" + name}; }

  private:
    std::string path_of(const std::string& leaf) const;
    const study::Dataset* find(const std::string& leaf) const;

    const store::ResultFile* result_;
    std::string path_;
};

/// The groups that have a dataset of that name, in the order of the file.
std::vector<Group> groups_with(const store::ResultFile& result, const std::string& leaf);

}  // namespace bemcal::report
