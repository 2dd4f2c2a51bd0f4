/// Simulates paper 1's single hour for an emulator: scrambled Sobol points of the
/// calibrated inputs, each at every field point. Every one of 19 inputs is known,
/// calibrated or fixed.
/// Source: paper 1, eq. 2 and Table 2.
/// All runs are made at once, when the job is read. Other simulators are in `koh_runs`.
#include "posterior/office_hour_runs.hpp"

#include "physics/office_hour.hpp"
#include "stats/sobol_sequence.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace bemcal::posterior {
namespace {

using Names = std::vector<std::string>;

/// Where the numbers of the 19 inputs come from: each from one place.
struct Places {
    std::vector<std::size_t> x, t;
    std::vector<double> values;  ///< the fixed ones in their places
};

Places places_of(const OfficeHourDesign& design, const emulator::Observations& o) {
    const auto inputs = physics::office_hour_inputs();
    Places places{{}, {}, std::vector<double>(inputs.size())};
    std::vector<int> n_uses(inputs.size());
    const auto take = [&](const std::string& name) {
        const std::size_t number = physics::office_hour_input_number(name);
        if (++n_uses[number] > 1)
            throw std::invalid_argument(fmt::format(
                "{} stands in two of inputs, calibrated and fixed; expected one", name));
        return number;
    };
    for (const std::string& name : o.x_names) places.x.push_back(take(name));
    for (const std::string& name : o.t_names) places.t.push_back(take(name));
    for (const auto& [name, value] : design.fixed) places.values[take(name)] = value;
    for (std::size_t k = 0; k < inputs.size(); ++k)
        if (n_uses[k] == 0)
            throw std::invalid_argument(
                fmt::format("{} is neither in inputs nor calibrated nor fixed; expected "
                            "all 19 inputs of the office hour",
                            inputs[k].name));
    return places;
}

/// [designs x q]
Matrix designs_of(const OfficeHourDesign& design, const std::vector<std::size_t>& t) {
    const auto inputs = physics::office_hour_inputs();
    Matrix made = stats::scrambled_sobol_points(0, design.n_designs,
                                                static_cast<int>(t.size()), design.seed);
    for (std::size_t r = 0; r < made.rows; ++r)
        for (std::size_t k = 0; k < t.size(); ++k)
            made(r, k) = inputs[t[k]].least +
                         made(r, k) * (inputs[t[k]].most - inputs[t[k]].least);
    return made;
}

}  // namespace

std::vector<study::Coordinate> office_hour_coordinates(const Names& names) {
    std::vector<study::Coordinate> made;
    made.reserve(names.size());
    for (const std::string& name : names) {
        const auto& input =
            physics::office_hour_inputs()[physics::office_hour_input_number(name)];
        made.push_back({name, input.unit, stats::uniform_prior(input.least, input.most)});
    }
    return made;
}

void add_office_hour_runs(const OfficeHourDesign& design, emulator::Observations& o) {
    Places places = places_of(design, o);
    const Matrix designs = designs_of(design, places.t);
    const Matrix& points = o.measured_x;
    const std::size_t m = designs.rows * points.rows;
    o.simulated.resize(m);
    o.simulated_x = Matrix(m, points.cols);
    o.simulated_t = Matrix(m, designs.cols);
    for (std::size_t row = 0; row < m; ++row) {
        const auto t = designs.row(row / points.rows), x = points.row(row % points.rows);
        std::ranges::copy(x, o.simulated_x.row(row).begin());
        std::ranges::copy(t, o.simulated_t.row(row).begin());
        for (std::size_t k = 0; k < x.size(); ++k) places.values[places.x[k]] = x[k];
        for (std::size_t k = 0; k < t.size(); ++k) places.values[places.t[k]] = t[k];
        o.simulated[row] = physics::office_hour_energy(places.values);
        if (std::isnan(o.simulated[row]))
            throw std::invalid_argument(
                fmt::format("the office hour has no answer at field point {}: its box is "
                            "impossible",
                            row % points.rows + 1));
    }
}

}  // namespace bemcal::posterior
