/// Reads [[link]]: numbers of the building that follow from others, by the terms of a
/// polynomial or the rows of a table, within their ranges.
/// Follows from paper 2: conductivity from density (eq. 5-6), types of glazing.
/// A link may not set what an earlier one follows, so there are no cycles. Factors of
/// meters, and numbers that follow from layers, cannot be linked.
#include "description/building_readers.hpp"
#include "physics/derived.hpp"

#include <cmath>

#include <fmt/format.h>

namespace bemcal::description {

namespace {

using physics::Building;
using physics::Field;
using physics::Link;
using physics::Target;

/// A link follows what stands still, and sets what nothing else does.
void check_target(const schema::Section& section, const Building& building,
                  const Target& target) {
    if (target.part == physics::Part::meter)
        section.fail("target",
                     "a meter's factor cannot be linked; expected a number of "
                     "the building");
    if (physics::is_derived(building, target))
        section.fail("target", fmt::format("{} is set by another link or follows from "
                                           "layers; expected one of them",
                                           field_of(target).key));
    for (const Link& before : building.links)
        for (const Target& source : before.sources)
            if (physics::is_same_number(source, target))
                section.fail("target", fmt::format("a link above follows this {}; put "
                                                   "that one below",
                                                   field_of(target).key));
}

void check_source(const schema::Section& section, const Building& building,
                  const Link& link, const Target& source) {
    if (physics::follows_from_layers(building, source))
        section.fail("of", fmt::format("{} follows from layers; expected a number of "
                                       "these in its place",
                                       field_of(source).key));
    for (const Target& target : link.targets)
        if (physics::is_same_number(source, target))
            section.fail("of", "a number cannot follow itself");
}

std::vector<Link::Term> read_terms(const schema::Section& section,
                                   std::size_t n_sources) {
    std::vector<Link::Term> terms;
    for (const schema::Section& part : section.tables("term", "link.term")) {
        Link::Term term;
        term.factor = part.number("factor");
        const std::vector<double> exponents = part.has("exponents")
                                                  ? part.numbers("exponents")
                                                  : std::vector<double>(n_sources);
        if (exponents.size() != n_sources)
            part.fail("exponents",
                      fmt::format("has {} numbers; expected {}, one for each of `of`",
                                  exponents.size(), n_sources));
        for (const double exponent : exponents) {
            if (exponent != std::floor(exponent))
                part.fail("exponents", "expected whole numbers");
            term.exponents.push_back(static_cast<int>(exponent));
        }
        terms.push_back(std::move(term));
    }
    return terms;
}

/// \param n_each  how many numbers each path in `target` has matched
std::vector<Link::Row> read_rows(const schema::Section& section, std::size_t n_sources,
                                 const std::vector<std::size_t>& n_each) {
    std::vector<Link::Row> rows;
    for (const schema::Section& part : section.tables("row", "link.row")) {
        const std::vector<double> values = part.numbers("values");
        if (values.size() != n_each.size())
            part.fail("values", fmt::format("has {} numbers; expected {}, one for each "
                                            "path in target",
                                            values.size(), n_each.size()));
        if (n_sources != 1)
            section.fail("of", "names several numbers; a table follows one");
        Link::Row row{part.number("key"), {}};
        for (std::size_t k = 0; k < values.size(); ++k)
            row.values.insert(row.values.end(), n_each[k], values[k]);
        rows.push_back(std::move(row));
    }
    return rows;
}

/// \param n_each  gets how many numbers each path in `target` has matched
void read_targets(const schema::Section& section, const Building& building, Link& link,
                  std::vector<std::size_t>& n_each) {
    section.attempt_each(section.texts("target"), [&](const std::string& path) {
        const std::vector<Target> found = resolved_at(section, "target", building, path);
        for (const Target& target : found) check_target(section, building, target);
        link.targets.insert(link.targets.end(), found.begin(), found.end());
        n_each.push_back(found.size());
    });
}

void read_sources(const schema::Section& section, const Building& building, Link& link) {
    section.attempt_each(section.texts("of"), [&](const std::string& path) {
        const std::vector<Target> found = resolved_at(section, "of", building, path);
        if (found.size() != 1)
            section.fail("of", fmt::format("{} is {} numbers; expected the path of one",
                                           path, found.size()));
        link.sources.push_back(found[0]);
    });
}

Link read_link(const schema::Section& section, const Building& building) {
    Link link;
    std::vector<std::size_t> n_each;
    section.attempt_all([&] { read_targets(section, building, link, n_each); },
                        [&] { read_sources(section, building, link); });
    for (const Target& source : link.sources)
        check_source(section, building, link, source);
    if (link.targets.empty() || link.sources.empty())
        section.fail(link.targets.empty() ? "target" : "of",
                     "is empty; expected the path of a number");
    link.terms = read_terms(section, link.sources.size());
    link.rows = read_rows(section, link.sources.size(), n_each);
    if (link.terms.empty() == link.rows.empty())
        section.fail("target", "expected [[link.term]] or [[link.row]], one of them");
    return link;
}

}  // namespace

void read_links(const Sources& sources, Building& building) {
    sources.each("link", [&](const schema::Section& section) {
        building.links.push_back(read_link(section, building));
        physics::derive(building);
        check_linked(section, "target", building);
    });
    physics::derive(building);
}

void check_linked(const schema::Section& section, const char* key,
                  const Building& building) {
    for (const Link& link : building.links)
        for (const Target& target : link.targets) {
            const Field& field = field_of(target);
            const double value = physics::number_at(building, target);
            if (value >= field.least && value <= field.most) continue;
            section.fail(key, fmt::format("makes the linked {} = {:g}: expected {:g} to "
                                          "{:g} {} ({})",
                                          field.key, value, field.least, field.most,
                                          field.unit, field.sentence));
        }
}

}  // namespace bemcal::description
