/// Says in plain words what the data could tell of a parameter. One table: the first rule
/// that holds gives the finding and its sentence.
/// Follows from the limits in `ContractionLimits`, which are conventions and no test.
/// The evidence is computed in `contraction`, which also names fixed parameters.
#include "posterior/finding.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace bemcal::posterior {
namespace {

using Limits = ContractionLimits;

struct Rule {
    Finding finding;
    bool (*holds)(const Evidence&, const Limits&);
    std::string (*words)(const Evidence&);
};

/// The first rule that holds gives the finding and its words.
constexpr Rule rules[] = {
    {Finding::unknown,
     [](const Evidence& e, const Limits&) { return std::isnan(e.contraction); },
     [](const Evidence&) { return std::string("too few draws to tell"); }},
    {Finding::at_edge,
     [](const Evidence& e, const Limits& limits) {
         return e.edge.draws >= limits.edge_share &&
                e.edge.draws >= limits.edge_factor * e.edge.prior;
     },
     [](const Evidence& e) {
         return fmt::format(
             "at the {} end of its range ({:.0f} % of the draws are near {:.4g}): the "
             "range is too narrow, or it makes up for what the model lacks",
             e.edge.name, 100 * e.edge.draws, e.edge.at);
     }},
    {Finding::determined,
     [](const Evidence& e, const Limits& limits) {
         return e.contraction >= limits.determined;
     },
     [](const Evidence& e) {
         return fmt::format(
             "the data determine it: {:.0f} % of the prior's spread is left",
             100 * e.spread);
     }},
    {Finding::confounded,
     [](const Evidence& e, const Limits& limits) {
         return std::abs(e.correlation) >= limits.correlation;
     },
     [](const Evidence& e) {
         return fmt::format("the data cannot tell it apart from {} (correlation {:.2f})",
                            e.partner, e.correlation);
     }},
    {Finding::wider,
     [](const Evidence& e, const Limits& limits) { return e.contraction < limits.wider; },
     [](const Evidence& e) {
         return fmt::format(
             "less certain than believed before ({:.0f} % of the prior's spread): prior "
             "and "
             "data disagree",
             100 * e.spread);
     }},
    {Finding::as_before,
     [](const Evidence& e, const Limits& limits) {
         return e.contraction < limits.as_before && std::abs(e.shift) < limits.unmoved;
     },
     [](const Evidence&) {
         return std::string("as believed before: the data say nothing");
     }},
    {Finding::moved,
     [](const Evidence& e, const Limits& limits) {
         return e.contraction < limits.as_before;
     },
     [](const Evidence& e) {
         return fmt::format(
             "moved by {:+.1f} of the prior's spread, but as uncertain as before",
             e.shift);
     }},
    {Finding::narrowed, [](const Evidence&, const Limits&) { return true; },
     [](const Evidence& e) {
         return fmt::format("the data narrow it: {:.0f} % of the prior's spread is left",
                            100 * e.spread);
     }},
};

}  // namespace

const char* name_of(Finding finding) {
    constexpr const char* names[] = {"fixed",      "unknown",    "at_edge",
                                     "determined", "confounded", "wider",
                                     "as_before",  "moved",      "narrowed"};
    return names[static_cast<int>(finding)];
}

Statement judge(const Evidence& evidence, const ContractionLimits& limits) {
    const Rule* rule = std::ranges::find_if(
        rules, [&](const Rule& r) { return r.holds(evidence, limits); });
    return {rule->finding, rule->words(evidence)};
}

}  // namespace bemcal::posterior
