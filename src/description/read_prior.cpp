/// Reads what is believed of a parameter: prior = {...}, or values = [...], each as
/// likely as another. Without either it is uniform in its range.
/// Source: paper 1, step 2, for priors on the scale from 0 to 1; kinds are those of
/// `stats::Prior`, cut to the range.
/// Leaves out correlated priors, and priors on discrete values.
#include "description/read_prior.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>

namespace bemcal::description {

namespace {

using stats::Prior;
using stats::PriorKind;

/// The keys of a kind's numbers, in the order of the enumeration.
struct Numbers {
    PriorKind kind;
    const char *a, *b;
};
constexpr Numbers numbers_of[] = {
    {PriorKind::fixed, "value", nullptr}, {PriorKind::uniform, nullptr, nullptr},
    {PriorKind::normal, "mean", "sd"},    {PriorKind::lognormal, "median", "sd_log"},
    {PriorKind::beta, "alpha", "beta"},   {PriorKind::gamma, "shape", "rate"}};

/// A number that this kind needs.
double needed_number(const schema::Section& section, const char* key) {
    section.node(key);
    return section.number(key);
}

/// A median becomes the mean of the logarithm.
double first_number(const schema::Section& section, const Numbers& keys) {
    if (keys.a == nullptr) return 0;
    const double number = needed_number(section, keys.a);
    if (keys.kind != PriorKind::lognormal) return number;
    if (number <= 0) section.fail_value(keys.a, "expected a number above 0");
    return std::log(number);
}

bool may_be_normalised(PriorKind kind) {
    return kind == PriorKind::normal || kind == PriorKind::lognormal ||
           kind == PriorKind::gamma;
}

/// Its numbers, of any range.
Prior read_numbers(const schema::Section& section) {
    const Numbers& keys = *std::ranges::find(
        numbers_of, section.choice_as<PriorKind>("kind"), &Numbers::kind);
    Prior prior;
    prior.kind = keys.kind;
    section.attempt_all([&] { prior.a = first_number(section, keys); },
                        [&] {
                            if (keys.b != nullptr)
                                prior.b = needed_number(section, keys.b);
                        },
                        [&] {
                            prior.is_normalised = may_be_normalised(prior.kind) &&
                                                  section.flag("normalised");
                        });
    return prior;
}

void cut_to_range(const physics::Parameter& parameter, Prior& prior) {
    prior.least = parameter.least;
    prior.most = parameter.most;
}

void check_mass(const schema::Section& section, const physics::Parameter& parameter,
                const Prior& prior) {
    const std::string complaint = stats::complaint_about(prior);
    if (!complaint.empty())
        section.fail("kind",
                     fmt::format("{} (min and max of {})", complaint, parameter.name));
}

/// Who says what is believed of a number has not meant it to exclude the description.
void check_nominal(const schema::Section& section, std::string_view key,
                   const physics::Parameter& parameter) {
    if (parameter.nominal >= parameter.least && parameter.nominal <= parameter.most)
        return;
    section.fail(
        key, fmt::format("{} is {} in the description, outside {} to {}; expected "
                         "a range with it",
                         parameter.name, schema::plain(parameter.nominal),
                         schema::plain(parameter.least), schema::plain(parameter.most)));
}

}  // namespace

std::vector<double> read_values(const schema::Section& section) {
    std::vector<double> values = section.numbers("values");
    if (values.size() < 2) section.fail("values", "expected two numbers or more");
    if (std::ranges::adjacent_find(values, std::greater_equal<>()) != values.end())
        section.fail("values", "expected numbers that rise, each once");
    return values;
}

Prior read_distribution(const schema::Section& section,
                        const physics::Parameter& parameter) {
    Prior prior = read_numbers(section);
    cut_to_range(parameter, prior);
    check_mass(section, parameter, prior);
    return prior;
}

study::ParameterPrior read_prior(const schema::Section& section) {
    study::ParameterPrior result;
    if (section.has("values")) {
        result.values = read_values(section);
        section.refuse({"prior"},
                       "has no effect beside values, which are all alike; remove it");
    }
    if (section.has("prior"))
        result.prior = read_numbers(section.table("prior", "prior"));
    return result;
}

void place_prior(const schema::Section& section, const physics::Parameter& parameter,
                 study::ParameterPrior& prior) {
    cut_to_range(parameter, prior.prior);
    if (section.has("prior"))
        check_mass(section.table("prior", "prior"), parameter, prior.prior);
    for (const char* key : {"values", "prior"})
        if (section.has(key)) check_nominal(section, key, parameter);
}

}  // namespace bemcal::description
