/// Meters made for the data checks: clean ones of many kinds, by seed.
#pragma once

#include "base/random.hpp"
#include "checks/data_readings.hpp"

#include <algorithm>
#include <numbers>

namespace bemcal::stats {

inline double normal(Stream& stream) {
    return std::sqrt(-2 * std::log(stream.uniform())) *
           std::cos(2 * std::numbers::pi * stream.uniform());
}

/// 2 % white and 2.5 % AR(1) noise, as factors.
class Noise {
  public:
    explicit Noise(Stream& stream) : stream_(&stream) {}
    double next() {
        slow_ = 0.85 * slow_ + 0.025 * std::sqrt(1 - 0.85 * 0.85) * normal(*stream_);
        return std::max(0.0, 1 + slow_ + 0.02 * normal(*stream_));
    }

  private:
    Stream* stream_;
    double slow_ = 0;
};

struct MadeMeter {
    std::vector<double> values;
    checks::Driver driver = checks::Driver::people;

    checks::DataSeries series() const { return {values, 24, 0, 0, driver}; }
};

/// Is it a working hour? Monday first; a building of ten working hours from `begin` on.
inline bool is_working(int k, int begin) {
    return k / 24 % 7 < 5 && k % 24 >= begin && k % 24 < begin + 10;
}

/// Base load, working days and three closed weeks in some summers, rounded to a quantum.
inline MadeMeter made_electricity(std::uint64_t seed, int n_days) {
    Stream stream(seed, 1, 0);
    Noise noise(stream);
    MadeMeter meter;
    const double base = 2 + 30 * stream.uniform(), day = base * 8 * stream.uniform();
    const double quantum = stream.uniform() < 0.5 ? 0.1 : 1;
    const int begin = 6 + static_cast<int>(stream.below(4));
    const int closed = stream.uniform() < 0.5 ? 190 : 10'000;
    for (int k = 0; k < 24 * n_days; ++k) {
        const int date = k / 24 % 365;
        const bool works =
            is_working(k, begin) && !(date >= closed && date < closed + 21);
        const double light = 1 + 0.2 * std::cos(2 * std::numbers::pi * date / 365);
        meter.values.push_back(quantum * std::round((base + (works ? day * light : 0)) *
                                                    noise.next() / quantum));
    }
    return meter;
}

/// Heat lost to a cold outdoors, cut back at night and perhaps off at weekends, with hot
/// water in some; 0 where there is nothing to heat. The season begins on a date or with
/// the weather.
inline MadeMeter made_heat(std::uint64_t seed, int n_days) {
    Stream stream(seed, 2, 0);
    Noise noise(stream);
    MadeMeter meter{{}, checks::Driver::weather};
    const double size = 5 + 200 * stream.uniform(), mean = 6 + 6 * stream.uniform();
    const double night = stream.uniform(), water = stream.below(2) * 0.05 * size;
    const bool off_at_weekends = stream.below(3) == 0, by_date = stream.below(2) == 0;
    double weather = 0;
    for (int k = 0; k < 24 * n_days; ++k) {
        const int date = k / 24 % 365;
        weather = 0.99 * weather + 0.5 * normal(stream);
        const double outdoors = mean - 10 * std::cos(2 * std::numbers::pi * date / 365) +
                                4 * std::sin(2 * std::numbers::pi * (k % 24 - 9) / 24) +
                                weather;
        const bool season = !by_date || date < 125 || date > 270;
        double share = is_working(k, 6) ? 1 : night;
        if (off_at_weekends && k / 24 % 7 > 4) share = 0;
        const double heat =
            season ? size * share * std::clamp((16 - outdoors) / 20, 0.0, 1.0) : 0;
        meter.values.push_back(std::round(10 * (heat + water) * noise.next()) / 10);
    }
    return meter;
}

/// A room: by season, day and noise, in steps of 0.1 K.
inline MadeMeter made_temperature(std::uint64_t seed, int n_days) {
    Stream stream(seed, 3, 0);
    MadeMeter meter{{}, checks::Driver::temperature};
    double slow = 0;
    for (int k = 0; k < 24 * n_days; ++k) {
        slow = 0.85 * slow + 0.12 * std::sqrt(1 - 0.85 * 0.85) * normal(stream);
        const double set = is_working(k, 6) ? 21 : 20;
        meter.values.push_back(std::round(10 * (set + slow + 0.08 * normal(stream))) /
                               10);
    }
    return meter;
}

/// A year and a half of one of the three kinds.
inline MadeMeter made_meter(std::uint64_t seed) {
    constexpr int n_days = 550;
    if (seed % 4 == 0) return made_temperature(seed, n_days);
    return seed % 2 == 0 ? made_electricity(seed, n_days) : made_heat(seed, n_days);
}

}  // namespace bemcal::stats
