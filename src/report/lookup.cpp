/// Finds datasets of a stored result by group and name, and numbers in them; empty or NaN
/// where they are not there, a message where they are damaged.
/// Plain search without a source, linear in the number of datasets. Reading the file is
/// result_file's.
#include "report/lookup.hpp"

#include "base/nan.hpp"
#include "store/dataset_path.hpp"
#include "store/layout.hpp"

#include <algorithm>

namespace bemcal::report {

using store::group_of;
using study::Dataset;

std::string Group::path_of(const std::string& leaf) const {
    return path_.empty() ? leaf : path_ + "/" + leaf;
}

const Dataset* Group::find(const std::string& leaf) const {
    const auto found =
        std::ranges::find(result_->datasets, path_of(leaf), &Dataset::path);
    return found == result_->datasets.end() ? nullptr : &*found;
}

Numbers Group::values(const std::string& leaf) const {
    static const std::vector<double> none;
    const Dataset* dataset = find(leaf);
    return {dataset, path_of(leaf), dataset ? dataset->values : none};
}

Texts Group::texts(const std::string& leaf) const {
    static const std::vector<std::string> none;
    const Dataset* dataset = find(leaf);
    return {dataset, path_of(leaf), dataset ? dataset->texts : none};
}

std::vector<std::size_t> Group::shape(const std::string& leaf) const {
    const Dataset* dataset = find(leaf);
    return dataset ? dataset->shape : std::vector<std::size_t>{};
}

std::vector<const Dataset*> Group::datasets() const {
    std::vector<const Dataset*> own;
    for (const Dataset& dataset : result_->datasets)
        if (group_of(dataset.path) == path_) own.push_back(&dataset);
    return own;
}

std::vector<Group> Group::groups_below(const std::string& leaf) const {
    std::vector<Group> below = groups_with(*result_, leaf);
    std::erase_if(below, [&](const Group& group) {
        return !group.path().starts_with(path_ + "/");
    });
    return below;
}

const std::string& Group::unit(const std::string& leaf) const {
    static const std::string none;
    const Dataset* dataset = find(leaf);
    return dataset ? dataset->unit : none;
}

double Group::value(const std::string& leaf) const {
    const Numbers found = values(leaf);
    return found.empty() ? nan : found[0];
}

std::vector<Group> groups_with(const store::ResultFile& result, const std::string& leaf) {
    std::vector<Group> groups;
    for (const Dataset& dataset : result.datasets)
        if (store::leaf_of(dataset.path) == leaf)
            groups.emplace_back(result, group_of(dataset.path));
    return groups;
}

}  // namespace bemcal::report
