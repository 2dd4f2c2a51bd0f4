/// Words in a job that must be names of something, and errors of other parts as errors of
/// a key.
#pragma once

#include "physics/parameters.hpp"
#include "schema/section.hpp"

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace bemcal::description {

/// Throws UserError at the key where a word is none of the names: "x" is no `what`.
void check_word(const schema::Section& section, std::string_view key,
                const std::string& word, const std::vector<std::string>& names,
                const std::string& what);

/// The numbers that a path at the key means; throws UserError, or Follows where it names
/// what could not be read.
std::vector<physics::Target> resolved_at(const schema::Section& section,
                                         std::string_view key,
                                         const physics::Building& building,
                                         const std::string& path);

/// The names of parameters, periods, meters, ...
template <class Named>
std::vector<std::string> names_of(const std::vector<Named>& all) {
    std::vector<std::string> names;
    names.reserve(all.size());
    for (const Named& one : all) names.push_back(one.name);
    return names;
}

/// Calls `read`, and throws its std::invalid_argument or std::domain_error as a UserError
/// that stands at the key.
template <class Read>
auto at_key(const schema::Section& section, std::string_view key, Read read) {
    try {
        return read();
    } catch (const std::invalid_argument& error) {
        section.fail(key, error.what());
    } catch (const std::domain_error& error) {
        section.fail(key, error.what());
    }
}

}  // namespace bemcal::description
