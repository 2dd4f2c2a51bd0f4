/// Builds the datasets of one stage: scalars, texts and arrays with named dimensions, and
/// those that many stages have (parameters, times, failures).
/// Follows from netCDF's named dimensions.
/// Units and long names are the store's layout's, as is writing files.
#include "study/datasets.hpp"

#include "base/error.hpp"

#include <algorithm>

namespace bemcal::study {

const Dataset* find_dataset(const std::vector<Dataset>& datasets,
                            const std::string& path) {
    const auto found = std::ranges::find(datasets, path, &Dataset::path);
    return found == datasets.end() ? nullptr : &*found;
}

void DatasetBuilder::array(const std::string& leaf, std::vector<std::string> dims,
                           std::vector<std::size_t> shape, std::vector<double> values,
                           std::string unit) {
    std::size_t size = 1;
    for (const std::size_t extent : shape) size *= extent;
    require(size == values.size() && dims.size() == shape.size(),
            "dataset of a wrong shape");
    datasets_.push_back({stage_ + "/" + leaf,
                         std::move(dims),
                         std::move(shape),
                         std::move(values),
                         {},
                         std::move(unit)});
}

void DatasetBuilder::array(const std::string& leaf, const Array& array) {
    this->array(leaf, array.dims, array.shape, array.values);
}

void DatasetBuilder::scalar(const std::string& leaf, double value) {
    array(leaf, {}, {}, {value});
}

void DatasetBuilder::vector(const std::string& leaf, const std::string& dim,
                            std::vector<double> values) {
    const std::size_t size = values.size();
    array(leaf, {dim}, {size}, std::move(values));
}

void DatasetBuilder::text(const std::string& leaf, const std::string& value) {
    datasets_.push_back({stage_ + "/" + leaf, {}, {}, {}, {value}});
}

void DatasetBuilder::texts(const std::string& leaf, const std::string& dim,
                           std::vector<std::string> values) {
    const std::size_t size = values.size();
    datasets_.push_back({stage_ + "/" + leaf, {dim}, {size}, {}, std::move(values)});
}

void DatasetBuilder::parameters(const std::vector<physics::Parameter>& parameters,
                                const std::string& dim) {
    std::vector<std::string> names, units;
    std::vector<double> least, most;
    for (const auto& parameter : parameters) {
        names.push_back(parameter.name);
        units.push_back(parameter.unit);
        least.push_back(parameter.least);
        most.push_back(parameter.most);
    }
    texts(dim, dim, std::move(names));
    texts(dim + "_unit", dim, std::move(units));
    vector(dim + "_least", dim, std::move(least));
    vector(dim + "_most", dim, std::move(most));
}

void DatasetBuilder::times(const std::string& leaf,
                           const std::vector<physics::Seconds>& begins, const char* dim) {
    std::vector<double> seconds;
    seconds.reserve(begins.size());
    for (const auto begin : begins)
        seconds.push_back(static_cast<double>(begin.time_since_epoch().count()));
    vector(leaf, dim, std::move(seconds));
}

void DatasetBuilder::failures(const std::vector<Failure>& failures) {
    scalar("n_failed", static_cast<double>(failures.size()));
    if (failures.empty()) return;
    std::vector<double> points;
    std::vector<std::string> reasons;
    for (const auto& failure : failures) {
        points.push_back(static_cast<double>(failure.point));
        reasons.push_back(failure.reason);
    }
    vector("failed_point", "failure", std::move(points));
    texts("failed_reason", "failure", std::move(reasons));
}

}  // namespace bemcal::study
