/// Readings against the plain version, and their derivative against central differences,
/// over all options of the description.
#include "physics/plain_answer.hpp"
#include "physics/random_building.hpp"
#include "physics/response.hpp"
#include "support/measured.hpp"

#include <cstring>
#include <stdexcept>

#include <gtest/gtest.h>

namespace bemcal::physics {

namespace {

using bemcal::test::print_measured;
using test::Dice;
using test::random_case;
using test::random_points;
using test::RandomCase;

std::vector<Channel> all_channels() {
    std::vector<Channel> channels;
    for (Quantity quantity :
         {Quantity::air_temperature, Quantity::heating, Quantity::cooling,
          Quantity::electricity, Quantity::gas, Quantity::district})
        for (Interval interval : {Interval::step, Interval::hourly, Interval::daily,
                                  Interval::monthly, Interval::annual})
            channels.push_back({quantity, interval});
    return channels;
}

/// A few channels that see everything: what gradients are tested with.
std::vector<Channel> some_channels() {
    return {{Quantity::heating, Interval::hourly},
            {Quantity::electricity, Interval::daily},
            {Quantity::gas, Interval::monthly},
            {Quantity::cooling, Interval::annual},
            {Quantity::air_temperature, Interval::hourly},
            {Quantity::district, Interval::step}};
}

std::size_t n_inner(const Building& building, const Target& target) {
    if (target.part == Part::plant) return 1;
    const Zone* zone = nullptr;
    const auto k = static_cast<std::size_t>(target.index);
    switch (target.part) {
        case Part::construction:
            return k < building.constructions.size() ? 1 : 0;
        case Part::glazing:
            return k < building.glazings.size() ? 1 : 0;
        case Part::boundary:
            return k < building.boundaries.size() ? 1 : 0;
        default:
            break;
    }
    if (k >= building.zones.size()) return 0;
    zone = &building.zones[k];
    switch (target.part) {
        case Part::surface:
            return zone->surfaces.size();
        case Part::window:
            return zone->windows.size();
        case Part::flow:
            return zone->flows.size();
        case Part::load:
            return zone->loads.size();
        case Part::zone:
            return 1;
        default:
            return 0;
    }
}

/// A parameter for every number of the building: itself by a factor, or its low by an
/// offset.
std::vector<Parameter> every_number(const Building& building) {
    std::vector<Parameter> parameters;
    for (int field = 0; field < static_cast<int>(fields().size()); ++field) {
        const Field& entry = fields()[static_cast<std::size_t>(field)];
        Target target{entry.part, 0, 0, field, false};
        const int n = entry.part == Part::plant ? 1 : 10;
        for (target.index = 0; target.index < n; ++target.index)
            for (target.inner = 0;
                 target.inner < static_cast<int>(n_inner(building, target));
                 ++target.inner) {
                target.low = false;
                const double number = number_at(building, target);
                parameters.push_back(
                    {entry.key, "", 0.999, 1.001, Effect::factor, {target}, 1});
                if (number == 0 || !std::isfinite(number)) parameters.pop_back();
                if (entry.input == nullptr) continue;
                target.low = true;
                parameters.push_back({std::string(entry.key) + ".low",
                                      "",
                                      -0.001,
                                      0.001,
                                      Effect::offset,
                                      {target},
                                      0});
            }
    }
    return parameters;
}

Matrix nominal_points(const std::vector<Parameter>& parameters, std::size_t n) {
    Matrix points(n, parameters.size());
    for (std::size_t k = 0; k < n; ++k)
        for (std::size_t p = 0; p < parameters.size(); ++p)
            points(k, p) = parameters[p].nominal;
    return points;
}

/// The same random sensitivities for all lanes: of kWh and, heavier, of degC.
void write_sensitivities(const Response& response, Response::Run& run) {
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
long double objective(const Response& response, Response::Run& run, int lane) {
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
std::vector<long double> objectives(const Response& response, const Matrix& points,
                                    Response::Run& run) {
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

Matrix points_around(const std::vector<Parameter>& parameters) {
    Matrix points = nominal_points(parameters, 4 * parameters.size());
    for (std::size_t p = 0; p < parameters.size(); ++p) {
        std::size_t row = 4 * p;
        for (double step : {h, -h, 2 * h, -2 * h}) points(row++, p) += step;
    }
    return points;
}

Slopes slopes(const long double* value, long double middle) {
    const auto slope = [&](int k, double step) {
        return static_cast<double>((value[k] - value[k + 1]) / (2 * step));
    };
    const auto bend = [&](int k, double step) {
        return static_cast<double>((value[k] - 2 * middle + value[k + 1]) / step);
    };
    return {slope(0, h), slope(2, 2 * h), bend(0, h), bend(2, 2 * h)};
}

/// Of every parameter, at the nominal point; leaves that point in the run.
std::vector<Slopes> slopes_of_all(const Response& response,
                                  const std::vector<Parameter>& parameters,
                                  Response::Run& run) {
    const auto values = objectives(response, points_around(parameters), run);
    const auto middle = objectives(response, nominal_points(parameters, 1), run);
    std::vector<Slopes> result;
    for (std::size_t p = 0; p < parameters.size(); ++p)
        result.push_back(slopes(values.data() + 4 * p, middle[0]));
    return result;
}

std::vector<double> readings_of(const Response& response, const Response::Run& run,
                                std::size_t channel, int lane) {
    std::vector<double> values;
    const double* at = response.readings(run, channel) + lane;
    for (std::size_t k = 0; k < response.n_readings(channel); ++k, at += response.lanes())
        values.push_back(*at);
    return values;
}

/// Within 1e-10 of the largest value.
void expect_near(const std::vector<double>& fast, const std::vector<double>& plain) {
    ASSERT_EQ(fast.size(), plain.size());
    double most = 1e-6;
    for (double value : plain) most = std::max(most, std::fabs(value));
    for (std::size_t k = 0; k < plain.size(); ++k)
        ASSERT_NEAR(fast[k], plain[k], 1e-10 * most);
}

bool is_coupled(const Building& building) {
    return !building.zones[0].couplings.empty();
}

class ResponseOfRandom : public testing::TestWithParam<unsigned> {};

}  // namespace

TEST_P(ResponseOfRandom, DerivativeIsThatOfCentralDifferences) {
    const RandomCase made = random_case(GetParam());
    if (is_coupled(made.building)) return;
    const std::vector<Parameter> parameters = every_number(made.building);
    const Batch batch(made.building, parameters, made.drive);
    const Response response(batch, some_channels());
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
    print_measured("gradient against central differences", worst, "-", "1e-6");
    print_measured("share of numbers away from switches", smooth, "-", "0.6");
}

TEST_P(ResponseOfRandom, ReadingsAreThoseOfThePlainVersion) {
    const RandomCase made = random_case(GetParam());
    const Matrix points = random_points(GetParam() + 3000, made.parameters, 1);
    const Batch batch(made.building, made.parameters, made.drive);
    const Response response(batch, all_channels());
    const auto run = response.make_run();
    ASSERT_EQ(response.predict(points, 0, 1, *run)[0], "");
    Building building = made.building;
    apply(made.building, made.parameters, points.row(0), building);
    const Trajectory trajectory = simulate(building, made.drive);
    for (std::size_t c = 0; c < response.channels().size(); ++c) {
        const auto [quantity, interval] = response.channels()[c];
        expect_near(
            readings_of(response, *run, c, 0),
            aggregate(predict(building, made.drive, trajectory, quantity),
                      interval_bounds(period_of(made.drive), interval), quantity));
    }
}

INSTANTIATE_TEST_SUITE_P(Buildings, ResponseOfRandom, testing::Range(1U, 61U));

}  // namespace bemcal::physics
