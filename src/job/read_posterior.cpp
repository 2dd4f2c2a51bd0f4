/// Reads a [[study]] of kind "posterior", and the keys of chains of every study that has
/// them. Its checks of names, parameters and meters serve other studies too.
/// Source: Vehtari et al. 2021 for the targets, rank R-hat and effective draws.
/// Priors are in `read_prior`. Whether buildings can be pooled is checked by
/// `make_posterior`.
#include "input/suggest.hpp"
#include "job/readers.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>

namespace bemcal::job {

namespace {

using posterior::PosteriorOptions;
using study::Case;

int whole(const schema::Section& section, std::string_view key) {
    return static_cast<int>(section.integer(key));
}

/// Temperatures as the job has them, 1 first, rising, become their inverses.
std::vector<double> read_temperatures(const schema::Section& section,
                                      const std::vector<double>& otherwise) {
    std::vector<double> temperatures = section.numbers("temperatures");
    if (temperatures.empty()) return otherwise;
    if (temperatures[0] != 1 ||
        std::ranges::adjacent_find(temperatures, std::greater_equal<>()) !=
            temperatures.end())
        section.fail("temperatures",
                     "expected 1 first, then numbers that rise: [1, 2, 4, 8]");
    for (double& temperature : temperatures) temperature = 1 / temperature;
    return temperatures;
}

}  // namespace

void read_chains(const schema::Section& section, posterior::ChainOptions& chains) {
    chains.sampler.method = section.choice_as<sampling::Method>("sampler");
    chains.sampler.n_warm_up = whole(section, "warm_up");
    chains.sampler.thin = whole(section, "thin");
    chains.sampler.inverse_temperatures =
        read_temperatures(section, chains.sampler.inverse_temperatures);
    chains.n_chains = whole(section, "n_chains");
    chains.draws_per_round = whole(section, "draws_per_round");
    chains.most_draws = whole(section, "most_draws");
    chains.target_rhat = section.number("target_rhat");
    chains.target_ess = section.number("target_ess");
    if (chains.most_draws < chains.draws_per_round)
        section.fail(
            "most_draws",
            fmt::format("is {}, less than draws_per_round = {}; expected as many "
                        "at least",
                        chains.most_draws, chains.draws_per_round));
}

void check_word(const schema::Section& section, std::string_view key,
                const std::string& word, const std::vector<std::string>& names,
                const std::string& what) {
    if (std::ranges::find(names, word) != names.end()) return;
    section.fail(key, fmt::format("\"{}\" is no {}{}", word, what,
                                  input::suggestion(word, names)));
}

namespace {

bool has_reading(const Case& building, const study::Period& period,
                 const std::string& meter) {
    const auto readings = study::readings_of(building, period);
    for (std::size_t m = 0; m < building.meters.size(); ++m) {
        if (!meter.empty() && building.meters[m].name != meter) continue;
        if (study::has_reading(readings[m].values)) return true;
    }
    return false;
}

}  // namespace

void check_parameters(const schema::Section& section, const Learning& learning,
                      const Case& building) {
    std::vector<std::string> names;
    names.reserve(building.parameters.size());
    for (const physics::Parameter& parameter : building.parameters)
        names.push_back(parameter.name);
    for (const std::string& parameter : learning.parameters)
        check_word(section, "parameters", parameter, names,
                   "parameter of " + building.name);
}

void check_meters(const schema::Section& section, const Learning& learning,
                  const Case& building) {
    std::vector<std::string> names;
    names.reserve(building.meters.size());
    for (const study::Meter& meter : building.meters) names.push_back(meter.name);
    const study::Period& period = period_of(building, learning.period);
    for (const std::string& meter : learning.meters) {
        check_word(section, "meters", meter, names, "meter of " + building.name);
        if (!has_reading(building, period, meter))
            section.fail("meters",
                         fmt::format("{} of {} has no reading in the period {}; expected "
                                     "a meter with data",
                                     meter, building.name, period.name));
    }
    if (learning.meters.empty() && !has_reading(building, period, ""))
        section.fail("kind", fmt::format("needs readings, and no meter of {} has one in "
                                         "the period {}",
                                         building.name, period.name));
}

namespace {

/// Draws are stored under the parameter's name, beside their dimensions.
void check_parameter_names(const schema::Section& section, const Case& building) {
    for (const physics::Parameter& parameter : building.parameters)
        if (parameter.name.find('/') != std::string::npos || parameter.name == "chain" ||
            parameter.name == "draw" || parameter.name == "." || parameter.name == "..")
            section.fail("kind",
                         fmt::format("stores draws by parameter, and cannot for one "
                                     "called \"{}\"; expected another name",
                                     parameter.name));
}

bool is_unseen(const PosteriorOptions& options, const Case& building) {
    return std::ranges::find(options.unseen, building.name) != options.unseen.end();
}

/// Residuals that were learnt from a meter are drawn for the same one of another
/// building.
void check_meters_of_unseen(const schema::Section& section,
                            const PosteriorOptions& options, const Case& unseen,
                            const Case& seen) {
    for (const study::Meter& meter : seen.meters) {
        const bool is_used =
            options.meters.empty() ||
            std::ranges::find(options.meters, meter.name) != options.meters.end();
        if (!is_used || !has_reading(seen, period_of(seen, options.period), meter.name))
            continue;
        if (std::ranges::none_of(unseen.meters, [&](const study::Meter& other) {
                return other.name == meter.name && other.quantity == meter.quantity &&
                       other.interval == meter.interval;
            }))
            section.fail(
                "unseen",
                fmt::format("{0} has no {1} meter \"{2}\" of {3}, and {4}, which is "
                            "learned from, has; expected it in {0} too (it may be "
                            "without readings)",
                            unseen.name, physics::name_of(meter.interval), meter.name,
                            physics::name_of(meter.quantity), seen.name));
    }
}

void check_unseen(const schema::Section& section, const PosteriorOptions& options,
                  const std::vector<Case>& buildings) {
    std::vector<std::string> names;
    names.reserve(buildings.size());
    for (const Case& building : buildings) names.push_back(building.name);
    for (const std::string& name : options.unseen)
        check_word(section, "unseen", name, names, "building of this job");
    if (!options.unseen.empty() && options.unseen.size() >= buildings.size())
        section.fail("unseen", "has every building: none is left to learn from");
    if (options.unseen.empty()) return;
    const auto seen = std::ranges::find_if(
        buildings, [&](const Case& building) { return !is_unseen(options, building); });
    for (const Case& building : buildings)
        if (is_unseen(options, building))
            check_meters_of_unseen(section, options, building, *seen);
}

}  // namespace

PosteriorOptions read_posterior(const schema::Section& section, std::uint64_t seed) {
    PosteriorOptions options;
    read_chains(section, options.chains);
    options.chains.seed = seed;
    options.residuals.autocorrelated = section.flag("autocorrelated");
    options.residuals.proportional = section.flag("proportional");
    options.residuals.discrepancy = section.flag("discrepancy");
    options.period = section.text("period");
    options.parameters = section.texts("parameters");
    options.meters = section.texts("meters");
    options.hold_out_weeks = section.number("hold_out_weeks");
    options.hold_out_hours = section.number("hold_out_hours");
    options.n_predictive = whole(section, "n_predictive");
    options.level_change = section.number("level_change");
    options.lasting_weeks = section.number("lasting_weeks");
    options.reading_weight = section.number("reading_weight");
    options.pooling = section.choice_as<posterior::Pooling>("pooling");
    if (options.pooling != posterior::Pooling::none)
        options.unseen = section.texts("unseen");
    return options;
}

void check_posterior(const schema::Section& section, const PosteriorOptions& options,
                     const std::vector<Case>& buildings) {
    check_unseen(section, options, buildings);
    const Learning learning{options.period, options.parameters, options.meters};
    for (const Case& building : buildings) {
        check_parameters(section, learning, building);
        check_parameter_names(section, building);
    }
    for (const Case& building : buildings)
        if (!is_unseen(options, building)) check_meters(section, learning, building);
}

}  // namespace bemcal::job
