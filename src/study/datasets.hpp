/// Builds the datasets of one stage; all paths begin with the stage's name. And finds one
/// of those that were built.
#pragma once

#include "physics/calendar.hpp"
#include "physics/parameters.hpp"
#include "study/array.hpp"

#include <string>
#include <vector>

namespace bemcal::study {

/// nullptr where there is none of that path.
const Dataset* find_dataset(const std::vector<Dataset>& datasets,
                            const std::string& path);

class DatasetBuilder {
  public:
    explicit DatasetBuilder(std::string stage) : stage_(std::move(stage)) {}

    void scalar(const std::string& leaf, double value);
    void text(const std::string& leaf, const std::string& value);
    void texts(const std::string& leaf, const std::string& dim,
               std::vector<std::string> values);
    void vector(const std::string& leaf, const std::string& dim,
                std::vector<double> values);
    void array(const std::string& leaf, std::vector<std::string> dims,
               std::vector<std::size_t> shape, std::vector<double> values,
               std::string unit = {});
    void array(const std::string& leaf, const Array& array);

    /// What kind of study it is: in the group of every one, by the word of the job file.
    void kind(const char* word) { text("kind", word); }
    /// Names, units and ranges. \param dim  begins their names, too
    void parameters(const std::vector<physics::Parameter>& parameters,
                    const std::string& dim = "parameter");
    /// Begins of steps [s since 1970, local standard time].
    void times(const std::string& leaf, const std::vector<physics::Seconds>& begins,
               const char* dim = "time");
    /// How many points failed, which and why; an item that failed as a whole counts for
    /// all of its points.
    void failures(const std::vector<Failure>& failures);

    std::vector<Dataset> take() { return std::move(datasets_); }

  private:
    std::string stage_;
    std::vector<Dataset> datasets_;
};

}  // namespace bemcal::study
