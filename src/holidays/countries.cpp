/// Puts the tables of countries together and finds one by its code.
/// Follows from the files of the tables.
/// What a row means is left to holidays.cpp.
#include "holidays/countries.hpp"

#include <algorithm>

namespace bemcal::holidays {
namespace {

std::vector<Country> all_countries() {
    std::vector<Country> all;
    for (const std::span<const Country> part :
         {western_europe(), northern_europe(), eastern_europe(), southern_europe(),
          british_isles(), north_america(), oceania(), east_asia(), south_asia()})
        all.insert(all.end(), part.begin(), part.end());
    std::ranges::sort(all, {}, [](const Country& c) { return std::string_view(c.code); });
    return all;
}

}  // namespace

const std::vector<Country>& countries() {
    static const std::vector<Country> all = all_countries();
    return all;
}

const Country* find_country(std::string_view code) {
    for (const Country& country : countries())
        if (country.code == code) return &country;
    return nullptr;
}

std::vector<std::string_view> words_of(std::string_view list) {
    std::vector<std::string_view> words;
    while (!list.empty()) {
        const std::size_t end = std::min(list.find(' '), list.size());
        if (end > 0) words.push_back(list.substr(0, end));
        list.remove_prefix(std::min(end + 1, list.size()));
    }
    return words;
}

}  // namespace bemcal::holidays
