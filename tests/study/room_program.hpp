/// Another program whose hours a formula has, for tests of studies around it.
#pragma once

#include "study/hourly_simulator.hpp"
#include "study/simulated_hours.hpp"
#include "study/small_case.hpp"

#include <cmath>
#include <string>
#include <vector>

namespace bemcal::test {

/// A program of one room: heat to a set-point, less a share of the sun, never below 0.
/// The sun is let out again over some hours.
class Room : public study::HourlySimulator {
  public:
    explicit Room(const study::Case& building, int fails_each = 0, double sun_lasts = 24)
        : building_(building), fails_each_(fails_each), sun_lasts_(sun_lasts) {
        add("u", 0.5, 2);
        add("set_point", 18, 23);
        add("sun", 0.1, 1);
    }
    const std::vector<physics::Parameter>& parameters() const override {
        return parameters_;
    }
    const std::vector<std::string>& meters() const override { return meters_; }
    study::SimulatedHours hours(std::span<const double> point,
                                std::span<const study::GivenEffect>,
                                std::span<const study::Period>) const override {
        study::SimulatedHours simulated;
        if (fails_each_ > 0 && std::lround(1e6 * point[0]) % fails_each_ == 0)
            simulated.failure = "it was told to fail";
        else
            simulated.meters = {heat(point)};
        return simulated;
    }

    /// [hours of all periods] kWh
    std::vector<double> heat(std::span<const double> point) const {
        std::vector<double> all;
        const physics::Weather& weather = building_.weather;
        for (const study::Period& period : building_.periods) {
            const auto from =
                static_cast<std::size_t>((period.from - day(0)).count() / 3600);
            double stored = 0;  // of the sun
            for (std::size_t k = 0; k < static_cast<std::size_t>(study::hours_of(period));
                 ++k) {
                stored += (weather.global_horizontal[from + k] - stored) / sun_lasts_;
                const double loss =
                                 0.2 * point[0] * (point[1] - weather.theta_e[from + k]),
                             gain = 0.006 * point[2] * stored;
                // A thermostat's band rounds the corner at 0.
                all.push_back(0.1 * std::log1p(std::exp((loss - gain) / 0.1)));
            }
        }
        return all;
    }

  private:
    void add(const char* name, double least, double most) {
        physics::Parameter& parameter = parameters_.emplace_back();
        parameter.name = name;
        parameter.unit = "-";
        parameter.least = least;
        parameter.most = most;
        parameter.nominal = (least + most) / 2;
    }

    study::Case building_;
    int fails_each_;
    double sun_lasts_;  ///< [h]
    std::vector<physics::Parameter> parameters_;
    std::vector<std::string> meters_{"heating"};
};

}  // namespace bemcal::test
