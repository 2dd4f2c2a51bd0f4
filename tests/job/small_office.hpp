/// The sample job of tests/job/data with weather and readings made for it, in a folder
/// that goes when the test ends.
#pragma once

#include "base/error.hpp"
#include "job/job.hpp"
#include "physics/calendar.hpp"
#include "support/temporary_folder.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace bemcal::job {

using Folder = test::TemporaryFolder;

inline std::string text_of(const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

inline std::string replaced(std::string text, const std::string& from,
                            const std::string& to) {
    const std::size_t at = text.find(from);
    if (at == std::string::npos) throw std::logic_error("the text has no " + from);
    return text.replace(at, from.size(), to);
}

/// Hours of 2021 from January on: a warm, dry winter by two cosines.
inline std::string small_weather(int n_hours = 24 * 59) {
    std::string text = "time,T_out_C,DNI,DHI,wind_kmh\n";
    const physics::Seconds start = physics::parse_time("2021-01-01");
    for (int k = 0; k < n_hours; ++k) {
        const double day = std::cos(2 * std::numbers::pi * (k % 24 - 14) / 24);
        const double sun =
            std::max(0.0, std::cos(std::numbers::pi * (k % 24 - 11.5) / 12));
        text += fmt::format("{},{:.2f},{:.1f},{:.1f},{:.1f}\n",
                            physics::format_time(start + std::chrono::hours(k)),
                            14 + 5 * day + 3 * std::cos(k / 97.0), 500 * sun, 150 * sun,
                            8 + 4 * day);
    }
    return text;
}

/// Readings at the hours' ends.
inline std::string small_readings(int n_hours = 24 * 59) {
    std::string text = "time,elec_kWh,T_air_C\n";
    const physics::Seconds start = physics::parse_time("2021-01-01");
    for (int k = 0; k < n_hours; ++k)
        text += fmt::format("{},{:.2f},{:.1f}\n",
                            physics::format_time(start + std::chrono::hours(k + 1)),
                            12 + 6 * std::sin(k / 3.8), 20 + 2 * std::cos(k / 3.8));
    return text;
}

inline std::string small_office_text() {
    return text_of(BEMCAL_ROOT "/tests/job/data/small_office.toml");
}

/// The sample without its studies, as the template of a stock: the readings' file is the
/// column "meter".
inline std::string small_stock_building() {
    std::string text = small_office_text();
    text = text.substr(0, text.find("[[study]]"));
    text = replaced(text, "name = \"small_office\"\nseed = 7\n", "");
    for (int meter = 0; meter < 2; ++meter)
        text = replaced(text, "file = \"measured.csv\"", "file = \"@meter@\"");
    return text;
}

/// Writes the sample, changed at will, and its files; returns the job's path.
inline std::filesystem::path write_small_office(
    const Folder& folder, const std::string& text = small_office_text()) {
    folder.write("weather.csv", small_weather());
    folder.write("measured.csv", small_readings());
    return folder.write("office.toml", text);
}

/// The sample's building with more sections, such as effects.
inline study::Case small_office_with(const std::string& sections) {
    const Folder folder;
    std::string text = small_office_text();
    text.insert(text.find("[[study]]"), sections);
    return read_job(write_small_office(folder, text)).buildings.at(0);
}

/// Sections of an effect that follows a function of the outdoor temperature.
inline std::string effect_that_follows(const std::string& hook,
                                       const std::vector<double>& values, double spread) {
    return fmt::format(R"([[effect]]
name = "use"
hook = "{}"
coefficient = 1
[[effect.function]]
driver = "outdoor temperature"
at = [8, 13, 16, 20]
values = [{}]
spread = {}
)",
                       hook, fmt::join(values, ", "), spread);
}

/// The message of the UserError that reading the job ends with; "" where it goes well.
inline std::string message_of(const std::filesystem::path& file,
                              ExitCode* exit_code = nullptr) {
    try {
        read_job(file);
    } catch (const UserError& error) {
        if (exit_code != nullptr) *exit_code = error.exit_code();
        return error.what();
    }
    return "";
}

}  // namespace bemcal::job
