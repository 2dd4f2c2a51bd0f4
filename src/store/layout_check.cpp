/// Holds the datasets of a result against the layout table, and their lengths against the
/// names of their dimensions.
/// Follows from how the writer places dimensions: in the dataset's group or one above.
/// Values are not looked at; a dataset of a name that is unknown may be anything.
#include "store/layout_check.hpp"

#include "base/error.hpp"
#include "store/dataset_path.hpp"
#include "store/layout.hpp"

#include <map>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace bemcal::store {
namespace {

using study::Dataset;

/// Sizes of the datasets that name a dimension: "a/b/parameter" is that of parameter in
/// a/b and below.
using Sizes = std::map<std::string, std::size_t>;

Sizes sizes_in(const ResultFile& result) {
    Sizes sizes;
    for (const Dataset& dataset : result.datasets)
        if (dataset.dims.size() == 1 && dataset.dims[0] == leaf_of(dataset.path))
            sizes[dataset.path] = dataset.shape[0];
    return sizes;
}

/// The size of the names of a dimension in the dataset's group, where it is another and
/// no group above has the dataset's own.
std::optional<std::size_t> other_size(const Sizes& sizes, const Dataset& dataset,
                                      std::size_t axis) {
    std::string group = group_of(dataset.path);
    const auto names_in = [&] { return sizes.find(group + "/" + dataset.dims[axis]); };
    const auto beside = names_in();
    if (beside == sizes.end()) return std::nullopt;
    for (; !group.empty(); group = group_of(group)) {
        const auto found = names_in();
        if (found != sizes.end() && found->second == dataset.shape[axis])
            return std::nullopt;
    }
    return beside->second;
}

void check_row(const Dataset& dataset) {
    const LayoutRow* row = known_layout(dataset);
    if (row != nullptr && !is_as(dataset, *row))
        refuse_dataset(
            &dataset, dataset.path,
            fmt::format("dimensions \"{}\", where {} of \"{}\" belong",
                        fmt::join(dataset.dims, " "),
                        row->kind == Kind::text ? "texts" : "numbers", row->dims));
}

void check_sizes(const Dataset& dataset, const Sizes& sizes) {
    for (std::size_t axis = 0; axis < dataset.dims.size(); ++axis)
        if (const auto size = other_size(sizes, dataset, axis))
            refuse_dataset(
                &dataset, dataset.path,
                fmt::format("there are {} of \"{}\"", *size, dataset.dims[axis]));
}

}  // namespace

void refuse_dataset(const Dataset* dataset, const std::string& path,
                    const std::string& why) {
    const std::string shape =
        dataset == nullptr
            ? "is missing"
            : fmt::format("has shape ({})", fmt::join(dataset->shape, ", "));
    throw UserError(ExitCode::data,
                    fmt::format("damaged: dataset {} {}, and {}", path, shape, why));
}

void check_layout(const ResultFile& result) {
    const Sizes sizes = sizes_in(result);
    for (const Dataset& dataset : result.datasets) {
        check_row(dataset);
        check_sizes(dataset, sizes);
    }
}

}  // namespace bemcal::store
