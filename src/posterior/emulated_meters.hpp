/// Readings of another program through an emulator of them, as meters' response.
///
/// A score of the emulator is its process' mean at a point, plus a standard deviation
/// times an error of its own, which is an unknown with the prior N(0, 1). So chains know
/// how far the emulator can be wrong, and that its errors last: an error is the same in
/// all readings of a draw. With the errors integrated out, readings are normal about the
/// emulated ones with the covariance of residuals plus B V B', as series_fit.hpp has it.
/// Source: Higdon, Gattiker, Williams and Rightley 2008, J. Am. Stat. Assoc. 103.
#pragma once

#include "emulator/series_emulator.hpp"
#include "posterior/meter_response.hpp"
#include "study/series_layout.hpp"

#include <memory>
#include <vector>

namespace bemcal::posterior {

using study::SeriesLayout;

/// The building with the program's parameters in place of its own, uniform in their
/// ranges, then an error for each of the emulator's components.
study::Case with_parameters(study::Case building,
                            std::vector<physics::Parameter> parameters,
                            std::size_t n_components);

/// V: of each score, how far a run of the program strays from its process' mean, as a
/// mean over points. [components] \param points  [n x parameters] on the scale 0 to 1
std::vector<double> mean_variance(const emulator::SeriesEmulator& emulator,
                                  const Matrix& points);

/// \param emulator  of a series so laid out, over the parameters on the scale 0 to 1
/// \param variance  V, the same at all points: where it fell to 0 at each run, a
/// posterior that is narrow would be a necklace, which no chain goes along
std::shared_ptr<const ResponseSource> emulated_meters(
    SeriesLayout layout, std::shared_ptr<const emulator::SeriesEmulator> emulator,
    std::vector<double> variance);

}  // namespace bemcal::posterior
