/// Declared effects whose shape a posterior samples: functions, and the days of steps.
///
///     f(x) = values(x) + sum_k c_k column_k(x),  c_k ~ N(0, size^2)
///
/// Columns are those of the driver's basis at the function's own points
/// (functions/basis.hpp): over training they have mean 0, and their sum a mean square of
/// 1. The size has a lognormal prior about the spread that was declared.
///
/// A step brings its coefficient to each day about the declared one, times the share of
/// the day that lies behind the moment of the step, which is uniform in the days sampled.
#pragma once

#include "study/case.hpp"

#include <string>
#include <vector>

namespace bemcal::study {

/// A function of an effect and what samples it.
struct SampledFunction {
    std::string name;            ///< "evenings by hour of the week"
    std::string hook, driver;    ///< in words
    std::string unit;            ///< of its values
    functions::Points points{};  ///< where they are
    std::vector<double> values;  ///< [points] as declared
    Matrix columns{};            ///< [points x columns]

    /// The parameter of its size; those of its columns follow.
    std::string size_name() const { return name + ": size"; }
};

/// Whether a posterior of the building samples any.
bool has_sampled_shapes(const Case& building);

/// The case with parameters for all that is sampled of its effects' shapes, behind its
/// own, each with a prior; at their nominal values it is the case. Throws
/// std::invalid_argument where a step's coefficient is varied by a factor or an offset,
/// or a sampled function's coefficient at all.
/// \param period     that readings are of
/// \param functions  set to those that are sampled
Case with_sampled_shapes(Case building, const Period& period,
                         std::vector<SampledFunction>& functions);

}  // namespace bemcal::study
