/// The derivative of a response against central differences, for every number of a
/// building.
#pragma once

#include "kernel/random_hooks.hpp"
#include "kernel/response.hpp"
#include "support/measured.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace bemcal::physics::test {

/// A few channels that see everything: what gradients are tested with.
inline std::vector<kernel::Channel> some_channels() {
    return {{Quantity::heating, Interval::hourly},
            {Quantity::electricity, Interval::daily},
            {Quantity::gas, Interval::monthly},
            {Quantity::cooling, Interval::annual},
            {Quantity::air_temperature, Interval::hourly},
            {Quantity::district, Interval::step}};
}

inline std::size_t n_parts(const Building& building, Part part) {
    switch (part) {
        case Part::construction:
        case Part::layer:
            return building.constructions.size();
        case Part::glazing:
            return building.glazings.size();
        case Part::boundary:
            return building.boundaries.size();
        case Part::air_system:
            return building.air_systems.size();
        case Part::plant:
            return 1;
        case Part::meter:
            return building.meter_factor.size();
        default:
            return building.zones.size();
    }
}

inline std::size_t n_inner(const Building& building, Part part, std::size_t index) {
    switch (part) {
        case Part::layer:
            return building.constructions[index].layers.size();
        case Part::radiator:
            return building.zones[index].radiator ? 1 : 0;
        case Part::surface:
            return building.zones[index].surfaces.size();
        case Part::window:
            return building.zones[index].windows.size();
        case Part::flow:
            return building.zones[index].flows.size();
        case Part::load:
            return building.zones[index].loads.size();
        default:
            return part == Part::coupling ? 0 : 1;
    }
}

/// The places of all numbers but the lows.
inline std::vector<Target> all_targets(const Building& building) {
    std::vector<Target> targets;
    for (std::size_t field = 0; field < fields().size(); ++field) {
        const Part part = fields()[field].part;
        // What shows the air temperature has no factor.
        for (std::size_t k = part == Part::meter ? 1 : 0; k < n_parts(building, part);
             ++k)
            for (std::size_t inner = 0; inner < n_inner(building, part, k); ++inner)
                targets.push_back({part, static_cast<int>(k), static_cast<int>(inner),
                                   static_cast<int>(field)});
    }
    return targets;
}

/// A parameter for every number of the building: itself by a factor, its low and the
/// amounts of its changes by an offset.
inline std::vector<Parameter> every_number(const Building& building) {
    std::vector<Parameter> parameters;
    for (Target target : all_targets(building)) {
        const Field& field = fields()[static_cast<std::size_t>(target.field)];
        const double number = number_at(building, target);
        if (number != 0 && std::isfinite(number))
            parameters.push_back(
                {field.key, "", 0.999, 1.001, Effect::factor, {target}, 1});
        if (field.input == nullptr) continue;
        target.slot = Slot::low;
        parameters.push_back({std::string(field.key) + ".low",
                              "",
                              -0.001,
                              0.001,
                              Effect::offset,
                              {target},
                              0});
    }
    for_changes(building, all_targets(building), [&](const Target& target) {
        const Field& field = fields()[static_cast<std::size_t>(target.field)];
        parameters.push_back({fmt::format("{} change {}", field.key, target.change),
                              "",
                              -0.001,
                              0.001,
                              Effect::offset,
                              {target},
                              0});
    });
    return parameters;
}

inline Matrix nominal_points(const std::vector<Parameter>& parameters, std::size_t n) {
    Matrix points(n, parameters.size());
    for (std::size_t k = 0; k < n; ++k)
        for (std::size_t p = 0; p < parameters.size(); ++p)
            points(k, p) = parameters[p].nominal;
    return points;
}

/// The same random sensitivities for all lanes: of kWh and, heavier, of degC.
inline void write_sensitivities(const kernel::Response& response,
                                kernel::Response::Run& run) {
    Dice dice(99);
    const auto lanes = static_cast<std::size_t>(response.lanes());
    for (std::size_t c = 0; c < response.channels().size(); ++c) {
        const bool air = response.channels()[c].quantity == Quantity::air_temperature;
        for (std::size_t k = 0; k < response.n_readings(c); ++k)
            std::fill_n(response.sensitivities(run, c) + k * lanes, lanes,
                        dice.between(0.5, 1.5) * (air ? 20 : 1));
    }
}

/// sum of sensitivity times reading, as a long double so that differences keep digits.
inline long double objective(const kernel::Response& response, kernel::Response::Run& run,
                             int lane) {
    const auto lanes = static_cast<std::size_t>(response.lanes());
    long double sum = 0;
    for (std::size_t c = 0; c < response.channels().size(); ++c) {
        const double* readings = response.readings(run, c);
        const double* sensitivities = response.sensitivities(run, c);
        for (std::size_t k = 0; k < response.n_readings(c); ++k) {
            const std::size_t at = k * lanes + static_cast<std::size_t>(lane);
            sum += static_cast<long double>(readings[at]) * sensitivities[at];
        }
    }
    return sum;
}

/// Objectives of all rows.
inline std::vector<long double> objectives(const kernel::Response& response,
                                           const Matrix& points,
                                           kernel::Response::Run& run) {
    std::vector<long double> values;
    const auto lanes = static_cast<std::size_t>(response.lanes());
    for (std::size_t first = 0; first < points.rows; first += lanes) {
        const std::size_t count = std::min(lanes, points.rows - first);
        for (const std::string& failure : response.predict(points, first, count, run))
            EXPECT_EQ(failure, "");
        for (std::size_t k = 0; k < count; ++k)
            values.push_back(objective(response, run, static_cast<int>(k)));
    }
    return values;
}

/// Central differences of a parameter over h and 2 h, first and second ones.
struct Slopes {
    double near, far, bend_near, bend_far;
    /// No set-point or limit switches within 2 h: the slopes are the same, and the
    /// difference of the slopes on both sides grows with h. A kink at a distance of o
    /// leaves the first where o = 0 only, the second where o = 2/3 h only.
    bool is_smooth(double size) const {
        return std::fabs(near - far) <= 2e-7 * size &&
               std::fabs(bend_far - 2 * bend_near) <= 1e-6 * size;
    }
};

constexpr double h = 1e-5;

inline Matrix points_around(const std::vector<Parameter>& parameters) {
    Matrix points = nominal_points(parameters, 4 * parameters.size());
    for (std::size_t p = 0; p < parameters.size(); ++p) {
        std::size_t row = 4 * p;
        for (double step : {h, -h, 2 * h, -2 * h}) points(row++, p) += step;
    }
    return points;
}

inline Slopes slopes(const long double* value, long double middle) {
    const auto slope = [&](int k, double step) {
        return static_cast<double>((value[k] - value[k + 1]) / (2 * step));
    };
    const auto bend = [&](int k, double step) {
        return static_cast<double>((value[k] - 2 * middle + value[k + 1]) / step);
    };
    return {slope(0, h), slope(2, 2 * h), bend(0, h), bend(2, 2 * h)};
}

/// Of every parameter, at the nominal point; leaves that point in the run.
inline std::vector<Slopes> slopes_of_all(const kernel::Response& response,
                                         const std::vector<Parameter>& parameters,
                                         kernel::Response::Run& run) {
    const auto values = objectives(response, points_around(parameters), run);
    const auto middle = objectives(response, nominal_points(parameters, 1), run);
    std::vector<Slopes> result;
    for (std::size_t p = 0; p < parameters.size(); ++p)
        result.push_back(slopes(values.data() + 4 * p, middle[0]));
    return result;
}

/// Every number of the nominal building that is away from switches: 1e-6 of its
/// derivative, or of 1e-4 of the objective where the derivative is smaller.
inline void expect_derivative(const RandomCase& made) {
    const std::vector<Parameter> parameters = every_number(made.building);
    const kernel::Batch batch(made.building, parameters, made.drive);
    const kernel::Response response(batch, some_channels());
    const auto run = response.make_run();
    write_sensitivities(response, *run);
    const std::vector<Slopes> expected = slopes_of_all(response, parameters, *run);
    const double floor = 1e-4 * static_cast<double>(objective(response, *run, 0));
    Matrix gradient(1, parameters.size());
    response.pull_back(*run, gradient);
    double worst = 0, smooth = 0;
    for (std::size_t p = 0; p < parameters.size(); ++p) {
        const double g = gradient(0, p), size = std::max(std::fabs(g), floor);
        if (!expected[p].is_smooth(size)) continue;
        smooth += 1.0 / static_cast<double>(parameters.size());
        worst = std::max(worst, std::fabs(g - expected[p].near) / size);
        EXPECT_NEAR(g, expected[p].near, 1e-6 * size) << parameters[p].name;
    }
    EXPECT_GE(smooth, 0.6);
    bemcal::test::print_measured("gradient against central differences", worst, "-",
                                 "1e-6");
    bemcal::test::print_measured("share of numbers away from switches", smooth, "-",
                                 "0.6");
}

}  // namespace bemcal::physics::test
